// SPDX-License-Identifier: Apache-2.0
#include "monitor/listen/wiring_check.h"

#include <spdlog/fmt/fmt.h>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/sensor_noise.h"
#include "idl/wire_values.h"
#include "monitor/checks/sample_time_watch.h"
#include "monitor/checks/sensor_check.h"
#include "monitor/checks/source_fit.h"
#include "monitor/dds/misfit_text.h"
#include "monitor/estimation/point_distance.h"
#include "monitor/listen/expectation.h"
#include "monitor/listen/suspicion.h"

namespace ehm::monitor {

namespace {

constexpr double clock_tolerance = 0.005;  // two clocks that run apart by more than this are not both right
constexpr double noise_ratio_max = 3.0, noise_ratio_min = 0.1;
constexpr std::uint64_t samples_for_noise = 50;

using Findings = std::vector<Finding>;

void error(Findings& findings, std::string text) {
  findings.push_back({true, std::move(text)});
}
void warning(Findings& findings, std::string text) {
  findings.push_back({false, std::move(text)});
}

constexpr std::uint64_t least_moves = 20;  // of a coarse clock, checks/sample_time_watch.h

/// The steps come from the sequence; a stamp that does not measure is a warning, unless the filter restarts for it.
void check_stamps(const SourceRecord& s, double restart_gap_s, Findings& findings) {
  if (s.unset > 0)
    warning(findings, fmt::format("source_time_ns is not set (0) in {} samples: the monitor takes the steps from the "
                                  "sequence, and cannot check the sample time",
                                  s.unset));
  if (s.stood > 0)
    warning(findings,
            fmt::format("source_time_ns repeats in {} samples: the source's clock is coarse or stands still", s.stood));
  if (s.longest_step_back_s > restart_gap_s)
    error(findings, fmt::format("source_time_ns stepped back by up to {:.3g} s: beyond {:.3g} s the monitor's filter "
                                "restarts",
                                s.longest_step_back_s, restart_gap_s));
  else if (s.set_back > 0)
    warning(findings, fmt::format("source_time_ns steps back in {} samples, by up to {:.3g} s", s.set_back,
                                  s.longest_step_back_s));
}

void check_order(const SourceRecord& s, double restart_gap_s, Findings& findings) {
  if (s.last.schema() != idl::schema_version)
    error(findings, fmt::format("schema is {}, this monitor reads {}", s.last.schema(), idl::schema_version));
  if (s.last.source_id() == 0) error(findings, "source_id is 0, which is reserved; number your sources from 1");
  if (s.samples > 1 && s.in_order == 0) error(findings, "sequence_number does not grow: add 1 a sample");
  if (s.repeated > 0 && s.in_order > 0)
    warning(findings, fmt::format("{} samples repeat the sequence_number before", s.repeated));
  if (s.overtaken > 0) warning(findings, fmt::format("{} samples came after a later one", s.overtaken));
  if (s.lost > 0) warning(findings, fmt::format("{} samples are missing in the sequence", s.lost));
  check_stamps(s, restart_gap_s, findings);
}

/// Where the stamps measure nothing, the monitor cannot tell another rate; we can.
void check_own_times(const SourceRecord& s, double sample_time_s, Findings& findings) {
  if (s.own.count > samples_for_noise && std::abs(s.own.mean_s() / sample_time_s - 1.0) > SampleTimeWatch::tolerance)
    error(findings, fmt::format("samples come every {:.6g} s by our clock, the design has {:.6g} s, and the stamps do "
                                "not tell the monitor",
                                s.own.mean_s(), sample_time_s));
}

void check_times(const SourceRecord& s, double sample_time_s, double stale_s, Findings& findings) {
  if (s.in_order == 0) return;
  const double source = s.source.mean_s() / sample_time_s, own = s.own.mean_s() / sample_time_s;
  const std::uint64_t silent = s.stood + s.unset;
  if (silent > 0 && s.in_order - std::min(s.in_order, silent) < least_moves) {
    check_own_times(s, sample_time_s, findings);
  } else if (std::abs(source - 1.0) > SampleTimeWatch::tolerance) {
    std::string hint = "the monitor withholds estimates of samples in another rate";
    for (const auto& [unit, factor] : {std::pair{"seconds", 1e-9}, {"milliseconds", 1e-6}, {"microseconds", 1e-3}})
      if (std::abs(source / factor - 1.0) < SampleTimeWatch::tolerance)
        hint = fmt::format("it looks like {}, nanoseconds are needed", unit);
    error(findings, fmt::format("source_time_ns grows by {:.6g} s a sample, the design has {:.6g} s: {}",
                                s.source.mean_s(), sample_time_s, hint));
  } else if (std::abs(own / source - 1.0) > clock_tolerance && s.own.count > samples_for_noise) {
    warning(findings, fmt::format("samples come every {:.6g} s by our clock, every {:.6g} s by the source's",
                                  s.own.mean_s(), s.source.mean_s()));
  }
  if (s.own.max_s > stale_s)
    warning(findings, fmt::format("the longest gap was {:.1f} ms; beyond {:.1f} ms the monitor says STALE",
                                  1e3 * s.own.max_s, 1e3 * stale_s));
}

/// Names and units by the source's own description; the fit of each channel, as the monitor makes it.
template <class Fits>
void check_names(const char* kind, const ChannelDescription* said, std::size_t count,
                 const std::vector<linear_model::Channel>& channels, Fits& fits, Findings& findings) {
  for (std::size_t i = 0; i < std::min(count, channels.size()); ++i) {
    const ChannelWords words{said[i].name().c_str(), said[i].unit().c_str()};
    fits[i] = fit_channel(words, channels, i);
    const std::string text = misfit_text(kind, i, words, "the source's description", channels, fits[i].misfit);
    if (fits[i].misfit != Misfit::none)
      error(findings, text);
    else if (fits[i].conversion.changes())
      warning(findings, text + "; the monitor converts");
  }
}

bool check_counts(const SourceRecord& s, const linear_model::LinearModel& model, Findings& findings) {
  const auto fits = [&](const char* kind, std::size_t sent, std::size_t wanted) {
    if (sent != wanted) error(findings, fmt::format("{}_count is {}, the design has {}", kind, sent, wanted));
    return sent == wanted;
  };
  const bool sensors = fits("sensor", s.last.sensor_count(), model.sensors.size());
  const bool actuators = fits("actuator", s.last.actuator_count(), model.controls.size());
  return sensors && actuators;
}

void check_values(const char* kind, const std::string& name, const ChannelRecord& c, Findings& findings) {
  if (c.not_finite > 0)
    error(findings,
          fmt::format("{} {}: NaN or infinite in {} samples although marked valid", kind, name, c.not_finite));
  else if (c.good == 0)
    error(findings, fmt::format("{} {}: its bit in sensor_valid was never set", kind, name));
  else if (c.invalid > 0)
    warning(findings, fmt::format("{} {}: marked invalid in {} samples", kind, name, c.invalid));
}

/// By what model and operator know of the sensor: an error where the monitor would find it stuck, else a hint.
bool repeats(const std::string& name, const ChannelRecord& c, const SensorKind& kind, Findings& findings) {
  if (c.longest_equal_run < static_cast<std::uint64_t>(kind.least)) return false;
  const std::int64_t limit = StuckWatch(kind).limit();
  if (limit != StuckWatch::never && c.longest_equal_run >= static_cast<std::uint64_t>(limit)) {
    error(findings, fmt::format("sensor {}: {} equal values in a row, the monitor takes it for stuck from {} on", name,
                                c.longest_equal_run, limit));
    return true;
  }
  if (kind.operators_limit >= 0 || kind.resolution > 0.0 || kind.update_samples > 0) return false;
  warning(findings, fmt::format("sensor {}: {} equal values in a row; coarse, slow or frozen? State its resolution and "
                                "update_period_s in the model",
                                name, c.longest_equal_run));
  return true;
}

/// `sigma`: what successive differences show of the design's noise.
void check_noise(const std::string& name, const ChannelRecord& c, const ChannelFit& fit, double sigma,
                 Findings& findings) {
  if (c.good < samples_for_noise || !(sigma > 0.0)) return;
  const double ratio = fit.conversion.of_differences()(c.noise()) / sigma;
  if (ratio > noise_ratio_max)
    warning(findings, fmt::format("sensor {}: noise is {:.1f} times the design's {:.3g}", name, ratio, sigma));
  if (ratio < noise_ratio_min)
    warning(findings, fmt::format("sensor {}: noise is only {:.2f} times the design's {:.3g}; filtered or coarse?",
                                  name, ratio, sigma));
}

bool at_design_point(const SourceRecord& s, const SourceFit& fit, const CycleOptions& options,
                     const linear_model::LinearModel& model) {
  Sample sample;
  sample.flight = {s.last.altitude_m(), s.last.mach(), s.last.delta_isa_k()};
  sample.actuator_count = s.last.actuator_count();
  std::copy(s.last.actuator().begin(), s.last.actuator().end(), sample.actuator.begin());
  fit.apply(sample);
  estimation::Conditions here{sample.flight, estimation::ActuatorVector(model.controls.size())};
  for (std::size_t i = 0; i < model.controls.size(); ++i) here.actuators(as_index(i)) = sample.actuator[i];
  return estimation::PointDistance(options.validity, model).of(here) <= 1.0;
}

}  // namespace

bool WiringReport::has_error() const {
  return std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.error; });
}

