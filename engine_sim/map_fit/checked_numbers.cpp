// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/map_fit/checked_numbers.h"

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::engine_sim {

using files::shown;
using files::throw_defect;

std::string range_text(double low, double high) {
  return shown(low) + " to " + shown(high);
}

double number_between(files::JsonObject& object, const std::string& key, double low, double high) {
  const double value = object.number(key);
  if (value >= low && value <= high) return value;
  throw_defect(object.file(), object.key(key), shown(value), "a number from " + range_text(low, high),
               "Correct the value");
}

std::vector<double> ascending_numbers(files::JsonObject& object, const std::string& key, std::size_t least,
                                      std::size_t most, double low, double high) {
  const files::Json& list = object.array(key);
  const bool one_row = list.size() == 1 && list[0].is_array();
  const std::size_t count = one_row ? list[0].size() : list.size();
  if (count < least || count > most) {
    throw_defect(object.file(), object.key(key), std::to_string(count) + " numbers long",
                 std::to_string(least) + " to " + std::to_string(most) + " numbers", "Correct the list");
  }
  const auto size = as_index(count);
  const Eigen::VectorXd numbers =
      one_row ? Eigen::VectorXd(object.matrix(key, 1, size).row(0)) : object.vector(key, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::string at = object.key(key) + "[" + std::to_string(i) + "]";
    if (numbers(i) < low || numbers(i) > high) {
      throw_defect(object.file(), at, shown(numbers(i)), "a number from " + range_text(low, high), "Correct the value");
    }
    if (i > 0 && numbers(i) <= numbers(i - 1)) {
      throw_defect(object.file(), at, shown(numbers(i)), "a number above " + shown(numbers(i - 1)) + ", the one before",
                   "Put the list in ascending order");
    }
  }
  return {numbers.begin(), numbers.end()};
}

}  // namespace ehm::engine_sim
