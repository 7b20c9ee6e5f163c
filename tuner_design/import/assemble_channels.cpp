// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/import/assemble_channels.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

using linear_model::Channel;

/// One of the five lists, and what its variables begin with.
struct Kind {
  std::string variable;  ///< "sensor": sensor_names, sensor_units, sensor_trim
  std::string letter;    ///< of the names that stand in for missing ones
  std::string each;      ///< what a channel belongs to
};

/// Texts of one list; empty ones where nothing is stated.
std::vector<std::string> texts_of(const Variables& given, const std::string& name, std::size_t size,
                                  const std::string& each) {
  const auto it = given.texts.find(name);
  if (it == given.texts.end()) return std::vector<std::string>(size);
  if (it->second.size() == size) return it->second;
  files::throw_defect(given.source, name, std::to_string(it->second.size()) + " texts long", std::to_string(size),
                      "Give one for each " + each);
}

void tell(ImportedModel& result, const std::vector<Channel>& channels, const std::vector<bool>& chosen,
          const std::string& assumption) {
  if (std::find(chosen.begin(), chosen.end(), true) == chosen.end()) return;
  result.assumed.push_back(listed(channels, chosen) + ": " + assumption);
}

/// @returns true where neither trim nor unit is stated.
std::vector<bool> assemble_list(const Variables& given, const Kind& kind, std::size_t size, ImportedModel& result,
                                std::vector<Channel>& channels) {
  const auto names = texts_of(given, kind.variable + "_names", size, kind.each);
  const auto units = texts_of(given, kind.variable + "_units", size, kind.each);
  const Eigen::VectorXd trims = vector_of(given, kind.variable + "_trim", as_index(size), kind.each);
  std::vector<bool> percent(size), no_trim(size), no_unit(size), no_name(size);
  for (std::size_t i = 0; i < size; ++i) {
    const double trim = trims(as_index(i));
    const bool has_trim = std::isfinite(trim), has_unit = !units[i].empty();
    no_name[i] = names[i].empty();
    percent[i] = !has_trim && !has_unit;
    no_trim[i] = !has_trim && has_unit && units[i] != "percent" && units[i] != "%";
    no_unit[i] = has_trim && !has_unit;
    channels.push_back({no_name[i] ? kind.letter + std::to_string(i + 1) : names[i],
                        has_unit ? units[i] : (has_trim ? "unknown" : "percent"), has_trim ? trim : 0.0});
  }
  tell(result, channels, no_name, "named so, since " + kind.variable + "_names is not stated");
  tell(result, channels, percent, "in percent of trim already, since neither trim nor unit is stated");
  tell(result, channels, no_trim, "values are deviations from trim, since " + kind.variable + "_trim is not stated");
  tell(result, channels, no_unit, "unit \"unknown\", since " + kind.variable + "_units is not stated");
  return percent;
}

/// Health is relative to nominal: only the size of the unit is open.
void assemble_health(const Variables& given, bool in_percent, std::size_t size, ImportedModel& result) {
  const std::string each = "column of L";
  const auto names = texts_of(given, "health_names", size, each);
  const auto units = texts_of(given, "health_units", size, each);
  const Eigen::VectorXd trims = vector_of(given, "health_trim", as_index(size), each);
  const std::string unit = in_percent ? "percent" : "fraction";
  std::vector<bool> no_name(size), no_unit(size);
  for (std::size_t i = 0; i < size; ++i) {
    const double trim = trims(as_index(i));
    no_name[i] = names[i].empty();
    no_unit[i] = units[i].empty();
    result.model.health.push_back({no_name[i] ? "h" + std::to_string(i + 1) : names[i], no_unit[i] ? unit : units[i],
                                   std::isfinite(trim) ? trim : 0.0});
  }
  tell(result, result.model.health, no_name, "named so, since health_names is not stated");
  tell(result, result.model.health, no_unit,
       "columns of L, M, N are per " + std::string(in_percent ? "percent, as the sensors are" : "unit fraction") +
           ", since health_units is not stated");
}

}  // namespace

Eigen::VectorXd vector_of(const Variables& given, const std::string& name, Eigen::Index size, const std::string& each,
                          bool allow_scalar) {
  const Eigen::MatrixXd* values = given.find(name);
  if (values == nullptr || values->size() == 0) return Eigen::VectorXd::Constant(size, std::nan(""));
  if (allow_scalar && values->size() == 1) return Eigen::VectorXd::Constant(size, (*values)(0, 0));
  if (values->size() == size && (values->rows() == 1 || values->cols() == 1)) return values->reshaped();
  files::throw_defect(given.source, name, std::to_string(values->rows()) + " x " + std::to_string(values->cols()),
                      std::string(allow_scalar ? "one number or " : "") + "a vector of " + std::to_string(size),
                      "Give one number for each " + each);
}

std::string listed(const std::vector<Channel>& channels, const std::vector<bool>& chosen) {
  const bool all = std::find(chosen.begin(), chosen.end(), false) == chosen.end();
  if (all && channels.size() > 3) return channels.front().name + " to " + channels.back().name;
  std::string text;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (chosen[i]) text += (text.empty() ? "" : ", ") + channels[i].name;
  }
  return text;
}

void assemble_channels(const Variables& given, ImportedModel& result) {
  linear_model::LinearModel& model = result.model;
  const auto size = [](Eigen::Index value) { return as_size(value); };
  assemble_list(given, {"state", "x", "row of A"}, size(model.A.rows()), result, model.states);
  assemble_list(given, {"control", "u", "column of B"}, size(model.B.cols()), result, model.controls);
  const auto percent = assemble_list(given, {"sensor", "y", "row of C"}, size(model.C.rows()), result, model.sensors);
  assemble_list(given, {"auxiliary", "z", "row of F"}, size(model.F.rows()), result, model.auxiliary);
  const bool in_percent = std::find(percent.begin(), percent.end(), true) != percent.end();
  assemble_health(given, in_percent, size(model.L.cols()), result);
}

}  // namespace ehm::tuner_design
