// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/files/json_object.h"

#include <cmath>
#include <utility>
#include <vector>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/input_file.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::files {
namespace {

std::string count(Eigen::Index n, const char* what) {
  return std::to_string(n) + " " + what;
}

double finite_number(const Json& value, const std::string& file, const std::string& key) {
  if (value.is_number()) return value.get<double>();
  throw_defect(file, key, shown(value), "a finite number", "Write the number, or derive the matrix again");
}

Eigen::VectorXd read_numbers(const Json& value, Eigen::Index size, const std::string& file, const std::string& key) {
  if (!value.is_array()) throw_defect(file, key, shown(value), "an array of numbers", "Write it as [1, 2, ...]");
  if (as_index(value.size()) != size) {
    throw_defect(file, key, count(as_index(value.size()), "numbers long"), count(size, "numbers"),
                 "Check the row against the channel lists");
  }
  Eigen::VectorXd result(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto at = as_size(i);
    result(i) = finite_number(value[at], file, key + "[" + std::to_string(at) + "]");
  }
  return result;
}

/// What is computed of the content walks down it level by level, on a stack that ends.
constexpr int deepest = 64;

/// The library's message without its prefix "[json.exception...] ".
std::string parser_message(const std::exception& error) {
  const std::string text = error.what();
  const auto end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace

std::string shown(const Json& value) {
  const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

std::string shown(double value) {
  return std::isfinite(value) ? Json(value).dump() : (value != value ? "NaN" : "infinite");
}

Json parse_json_file(const std::string& file) {
  return parse_json_text(files::read_input_file(file, files::json_file), file);
}

Json parse_json_text(const std::string& text, const std::string& file) {
  std::vector<std::set<std::string>> open_objects;
  std::string repeated;
  const auto note_keys = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > deepest)
      throw FileError(file + ": is nested deeper than " + std::to_string(deepest) +
                      " levels, which no file of ours is. Write it again.");
    if (event == Json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == Json::parse_event_t::object_end) open_objects.pop_back();
    if (event == Json::parse_event_t::key && !open_objects.back().insert(parsed.get<std::string>()).second &&
        repeated.empty()) {
      repeated = parsed.get<std::string>();
    }
    return true;
  };
  Json root;
  try {
    root = Json::parse(text, note_keys);
  } catch (const Json::exception& error) {
    throw FileError(file + ": is not complete JSON: " + parser_message(error) +
                    ". The file is damaged or truncated, or holds NaN or Infinity; write it again.");
  }
  if (!repeated.empty())
    throw FileError(file + ": key " + repeated + " occurs twice in one object. Remove one of them.");
  if (!root.is_object()) {
    throw FileError(file + ": holds " + shown(root) + "; allowed: one JSON object. Write it again.");
  }
  return root;
}

JsonObject::JsonObject(const Json& value, std::string file, std::string path)
    : value_(value), file_(std::move(file)), path_(std::move(path)) {
  if (!value.is_object())
    throw_defect(file_, path_, shown(value), "an object {...}", "See the description of the format");
}

const Json* JsonObject::find(const std::string& name) {
  asked_.insert(name);
  const auto it = value_.find(name);
  return it == value_.end() ? nullptr : &*it;
}

const Json& JsonObject::at(const std::string& name) {
  const Json* found = find(name);
  if (found == nullptr) throw FileError(file_ + ": key " + key(name) + " is missing. Add it.");
  return *found;
}

std::string JsonObject::text(const std::string& name) {
  const Json& value = at(name);
  if (!value.is_string() || value.get_ref<const std::string&>().empty()) {
    throw_defect(file_, key(name), shown(value), "a text that is not empty", "Write it in quotes");
  }
  return value.get<std::string>();
}

double JsonObject::number(const std::string& name) {
  return finite_number(at(name), file_, key(name));
}

double JsonObject::positive_number(const std::string& name) {
  const double value = number(name);
  if (value > 0.0) return value;
  throw_defect(file_, key(name), shown(value), "a number above 0", "Correct the value");
}

const Json& JsonObject::array(const std::string& name) {
  const Json& value = at(name);
  if (!value.is_array()) throw_defect(file_, key(name), shown(value), "an array [...]", "Write it in brackets");
  return value;
}

Eigen::MatrixXd JsonObject::matrix(const std::string& name, Eigen::Index rows, Eigen::Index cols) {
  // A matrix without rows or columns may be left out.
  if (rows * cols == 0 && find(name) == nullptr) return Eigen::MatrixXd::Zero(rows, cols);
  const Json& value = array(name);
  if (rows * cols == 0 && value.empty()) return Eigen::MatrixXd::Zero(rows, cols);
  if (as_index(value.size()) != rows) {
    throw_defect(file_, key(name), count(as_index(value.size()), "rows high"),
                 std::to_string(rows) + " rows of " + std::to_string(cols) + " numbers",
                 "Check the matrix against the channel lists");
  }
  Eigen::MatrixXd result(rows, cols);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto row = as_size(i);
    const Eigen::VectorXd numbers = read_numbers(value[row], cols, file_, key(name) + "[" + std::to_string(row) + "]");
    for (Eigen::Index j = 0; j < cols; ++j) result(i, j) = numbers(j);  // without columns there is no row to assign
  }
  return result;
}

Eigen::VectorXd JsonObject::vector(const std::string& name, Eigen::Index size) {
  return read_numbers(at(name), size, file_, key(name));
}

void JsonObject::refuse_unknown() const {
  for (const auto& [name, value] : value_.items()) {
    if (asked_.count(name) != 0) continue;
    std::string known;
    for (const std::string& asked : asked_) known += (known.empty() ? "" : ", ") + asked;
    throw FileError(file_ + ": key " + key(name) + " is unknown; allowed here: " + known +
                    ". Correct the spelling or remove it.");
  }
}

Json vector_to_json(const Eigen::VectorXd& vector, const std::string& file, const std::string& key) {
  Json result = Json::array();
  for (Eigen::Index i = 0; i < vector.size(); ++i) {
    if (!std::isfinite(vector(i))) {
      throw_defect(file, key + "[" + std::to_string(i) + "]", shown(vector(i)), "a finite number",
                   "Nothing was written; find out where the number comes from");
    }
    result.push_back(vector(i));
  }
  return result;
}

Json to_json(const Eigen::MatrixXd& matrix, const std::string& file, const std::string& key) {
  Json result = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    // a row of a matrix without columns is no place in memory, not even to point at
    const Eigen::VectorXd row = matrix.cols() > 0 ? Eigen::VectorXd(matrix.row(i).transpose()) : Eigen::VectorXd();
    result.push_back(vector_to_json(row, file, key + "[" + std::to_string(i) + "]"));
  }
  return result;
}

}  // namespace ehm::files
