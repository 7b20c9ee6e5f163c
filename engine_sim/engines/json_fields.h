// SPDX-License-Identifier: Apache-2.0
#pragma once
// The numbers of a structure and their keys in an engine file: one line a number, {key, member, range, unit}; reading,
// validation and writing follow from it.
// @throws files::FileError (file, key, value, range with unit) for a number that is missing, none, or out of range.

#include <string>
#include <utility>
#include <vector>

#include "deploy/runtime/files/json_object.h"

namespace ehm::engine_sim {

template <class T>
struct NumberField {
  const char* key;
  double T::*value;
  double lowest, highest;  ///< both allowed
  const char* unit;
};

/// @throws files::FileError unless lowest <= value <= highest
void require_within(const files::JsonObject& object, const std::string& key, double value, double lowest,
                    double highest, const std::string& unit);

/// Numbers, so many at least and at most.
std::vector<double> number_list(files::JsonObject& object, const std::string& key, std::size_t least, std::size_t most);

/// The same, each greater than the one before.
std::vector<double> ascending_list(files::JsonObject& object, const std::string& key, std::size_t least,
                                   std::size_t most);

using NumberPairs = std::vector<std::pair<double, double>>;
/// [[x, y], ...] with ascending x: what stands over what, with the range and unit of y. 1 to 32 of them.
NumberPairs pair_list(files::JsonObject& object, const std::string& key, double lowest, double highest,
                      const std::string& unit);
files::Json pairs_to_json(const NumberPairs& pairs);

/// "KEY is what it is; allowed: ..." for what no single number tells.
[[noreturn]] void throw_field_defect(const files::JsonObject& object, const std::string& key, const std::string& value,
                                     const std::string& allowed, const std::string& remedy);

template <class T, std::size_t N>
void read_fields(files::JsonObject& object, const NumberField<T> (&fields)[N], T& to) {
  for (const NumberField<T>& field : fields) {
    to.*field.value = object.number(field.key);
    require_within(object, field.key, to.*field.value, field.lowest, field.highest, field.unit);
  }
}

template <class T, std::size_t N>
void write_fields(files::Json& json, const NumberField<T> (&fields)[N], const T& from) {
  for (const NumberField<T>& field : fields) json[field.key] = from.*field.value;
}

/// The object at `key` when it is these numbers and nothing else.
template <class T, std::size_t N>
T object_of(files::JsonObject& parent, const std::string& key, const NumberField<T> (&fields)[N]) {
  files::JsonObject object(parent.at(key), parent.file(), parent.key(key));
  T value{};
  read_fields(object, fields, value);
  object.refuse_unknown();
  return value;
}

template <class T, std::size_t N>
files::Json json_of(const NumberField<T> (&fields)[N], const T& from) {
  files::Json json = files::Json::object();
  write_fields(json, fields, from);
  return json;
}

}  // namespace ehm::engine_sim
