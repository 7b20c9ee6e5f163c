// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/evaluation_text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <ostream>
#include <sstream>
#include <vector>

#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

using Json = nlohmann::ordered_json;
using design::Design;

/// What is reported of one channel, or of a total.
struct Row {
  std::string channel, unit;
  double theory = 0.0, linearisation = 0.0, settled = 0.0, experiment = 0.0, standard_error = 0.0;
  std::optional<double> coverage, coverage_standard_error;

  double off_by() const { return (experiment - theory - linearisation) / standard_error; }
};

struct Part {
  std::vector<Row> channels;
  Row total;
};

Part part_of(const Experiment& each, const std::vector<linear_model::Channel>& channels,
             const std::vector<std::string>& units, Eigen::VectorXd design::ErrorByChannel::*member,
             double ErrorTotals::*total) {
  Part part;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const auto at = [&](const design::ErrorByChannel& errors) { return (errors.*member)(as_index(i)); };
    Row row{channels[i].name,
            units[i],
            at(each.theory),
            at(each.linearisation),
            at(each.settled),
            at(each.experiment),
            at(each.standard_error),
            {},
            {}};
    if ((each.coverage.*member).size() > 0) {
      row.coverage = at(each.coverage);
      row.coverage_standard_error = at(each.coverage_standard_error);
    }
    part.channels.push_back(row);
  }
  const auto sum = [&](const design::ErrorByChannel& errors) { return (errors.*member).sum(); };
  const bool one_unit = std::adjacent_find(units.begin(), units.end(), std::not_equal_to<>()) == units.end();
  part.total = {"total",
                one_unit && !units.empty() ? units.front() : "mixed",
                sum(each.theory),
                sum(each.linearisation),
                sum(each.settled),
                sum(each.experiment),
                each.standard_error_of_total.*total,
                {},
                {}};
  return part;
}

Part health_part(const Experiment& each, const Design& design) {
  const std::vector<std::string> units(design.model.health.size(), "percent");
  return part_of(each, design.model.health, units, &design::ErrorByChannel::health, &ErrorTotals::health);
}

Part auxiliary_part(const Experiment& each, const Design& design) {
  return part_of(each, design.model.auxiliary, design.scaling.auxiliary_unit, &design::ErrorByChannel::auxiliary,
                 &ErrorTotals::auxiliary);
}

Json as_json(const Row& row) {
  Json json = {{"theory", row.theory},         {"linearisation", row.linearisation},   {"settled", row.settled},
               {"experiment", row.experiment}, {"standard_error", row.standard_error}, {"off_by", row.off_by()}};
  if (row.coverage) {
    json["coverage"] = *row.coverage;
    json["coverage_standard_error"] = *row.coverage_standard_error;
  }
  return json;
}

Json as_json(const Part& part) {
  Json by_channel = Json::object();
  for (const Row& row : part.channels) by_channel[row.channel] = as_json(row);
  return {{"total", as_json(part.total)}, {"by_channel", std::move(by_channel)}};
}

std::string figure(double value, int width) {
  std::ostringstream text;
  text << std::setw(width) << std::setprecision(5) << value;
  return text.str();
}

std::string fixed(double value, int width, int digits) {
  std::ostringstream text;
  text << std::setw(width) << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

void print_row(const Row& row, bool nonlinear, int width, std::ostream& out) {
  out << "  " << std::left << std::setw(width) << row.channel << std::right << figure(row.theory, 11);
  if (nonlinear) out << figure(row.linearisation, 11);
  out << figure(row.experiment, 12) << figure(row.standard_error, 11) << fixed(row.off_by(), 9, 2);
  if (row.coverage) {
    out << fixed(100.0 * *row.coverage, 11, 1) << " +-" << fixed(100.0 * *row.coverage_standard_error, 4, 1);
  } else {
    out << std::string(18, ' ');
  }
  out << "  " << row.unit << '\n';
}

void print_part(const std::string& what, const Part& part, bool nonlinear, int width, std::ostream& out) {
  if (part.channels.empty()) return;
  out << "  " << std::left << std::setw(width) << what << std::right << std::setw(11) << "theory";
  if (nonlinear) out << std::setw(11) << "nonlinear";
  out << std::setw(12) << "experiment" << std::setw(11) << "std error" << std::setw(9) << "off by"
      << (part.channels.front().coverage ? "    coverage, %  " : std::string(18, ' ')) << "  root of unit\n";
  for (const Row& row : part.channels) print_row(row, nonlinear, width, out);
  print_row(part.total, nonlinear, width, out);
}

int widest_name(const Design& design) {
  std::size_t width = 9;
  for (const auto* channels : {&design.model.health, &design.model.auxiliary})
    for (const linear_model::Channel& channel : *channels) width = std::max(width, channel.name.size());
  return static_cast<int>(width);
}

}  // namespace

