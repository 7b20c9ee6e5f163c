// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/baseline_text.h"

#include <iomanip>
#include <ostream>

#include "deploy/runtime/files/csv_table.h"
#include "tuner_design/print/error_text.h"

namespace ehm::tuner_design {
namespace {

using Json = nlohmann::ordered_json;
using design::Design;

Json over_limit(double error, double limit) {
  return limit > 0.0 ? Json(error / limit) : Json(nullptr);
}

std::string ratio(double error, double limit) {
  return limit > 0.0 ? figure(error / limit, 10) : std::string(9, ' ') + "-";
}

}  // namespace

Json baselines_as_json(const Design& design, const std::vector<Baseline>& table) {
  const design::ErrorByChannel& limit = table.back().error;  // the Bayes limit of the linear engine
  Json result = Json::array();
  for (const Baseline& row : table) {
    result.push_back({{"name", row.name},
                      {"description", row.description},
                      {"ssee_health", errors_as_json(row.error.health, design.model.health)},
                      {"ssee_auxiliary", errors_as_json(row.error.auxiliary, design.model.auxiliary)},
                      {"over_limit_health", over_limit(row.error.health.sum(), limit.health.sum())},
                      {"over_limit_auxiliary", over_limit(row.error.auxiliary.sum(), limit.auxiliary.sum())},
                      {"slowest_time_constant_s",
                       row.slowest_time_constant_s ? Json(*row.slowest_time_constant_s) : Json(nullptr)}});
  }
  return result;
}

void print_baselines(const std::vector<Baseline>& table, std::ostream& out) {
  const design::ErrorByChannel& limit = table.back().error;  // the Bayes limit of the linear engine
  out << "  baseline              SSEE(h)    /limit    SSEE(z)    /limit  slowest, s\n";
  for (const Baseline& row : table) {
    out << "  " << std::left << std::setw(18) << row.name << std::right << figure(row.error.health.sum())
        << ratio(row.error.health.sum(), limit.health.sum()) << figure(row.error.auxiliary.sum())
        << ratio(row.error.auxiliary.sum(), limit.auxiliary.sum())
        << (row.slowest_time_constant_s ? figure(*row.slowest_time_constant_s, 12) : std::string(11, ' ') + "-")
        << '\n';
  }
  out << '\n';
  for (const Baseline& row : table) {
    out << "  " << std::left << std::setw(18) << row.name << std::right << row.description << '\n';
  }
}

std::string baselines_as_csv(const Design& design, const std::vector<Baseline>& table) {
  std::string text = "baseline,description,slowest_time_constant_s,ssee_health,ssee_auxiliary";
  for (const auto& channel : design.model.health) text += ',' + files::csv_cell(channel.name);
  for (const auto& channel : design.model.auxiliary) text += ',' + files::csv_cell(channel.name);
  text += '\n';
  for (const Baseline& row : table) {
    text += row.name + ',' + files::csv_cell(row.description) + ',';
    if (row.slowest_time_constant_s) text += files::shortest(*row.slowest_time_constant_s);
    text += ',' + files::shortest(row.error.health.sum()) + ',' + files::shortest(row.error.auxiliary.sum());
    for (const double error : row.error.health) text += ',' + files::shortest(error);
    for (const double error : row.error.auxiliary) text += ',' + files::shortest(error);
    text += '\n';
  }
  return text;
}

}  // namespace ehm::tuner_design