WiringReport check_wiring(const SourceRecord& s, const design::Design& design, const CycleOptions& options,
                          const EngineDescription* description) {
  const linear_model::LinearModel& model = design.model;
  WiringReport report;
  Findings& findings = report.findings;
  check_order(s, options.checks.restart_gap_s, findings);
  check_times(s, model.sample_time_s, options.stale_periods * model.sample_time_s, findings);
  SourceFit fit;
  if (description) {
    if (const double stated_s = description->sample_time_s();
        stated_s > 0.0 && std::abs(stated_s / model.sample_time_s - 1.0) > SampleTimeWatch::tolerance)
      error(findings, fmt::format("sample_time_s is {:.6g} by the source's description, {:.6g} by the design", stated_s,
                                  model.sample_time_s));
    check_names("sensor", description->sensors().data(), description->sensor_count(), model.sensors, fit.sensors,
                findings);
    check_names("actuator", description->actuators().data(), description->actuator_count(), model.controls,
                fit.actuators, findings);
  }
  if (!check_counts(s, model, findings)) return report;

  const auto actuators = as_index(model.controls.size());
  Eigen::VectorXd acting(actuators);
  for (Eigen::Index i = 0; i < actuators; ++i) {
    const auto k = as_size(i);
    check_values("actuator", model.controls[k].name, s.actuators[k], findings);
    acting(i) = fit.actuators[k].conversion(s.actuators[k].mean());
  }
  for (std::size_t i = 0; i < model.sensors.size(); ++i) {
    check_values("sensor", model.sensors[i].name, s.sensors[i], findings);
    const std::string& name = model.sensors[i].name;
    if (repeats(name, s.sensors[i], sensor_kind(options.checks, options.sensors, model, i), findings)) continue;
    // A sensor that holds each value for n samples steps once in n, by noise that is counted n times.
    const auto at = as_index(i);
    check_noise(name, s.sensors[i], fit.sensors[i],
                model.sensor_noise_sigma(at) / linear_model::held_samples(model, at), findings);
  }
  if (!acting.allFinite()) return report;
  const Expectation expectation = expect_sensors(model, acting);
  Eigen::VectorXd mean(expectation.value.size());
  for (Eigen::Index i = 0; i < mean.size(); ++i) {
    const auto k = as_size(i);
    mean(i) = fit.sensors[k].conversion(s.sensors[k].mean());
    report.sensors.push_back(
        {expectation.value(i), expectation.spread(i), (mean(i) - expectation.value(i)) / expectation.spread(i)});
  }
  const bool at_point = at_design_point(s, fit, options, model);
  if (!at_point)
    warning(
        findings,
        fmt::format("the engine is not at the design's point (altitude {:.0f} m, Mach {:.3f}, {:+.1f} K, actuators): "
                    "the monitor withholds estimates there, and plausibility is a hint only",
                    s.last.altitude_m(), s.last.mach(), s.last.delta_isa_k()));
  for (const std::string& text : suspicions(model.sensors, mean, expectation)) findings.push_back({at_point, text});
  return report;
}

}  // namespace ehm::monitor