Json evaluation_as_json(const Evaluation& evaluation, const Design& design, const EvaluateOptions& options) {
  Json units = Json::object();
  for (std::size_t i = 0; i < design.model.auxiliary.size(); ++i)
    units[design.model.auxiliary[i].name] = design.scaling.auxiliary_unit[i];
  Json experiments = Json::array();
  for (const Experiment& each : evaluation.experiments) {
    experiments.push_back({{"estimator", each.estimator},
                           {"truth", each.truth},
                           {"nonlinear", each.nonlinear},
                           {"engines", each.engines},
                           {"without_steady_point", each.without_steady_point},
                           {"health", as_json(health_part(each, design))},
                           {"auxiliary", as_json(auxiliary_part(each, design))}});
  }
  return {{"name", design.model.name},
          {"hash", design.hash},
          {"runs", options.runs},
          {"engines", options.engines},
          {"seconds", options.seconds},
          {"window_s", options.window},
          {"seed", options.seed},
          {"process_noise", options.process_noise},
          {"wear", options.wear},
          {"auxiliary_unit", std::move(units)},
          {"experiments", std::move(experiments)}};
}

void print_evaluation(const Evaluation& evaluation, const Design& design, const EvaluateOptions& options,
                      std::ostream& out) {
  out << "Theory against experiment for " << design.model.name << ", seed " << options.seed << '\n'
      << "Squared errors; off by: difference from theory"
      << (options.nonlinear ? " (and nonlinear, where it stands)" : "") << " in standard errors\n";
  const int width = widest_name(design);
  for (const Experiment& each : evaluation.experiments) {
    out << '\n' << each.estimator << ", " << each.engines << " engines";
    const bool flown = each.coverage.health.size() > 0;
    if (flown) out << ", last " << options.window << " s of " << options.seconds << " s from a cold start";
    out << "\nTruth: " << each.truth << '\n';
    if (each.without_steady_point > 0)
      out << each.without_steady_point << " engines left out: no steady point with their health\n";
    print_part("health", health_part(each, design), each.nonlinear, width, out);
    print_part("auxiliary", auxiliary_part(each, design), each.nonlinear, width, out);
    if (flown && !each.nonlinear && design.linearisation.health.sum() > 0.0)
      out << "  coverage: the published sigma also allows for nonlinearity, which this truth does not have\n";
  }
}

std::string evaluation_as_csv(const Evaluation& evaluation, const Design& design) {
  std::ostringstream text;
  text << std::setprecision(17)
       << "estimator,truth,channel,unit_squared,theory,linearisation,settled,experiment,standard_error,off_by,coverage,"
          "coverage_standard_error\n";
  for (const Experiment& each : evaluation.experiments) {
    const auto write = [&](const Row& row, const std::string& kind) {
      text << '"' << each.estimator << "\"," << (each.nonlinear ? "nonlinear" : "linear") << ','
           << (row.channel == "total" ? kind + " total" : row.channel) << ',' << row.unit << ',' << row.theory << ','
           << row.linearisation << ',' << row.settled << ',' << row.experiment << ',' << row.standard_error << ','
           << row.off_by() << ',';
      if (row.coverage) text << *row.coverage << ',' << *row.coverage_standard_error << '\n';
      if (!row.coverage) text << ",\n";
    };
    for (const auto& [part, kind] :
         {std::pair{health_part(each, design), "health"}, std::pair{auxiliary_part(each, design), "auxiliary"}}) {
      for (const Row& row : part.channels) write(row, kind);
      if (!part.channels.empty()) write(part.total, kind);
    }
  }
  return text.str();
}

}  // namespace ehm::tuner_design
