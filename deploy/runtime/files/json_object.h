// SPDX-License-Identifier: Apache-2.0
#pragma once
// Strict reading of JSON: every key once, every key known, every number finite; errors name file and key.

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace ehm::files {

using Json = nlohmann::json;

/// @throws FileError if the file cannot be read, is not complete JSON, is not an object, or repeats a key.
Json parse_json_file(const std::string& file);

/// The same of a text; `file` is only named in messages.
/// @throws FileError as parse_json_file.
Json parse_json_text(const std::string& text, const std::string& file);

/// One JSON object of a file; remembers which keys were asked for.
class JsonObject {
 public:
  /// `path` is the key of the object inside the file, empty for the root.
  /// @throws FileError if `value` is not an object.
  JsonObject(const Json& value, std::string file, std::string path);

  /// @throws FileError if the key is missing.
  const Json& at(const std::string& key);
  /// nullptr if the key is missing.
  const Json* find(const std::string& key);
  /// @throws FileError if the key is missing or no text, or empty.
  std::string text(const std::string& key);
  /// @throws FileError if the key is missing or no finite number.
  double number(const std::string& key);
  /// @throws FileError as number(), or if the value is not above zero.
  double positive_number(const std::string& key);
  /// @throws FileError if the key is missing or no array.
  const Json& array(const std::string& key);
  /// @throws FileError if the key is missing, no array, or of the wrong shape; `rows` and `cols` may be 0.
  Eigen::MatrixXd matrix(const std::string& key, Eigen::Index rows, Eigen::Index cols);
  /// @throws FileError if the key is missing, no array, or of the wrong length.
  Eigen::VectorXd vector(const std::string& key, Eigen::Index size);
  /// Call after the last key. @throws FileError naming the first key that nobody asked for.
  void refuse_unknown() const;

  [[nodiscard]] std::string key(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }
  [[nodiscard]] const std::string& file() const noexcept { return file_; }

 private:
  const Json& value_;
  std::string file_;
  std::string path_;
  std::set<std::string> asked_;
};

/// Value as it stands in a message: short, one line.
std::string shown(const Json& value);
/// Number as JSON writes it.
std::string shown(double value);

/// Rows of numbers, and a row. @throws FileError (file, key) if an entry is not finite, both: JSON cannot hold it.
Json to_json(const Eigen::MatrixXd& matrix, const std::string& file, const std::string& key);
Json vector_to_json(const Eigen::VectorXd& vector, const std::string& file, const std::string& key);

}  // namespace ehm::files
