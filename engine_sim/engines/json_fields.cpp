// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/json_fields.h"

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::engine_sim {

using files::Json;
using files::JsonObject;

void throw_field_defect(const JsonObject& object, const std::string& key, const std::string& value,
                        const std::string& allowed, const std::string& remedy) {
  files::throw_defect(object.file(), object.key(key), value, allowed, remedy);
}

void require_within(const JsonObject& object, const std::string& key, double value, double lowest, double highest,
                    const std::string& unit) {
  if (value >= lowest && value <= highest) return;
  throw_field_defect(object, key, files::shown(value),
                     files::shown(lowest) + " to " + files::shown(highest) + " (" + unit + ")", "Correct the value");
}

std::vector<double> number_list(JsonObject& object, const std::string& key, std::size_t least, std::size_t most) {
  const Json& array = object.array(key);
  if (array.size() < least || array.size() > most)
    throw_field_defect(object, key, std::to_string(array.size()) + " numbers long",
                       std::to_string(least) + " to " + std::to_string(most) + " numbers", "Correct the list");
  const Eigen::VectorXd numbers = object.vector(key, as_index(array.size()));
  return {numbers.begin(), numbers.end()};
}

std::vector<double> ascending_list(JsonObject& object, const std::string& key, std::size_t least, std::size_t most) {
  std::vector<double> numbers = number_list(object, key, least, most);
  for (std::size_t i = 1; i < numbers.size(); ++i)
    if (!(numbers[i] > numbers[i - 1]))
      throw_field_defect(object, key + "[" + std::to_string(i) + "]", files::shown(numbers[i]),
                         "more than " + files::shown(numbers[i - 1]) + ", the one before",
                         "Put them into ascending order");
  return numbers;
}

NumberPairs pair_list(JsonObject& object, const std::string& key, double lowest, double highest,
                      const std::string& unit) {
  constexpr std::size_t most = 32;
  const Json& array = object.array(key);
  if (array.empty() || array.size() > most)
    throw_field_defect(object, key, std::to_string(array.size()) + " points long",
                       "1 to " + std::to_string(most) + " points [at, value]", "Correct the list");
  const Eigen::MatrixXd rows = object.matrix(key, as_index(array.size()), 2);
  NumberPairs pairs;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const std::string row = key + "[" + std::to_string(i) + "]";
    if (!pairs.empty() && !(rows(i, 0) > pairs.back().first))
      throw_field_defect(object, row + "[0]", files::shown(rows(i, 0)),
                         "more than " + files::shown(pairs.back().first) + ", the point before",
                         "Put the points into ascending order");
    require_within(object, row + "[1]", rows(i, 1), lowest, highest, unit);
    pairs.emplace_back(rows(i, 0), rows(i, 1));
  }
  return pairs;
}

Json pairs_to_json(const NumberPairs& pairs) {
  Json array = Json::array();
  for (const auto& [at, value] : pairs) array.push_back({at, value});
  return array;
}

}  // namespace ehm::engine_sim
