// SPDX-License-Identifier: Apache-2.0
#pragma once
// Reading numbers of a state that this monitor wrote itself: checkpoint, baseline.
// @throws files::FileError (file, key, value, allowed, and that the file may be removed) from all of them.

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "monitor/estimation/learned.h"

namespace ehm::monitor::state_json {

inline constexpr const char* remedy = "Remove the file; the monitor then starts cold and writes a new one";

[[noreturn]] void defect(const files::JsonObject& object, const std::string& name, const files::Json& value,
                         const std::string& allowed);

template <class Integer>
Integer integer(files::JsonObject& object, const std::string& name, Integer min, Integer max) {
  const files::Json& value = object.at(name);
  const std::string allowed = std::to_string(min) + " to " + std::to_string(max);
  if (!value.is_number_integer()) defect(object, name, value, allowed);
  if (value.is_number_unsigned()) {
    const auto number = value.get<std::uint64_t>();
    if (number > static_cast<std::uint64_t>(max) || (min > 0 && number < static_cast<std::uint64_t>(min)))
      defect(object, name, value, allowed);
    return static_cast<Integer>(number);
  }
  const auto number = value.get<std::int64_t>();  // negative
  if (std::is_unsigned_v<Integer> || number < static_cast<std::int64_t>(min)) defect(object, name, value, allowed);
  return static_cast<Integer>(number);
}

/// As text, with the SHA-256 of the content as the key "hash".
std::string hashed_text(files::Json content);
/// That the file's key "hash" is that of its `content`.
void require_hash(files::JsonObject& root, files::Json content);
/// A larger number is no state of any filter, and would make the next one infinite.
void require_moderate(const files::JsonObject& object, const std::string& name, const Eigen::MatrixXd& values);
/// The value at "covariance": symmetric, and no direction has a negative variance, but for rounding: else the filter's
/// gains would mean nothing.
void require_covariance(const files::JsonObject& object, const Eigen::MatrixXd& covariance);

/// {value, covariance}. `file` and `key` are only named where a number is not finite.
files::Json learned_to_json(const estimation::Learned& learned, const std::string& file, const std::string& key);
/// That of the key; of this length.
estimation::Learned learned_from_json(files::JsonObject& root, const std::string& key, Eigen::Index length);

}  // namespace ehm::monitor::state_json
