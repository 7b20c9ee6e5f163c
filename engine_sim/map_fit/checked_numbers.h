// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers of a JSON file with their allowed range. Errors name file, key, value and range
// (deploy/runtime/files/file_error.h).

#include <string>
#include <vector>

#include "deploy/runtime/files/json_object.h"

namespace ehm::engine_sim {

/// "LOW to HIGH", as messages show it.
std::string range_text(double low, double high);

/// @throws files::FileError if the key is missing, or no number from `low` to `high`
double number_between(files::JsonObject& object, const std::string& key, double low, double high);

/// A list [1, 2, ...], or the same as the only row of a table: [[1, 2, ...]].
/// @throws files::FileError if the key is missing or no list,
///         if it has fewer than `least` or more than `most` numbers,
///         if one lies outside `low` to `high`, or if they do not ascend strictly
std::vector<double> ascending_numbers(files::JsonObject& object, const std::string& key, std::size_t least,
                                      std::size_t most, double low, double high);

}  // namespace ehm::engine_sim
