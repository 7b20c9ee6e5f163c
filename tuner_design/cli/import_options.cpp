// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/cli/import_options.h"

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/files/json_object.h"

namespace ehm::tuner_design {
namespace {

/// Finite and within the range, which CLI::Range does not ask of NaN.
CLI::Validator within(double least, double most) {
  const std::string range = files::shown(least) + " to " + files::shown(most);
  return {[=](const std::string& text) -> std::string {
            const auto value = files::parse_number(text);
            return value && *value >= least && *value <= most ? "" : "'" + text + "' is not a number from " + range;
          },
          range};
}

std::string with_default(const std::string& text, double value) {
  return text + "; if neither is given: " + files::shown(value);
}

}  // namespace

void add_import_options(CLI::App& command, ImportOptions& options) {
  const auto group = "For matrices (.mat, CSV) that do not state it themselves";
  const auto add = [&](const char* name, std::optional<double>& value, const std::string& help, double least,
                       double most) {
    command.add_option(name, value, help)->check(within(least, most))->group(group);
  };
  add("--sample-time", options.sample_time_s, "Sample time of a continuous model, s", 1e-4, 10.0);
  add("--health-sigma", options.health_sigma_percent,
      with_default("Health: standard deviation over the fleet, percent", ImportOptions::default_health_sigma_percent),
      1e-6, 100.0);
  add("--sensor-noise", options.sensor_noise_percent,
      with_default("Sensors: standard deviation of one sample, percent of trim",
                   ImportOptions::default_sensor_noise_percent),
      1e-9, 100.0);
  add("--process-noise", options.process_noise_percent,
      with_default("States: standard deviation of w per sample, percent of trim",
                   ImportOptions::default_process_noise_percent),
      1e-9, 100.0);
}

}  // namespace ehm::tuner_design
