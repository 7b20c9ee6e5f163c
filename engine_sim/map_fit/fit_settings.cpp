// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/map_fit/fit_settings.h"

#include <algorithm>
#include <set>

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/map_fit/checked_numbers.h"

namespace ehm::engine_sim {
namespace {

using files::JsonObject;
using files::shown;
using files::throw_defect;

constexpr const char* lower_letters = "abcdefghijklmnopqrstuvwxyz";
constexpr const char* digits = "0123456789";

void allow_comment(JsonObject& object) {
  if (object.find("why") != nullptr) object.text("why");
}

std::string name_of_code(JsonObject& object, const std::string& key, bool upper_case_too) {
  const std::string text = object.text(key);
  const std::string probe = upper_case_too ? lower_case(text) : text;
  const bool good = std::string(lower_letters).find(probe.front()) != std::string::npos &&
                    probe.find_first_not_of(std::string(lower_letters) + digits + "_") == std::string::npos;
  if (good) return text;
  throw_defect(object.file(), object.key(key), shown(files::Json(text)),
               std::string("a letter, then letters, digits and _") + (upper_case_too ? "" : ", in lower case"),
               "It names code; correct it");
}

std::string folder_of_include(JsonObject& object) {
  if (object.find("include_folder") == nullptr) return {};
  const std::string text = object.text("include_folder");
  const std::string allowed = std::string(lower_letters) + "ABCDEFGHIJKLMNOPQRSTUVWXYZ" + digits + "_-./";
  if (text.find_first_not_of(allowed) == std::string::npos && text.front() != '/' && text.back() != '/') return text;
  throw_defect(object.file(), object.key("include_folder"), shown(files::Json(text)),
               "a relative folder of letters, digits, _ - . and /, without / at its ends", "Correct it");
}

std::string one_line(JsonObject& object, const std::string& key) {
  const std::string text = object.text(key);
  const bool control = std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; });
  // a backslash at its end would make the next line of the generated code a comment too
  if (!control && text.back() != '\\') return text;
  throw_defect(object.file(), object.key(key), shown(files::Json(text)),
               "one line of text that does not end in a backslash", "Correct it");
}

std::vector<double> breaks(JsonObject& object, const std::string& key, double low, double high) {
  return ascending_numbers(object, key, 2, 40, low, high);
}

std::optional<PathSettings> path(JsonObject& object, const std::string& key) {
  const files::Json* json = object.find(key);
  if (json == nullptr) return {};
  return read_path_settings(*json, object.file(), object.key(key));
}

std::optional<Corner> corner(JsonObject& object) {
  const files::Json* json = object.find("corner");
  if (json == nullptr) return {};
  JsonObject inner(*json, object.file(), object.key("corner"));
  Corner c{};
  c.at = number_between(inner, "at", 0.01, 3.0);
  c.moved_to = number_between(inner, "moved_to", c.at, 3.0);
  allow_comment(inner);
  inner.refuse_unknown();
  return c;
}

CompressorSettings compressor(const files::Json& json, const SettingsPlace& place) {
  JsonObject object(json, place.file, place.key);
  CompressorSettings s{};
  s.place = place;
  s.name = name_of_code(object, "name", true);
  s.flow_exponent = number_between(object, "flow_exponent", 0.1, 10.0);
  s.pressure_exponent = number_between(object, "pressure_exponent", 0.1, 10.0);
  s.speed_breaks = breaks(object, "speed_breaks", 0.001, 5.0);
  s.r_line_breaks = breaks(object, "r_line_breaks", 0.0, 100.0);
  s.surge_flow_breaks = breaks(object, "surge_flow_breaks", 1e-6, 1e6);
  s.corner = corner(object);
  s.straight_flow = path(object, "straight_flow");
  s.straight_efficiency = path(object, "straight_efficiency");
  allow_comment(object);
  object.refuse_unknown();
  return s;
}

TurbineSettings turbine(const files::Json& json, const SettingsPlace& place) {
  JsonObject object(json, place.file, place.key);
  TurbineSettings s{};
  s.place = place;
  s.name = name_of_code(object, "name", true);
  s.choking_rate = number_between(object, "choking_rate", 0.01, 100.0);
  s.speed_breaks = breaks(object, "speed_breaks", 1e-3, 1e4);
  s.pressure_ratio_breaks = breaks(object, "pressure_ratio_breaks", 1.0, 100.0);
  allow_comment(object);
  object.refuse_unknown();
  return s;
}

template <class Settings, class Read>
std::vector<Settings> maps(JsonObject& root, const std::string& key, const Read& read, std::set<std::string>& names) {
  std::vector<Settings> all;
  for (const files::Json& json : root.array(key)) {
    const SettingsPlace place{root.file(), key + "[" + std::to_string(all.size()) + "]"};
    all.push_back(read(json, place));
    if (!names.insert(lower_case(all.back().name)).second) {
      throw_defect(place.file, place.key + ".name", shown(files::Json(all.back().name)),
                   "a name that no other map has, in upper or lower case", "Rename or remove one of them");
    }
  }
  return all;
}

}  // namespace

FitSettings read_fit_settings(const std::string& file) {
  const files::Json json = files::parse_json_file(file);
  JsonObject root(json, file, "");
  FitSettings s;
  s.file = file;
  s.name_space = name_of_code(root, "namespace", false);
  s.include_folder = folder_of_include(root);
  s.source = one_line(root, "source");
  std::set<std::string> names;
  s.compressors = maps<CompressorSettings>(root, "compressors", compressor, names);
  s.turbines = maps<TurbineSettings>(root, "turbines", turbine, names);
  allow_comment(root);
  root.refuse_unknown();
  if (names.empty()) {
    throw_defect(file, "compressors", "empty, as turbines is", "at least one map in one of them", "Describe a map");
  }
  return s;
}

std::string lower_case(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return name;
}

}  // namespace ehm::engine_sim
