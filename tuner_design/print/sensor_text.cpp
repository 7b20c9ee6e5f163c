// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/sensor_text.h"

#include <algorithm>
#include <bit>
#include <iomanip>
#include <ostream>

#include "deploy/runtime/files/csv_table.h"
#include "tuner_design/print/error_text.h"

namespace ehm::tuner_design {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> names_of(const SensorProblem& problem, CandidateSet set) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < problem.model.sensors.size(); ++i) {
    if ((set >> i & 1U) != 0) names.push_back(problem.model.sensors[i].name);
  }
  return names;
}

Json value_as_json(const SensorProblem& problem, const std::optional<SensorSetValue>& value) {
  if (!value) return nullptr;
  return {{"j", value->merit},
          {"ssee_health", errors_as_json(value->error.health, problem.model.health)},
          {"ssee_auxiliary", errors_as_json(value->error.auxiliary, problem.model.auxiliary)},
          {"tuners", value->tuners},
          {"slowest_time_constant_s", value->slowest_time_constant_s}};
}

/// J, SSEE(h), SSEE(z) and the time constant.
std::string figures_of(const std::optional<SensorSetValue>& value) {
  if (!value) return "  no filter: none keeps sigma within the fleet's own";
  return figure(value->merit) + figure(value->error.health.sum()) + figure(value->error.auxiliary.sum()) +
         figure(value->slowest_time_constant_s, 12);
}

}  // namespace

Json sensors_as_json(const SensorProblem& problem, const SensorReport& report) {
  Json points = Json::array();
  for (const FrontPoint& point : report.front.points) {
    Json entry{{"cost", point.cost}, {"sensors", names_of(problem, point.sensors)}};
    entry.update(value_as_json(problem, point.value));
    points.push_back(std::move(entry));
  }
  Json single = Json::object();
  for (std::size_t i = 0; i < report.without.size(); ++i) {
    single[problem.model.sensors[i].name] = {{"cost", report.choice.cost[i]},
                                             {"without", value_as_json(problem, report.without[i])}};
  }
  return {{"name", problem.model.name},
          {"qh_percent2", problem.qh_percent2},
          {"j_without_sensors", report.without_any},
          {"front", std::move(points)},
          {"sets", report.front.sets},
          {"filters_designed", report.front.filters},
          {"all_candidates", value_as_json(problem, report.all)},
          {"single_sensors", std::move(single)}};
}

void print_sensors(const SensorProblem& problem, const SensorReport& report, std::ostream& out) {
  out << problem.model.name << ": " << problem.model.sensors.size() << " candidate sensors, Qh " << problem.qh_percent2
      << " percent^2 per sample\n"
      << "J adds SSEE(h) and SSEE(z), each over its limit with all candidates (over what the fleet itself gives where "
         "that\n"
      << "limit is zero); without any sensor J is " << figure(report.without_any, 0) << "\n\n"
      << "       cost          J    SSEE(h)    SSEE(z)  slowest, s  sensors\n";
  for (const FrontPoint& point : report.front.points) {
    out << figure(point.cost) << figures_of(point.value) << ' ';
    for (const std::string& name : names_of(problem, point.sensors)) out << ' ' << name;
    out << '\n';
  }
  if (report.front.points.empty())
    out << "  no set of sensors is worth its noise: every sigma would exceed the fleet's\n";
  out << "  " << report.front.sets << " sets, " << report.front.filters << " filters designed\n\n"
      << "  all but             cost          J    SSEE(h)    SSEE(z)  slowest, s\n"
      << "  " << std::left << std::setw(13) << "(none)" << std::right
      << figure(cost_of(problem.every(), report.choice.cost)) << figures_of(report.all) << '\n';
  for (std::size_t i = 0; i < report.without.size(); ++i) {
    const CandidateSet rest = problem.every() & ~(CandidateSet{1} << i);
    out << "  " << std::left << std::setw(13) << problem.model.sensors[i].name << std::right
        << figure(cost_of(rest, report.choice.cost)) << figures_of(report.without[i]) << '\n';
  }
}

std::string front_as_csv(const SensorProblem& problem, const SensorFront& front) {
  std::string text = "cost,j,ssee_health,ssee_auxiliary,slowest_time_constant_s,tuners";
  for (const auto& sensor : problem.model.sensors) text += ',' + files::csv_cell(sensor.name);
  text += '\n';
  for (const FrontPoint& point : front.points) {
    const SensorSetValue& value = point.value;
    for (const double number : {point.cost, value.merit, value.error.health.sum(), value.error.auxiliary.sum(),
                                value.slowest_time_constant_s})
      text += files::shortest(number) + ',';
    text += std::to_string(value.tuners);
    for (std::size_t i = 0; i < problem.model.sensors.size(); ++i) text += (point.sensors >> i & 1U) != 0 ? ",1" : ",0";
    text += '\n';
  }
  return text;
}

}  // namespace ehm::tuner_design
