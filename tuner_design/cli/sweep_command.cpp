// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/sweep_command.h"

#include <fmt/format.h>

#include <memory>
#include <ostream>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/long_work/parallel_for.h"
#include "monitor/design/design_file.h"
#include "tuner_design/design/response_time.h"

namespace ehm::tuner_design {
namespace {

struct Arguments {
  std::string design, csv;
  double from = 1e-6, to = 1e-1;
  int points = 16;
  unsigned threads = long_work::all_cores();
  OutputOptions output;
};

nlohmann::ordered_json as_json(const design::Design& design, const std::vector<ResponsePoint>& points) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const ResponsePoint& point : points)
    rows.push_back({{"qh_percent2", point.qh_percent2},
                    {"time_constant_s", point.time_constant_s},
                    {"health_bias", point.health_bias},
                    {"health_noise", point.health_noise},
                    {"ssee_health", point.health()},
                    {"auxiliary_bias", point.auxiliary_bias},
                    {"auxiliary_noise", point.auxiliary_noise},
                    {"ssee_auxiliary", point.auxiliary()},
                    {"linearisation_error_health", point.health_linearisation},
                    {"linearisation_error_auxiliary", point.auxiliary_linearisation},
                    {"closed_form_ssee_health", point.closed_form_health},
                    {"closed_form_ssee_auxiliary", point.closed_form_auxiliary},
                    {"objective", point.objective}});
  return {{"name", design.model.name},
          {"hash", design.hash},
          {"bayes_limit_health", design.bayes_limit.health.sum()},
          {"bayes_limit_auxiliary", design.bayes_limit.auxiliary.sum()},
          {"points", std::move(rows)}};
}

void print_sweep(const design::Design& design, const std::vector<ResponsePoint>& points, std::ostream& out) {
  out << fmt::format(
      "Response time against accuracy of {}, {} tuners searched anew at each Qh\n"
      "SSEE = bias + noise; limits: health {:.5g} percent^2, auxiliary {:.5g} (K^2, points^2, percent^2)\n\n"
      "{:>12}{:>15}{:>12}{:>12}{:>12}{:>14}{:>12}{:>12}{:>12}{:>14}\n",
      design.model.name, design.full.V.rows(), design.bayes_limit.health.sum(), design.bayes_limit.auxiliary.sum(),
      "Qh, %^2", "slowest tau, s", "bias(h)", "noise(h)", "SSEE(h)", "closed form", "bias(z)", "noise(z)", "SSEE(z)",
      "closed form");
  for (const ResponsePoint& point : points) {
    out << fmt::format("{:12.4g}{:15.4g}{:12.5g}{:12.5g}{:12.5g}{:14.5g}{:12.5g}{:12.5g}{:12.5g}{:14.5g}\n",
                       point.qh_percent2, point.time_constant_s, point.health_bias, point.health_noise, point.health(),
                       point.closed_form_health, point.auxiliary_bias, point.auxiliary_noise, point.auxiliary(),
                       point.closed_form_auxiliary);
  }
}

void sweep(const Arguments& arguments, const Console& console) {
  if (!(arguments.from < arguments.to))
    throw CLI::ValidationError("--qh-from", fmt::format("{} is not below --qh-to {}", arguments.from, arguments.to));
  const design::Design design = design::read_design(arguments.design);
  const std::vector<double> steps = logarithmic_steps(arguments.from, arguments.to, arguments.points);
  std::vector<ResponsePoint> points;
  {
    long_work::ProgressBar bar = progress_bar(console, arguments.output, steps.size());
    points = response_sweep(design, steps, arguments.threads, [&](std::size_t done) { bar.show(done); });
  }
  if (!arguments.csv.empty()) {
    require_other_file("--csv", arguments.csv, {arguments.design});
    files::write_file_atomically(arguments.csv, response_csv(points));
  }
  print_result(
      console, arguments.output, [&] { return as_json(design, points); },
      [&](std::ostream& out) { print_sweep(design, points, out); });
}

}  // namespace

void add_sweep_command(CLI::App& app, Action& run) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("sweep", "Response time against accuracy of a design, over a range of Qh");
  command->add_option("design", arguments->design, "Design file")->required()->type_name("D.json");
  const auto qh = [&](const char* name, double& value, const char* what) {
    command->add_option(name, value, what)->check(CLI::Range(1e-12, 100.0))->capture_default_str();
  };
  qh("--qh-from", arguments->from, "Least process noise of a health parameter, percent^2 per sample");
  qh("--qh-to", arguments->to, "Largest");
  command->add_option("--points", arguments->points, "Values of Qh, evenly spaced in the logarithm")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  command->add_option("--csv", arguments->csv, "Write the table to this file too")->type_name("F.csv");
  command->add_option("--threads", arguments->threads, "The result does not depend on it; default: one a core")
      ->check(CLI::Range(1, 1024));
  add_output_options(*command, arguments->output);
  command->callback([arguments, &run] { run = [arguments](const Console& console) { sweep(*arguments, console); }; });
}

}  // namespace ehm::tuner_design
