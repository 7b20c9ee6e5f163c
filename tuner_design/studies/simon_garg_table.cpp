// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/studies/simon_garg_table.h"

#include <fmt/format.h>

#include <ostream>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/studies/published_tables.h"

namespace ehm::tuner_design {
namespace {

constexpr double rankine2_per_kelvin2 = 3.24;

/// The channels of the table in the paper's units, then their sum.
std::vector<double> in_paper_units(const SimonGargStudy& study, const design::ErrorByChannel& errors, bool variance) {
  std::vector<double> values;
  double total = 0.0;
  const Eigen::VectorXd& own = study.of_health() ? errors.health : errors.auxiliary;
  for (Eigen::Index i = 0; i < own.size(); ++i) {
    const bool kelvin = !study.of_health() && study.scaling.auxiliary_unit[as_size(i)] == "K";
    values.push_back((kelvin ? rankine2_per_kelvin2 : 1.0) * own(i));
    total += variance ? values.back() : 0.0;
  }
  if (variance) values.push_back(total);
  return values;
}

/// Column names over two lines, parted at the first underscore.
void print_heads(const std::vector<std::string>& columns, int width, std::ostream& out) {
  std::string upper = fmt::format("\n{:44}", ""), lower = fmt::format("{:<44}", "tuners");
  for (const std::string& column : columns) {
    const auto part = column.find('_');
    const bool two = part != std::string::npos && static_cast<int>(column.size()) >= width;
    upper += fmt::format("{:>{}}", two ? column.substr(0, part) : "", width);
    lower += fmt::format("{:>{}}", two ? column.substr(part + 1) : column, width);
  }
  out << upper << '\n' << lower << '\n';
}

}  // namespace

std::string study_title(const SimonGargStudy& study) {
  switch (study.options.table) {
    case 4:
      return "Table 4: MAP estimator, health parameters, squared error in percent^2";
    case 5:
      return "Table 5: MAP estimator, auxiliary outputs, squared error";
    case 6:
      return "Table 6: Kalman filter, health parameters, squared error in percent^2";
    default:
      return "Table 7: Kalman filter, auxiliary outputs, squared error";
  }
}

std::vector<std::string> table_columns(const SimonGargStudy& study) {
  std::vector<std::string> columns;
  const auto& channels = study.of_health() ? study.model.health : study.model.auxiliary;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    std::string unit = study.of_health() ? "percent" : study.scaling.auxiliary_unit[i];
    if (unit == "K") unit = "degR";
    columns.push_back(study.of_health() ? channels[i].name : channels[i].name + " [" + unit + "^2]");
  }
  columns.push_back(study.of_health() ? "SSEE(h)" : "SSEE(z)");
  return columns;
}

std::vector<TableLine> table_lines(const SimonGargStudy& study) {
  std::vector<TableLine> lines;
  for (const StudyRow& row : study.rows) {
    const bool limit = row.experiment.health.size() == 0;
    lines.push_back(
        {row.group, row.tuners, limit ? "limit" : "theory", "ours", in_paper_units(study, row.theory, true)});
    if (limit) continue;
    lines.push_back({row.group, row.tuners, "experiment", "ours", in_paper_units(study, row.experiment, true)});
  }
  const auto columns = table_columns(study).size();
  for (const PublishedRow& row : published_table(study.options.table)) {
    if (published_channels(study.options.table) + 1 != columns) break;
    lines.push_back({"",
                     row.tuners,
                     row.experiment ? "experiment" : "theory",
                     "published, C-MAPSS",
                     {row.values.begin(), row.values.begin() + static_cast<std::ptrdiff_t>(columns)}});
  }
  return lines;
}

std::string study_csv(const SimonGargStudy& study) {
  std::string text = "source,tuners,group,kind";
  for (const std::string& column : table_columns(study)) text += "," + column;
  text += '\n';
  for (const TableLine& line : table_lines(study)) {
    text += fmt::format("\"{}\",{},{},{}", line.source, line.tuners, line.group, line.kind);
    for (const double value : line.values) text += fmt::format(",{}", value);
    text += '\n';
  }
  return text;
}

nlohmann::ordered_json study_as_json(const SimonGargStudy& study) {
  nlohmann::ordered_json lines = nlohmann::ordered_json::array();
  for (const TableLine& line : table_lines(study))
    lines.push_back({{"source", line.source},
                     {"tuners", line.tuners},
                     {"group", line.group},
                     {"kind", line.kind},
                     {"values", line.values}});
  return {{"table", study.options.table}, {"engine", study.model.name},
          {"truth", study.truth},         {"qh_percent2", study.options.qh_percent2},
          {"seed", study.options.seed},   {"columns", table_columns(study)},
          {"lines", std::move(lines)}};
}

void print_study(const SimonGargStudy& study, std::ostream& out) {
  const int width = study.of_health() ? 12 : 16;
  out << study_title(study) << "\nEngine: " << study.model.name << "\nTruth: " << study.truth << '\n';
  if (study.options.table >= 6) out << fmt::format("Qh {} percent^2 per sample\n", study.options.qh_percent2);
  print_heads(table_columns(study), width, out);
  std::string group, source = "ours";
  for (const TableLine& line : table_lines(study)) {
    if (line.source != source) {
      source = line.source;
      group.clear();
      out << "\nPublished, Simon & Garg, NASA/TM-2010-216077: another engine (C-MAPSS), for context only\n";
    }
    const bool lettered = line.tuners.size() == 1;
    const std::string name = line.group.empty() && !lettered ? line.tuners : line.group;
    out << fmt::format("{:<31}{:<2}{:<11}", name == group ? "" : name, lettered ? line.tuners : "", line.kind);
    group = name;
    for (const double value : line.values) out << fmt::format("{:>{}.4g}", value, width);
    out << '\n';
  }
}

}  // namespace ehm::tuner_design
