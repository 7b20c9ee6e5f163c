// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/identify_text.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <ostream>

#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

using Json = nlohmann::ordered_json;

constexpr double hour_s = 3600.0, misfit = 0.1, misfit_sigmas = 4.0;
constexpr const char* range_names[] = {"slow", "about the engine's time constants", "fast"};

/// One variance as standard deviations in a channel's unit.
struct Shown {
  std::string name, unit;
  double sigma, low, high;  ///< not told: high is the upper end
  double models;            ///< what the model counts with; 0: none
  bool told;
  double percent;  ///< of sigma in scaled units
};

Shown shown(const linear_model::Channel& channel, double scale, double models, const IdentifiedVariance& v) {
  return {channel.name, channel.unit, std::sqrt(v.value) * scale, std::sqrt(v.low) * scale, std::sqrt(v.high) * scale,
          models,       v.told,       std::sqrt(v.value)};
}

std::vector<Shown> shown_sensors(const IdentifiedNoise& noise) {
  std::vector<Shown> all;
  for (std::size_t i = 0; i < noise.sensors.size(); ++i) {
    if (!noise.sensors[i]) continue;
    const Eigen::Index at = as_index(i);
    all.push_back(
        shown(noise.model.sensors[i], noise.scaling.sensor(at), noise.model.sensor_noise_sigma(at), *noise.sensors[i]));
  }
  return all;
}

std::vector<Shown> shown_motion(const IdentifiedNoise& noise) {
  std::vector<Shown> all;
  for (std::size_t t = 0; t < noise.motion.size(); ++t) {
    const Eigen::Index j = noise.motion_terms[t].channel;
    if (j < 0)
      all.push_back(shown({"all, by the model's Q", "of the model's", 0.0}, 1.0, 1.0, noise.motion[t]));
    else
      all.push_back(shown(noise.model.states[as_size(j)], noise.scaling.state(j),
                          std::sqrt(noise.model.process_noise(j, j)), noise.motion[t]));
  }
  return all;
}

/// What a walk of this variance a sample comes to, percent.
double in_an_hour(const IdentifiedNoise& noise, double variance) {
  return std::sqrt(variance * hour_s / noise.model.sample_time_s);
}

double hertz(const IdentifiedNoise& noise, double radians) {
  return radians / (2.0 * std::numbers::pi * noise.model.sample_time_s);
}

void print_samples(const IdentifiedNoise& noise, const IdentifySource& source, std::ostream& out) {
  const SteadySelection& s = noise.selection;
  out << fmt::format("Noise of engine {} in {}, by the model of {} ({})\n", source.engine_id, source.recording,
                     source.model, noise.model.name);
  out << fmt::format("  samples     {} recorded, {} used: {:.4g} s steady at the model's point, in {} piece{}\n",
                     s.recorded, s.used, static_cast<double>(s.used) * noise.model.sample_time_s, s.segments.size(),
                     s.segments.size() == 1 ? "" : "s");
  out << fmt::format(
      "  left out    {} without a value, {} off the point, {} moving to another, {} in pieces of fewer than {}; {} not "
      "accepted\n",
      s.missing, s.off_point, s.moving, s.too_short, s.least_length, source.not_accepted);
  out << fmt::format("  mended      {} samples that lacked a value or were lost, from their neighbours\n",
                     noise.mended);
  out << fmt::format("  cut at      {} gaps, {} jumps of a sensor, {} drifts of the point\n", s.gaps, s.jumps,
                     s.drifts);
  out << fmt::format("  looked at   motions from {:.3g} Hz up\n", hertz(noise, noise.lowest_rad));
  for (std::size_t i = 0; i < noise.sensors.size(); ++i)
    if (!noise.sensors[i])
      out << fmt::format("  not used    {}: a tenth of its values or more are missing\n", noise.model.sensors[i].name);
}

void print_sigmas(const char* title, const std::vector<Shown>& rows, std::ostream& out) {
  out << fmt::format("\n{:<24}{:<15}{:>11}{:>12}    {:<12}{:>9}{:>12}{:>7}\n", title, "unit", "sigma", "95 %", "",
                     "percent", "model's", "ratio");
  for (const Shown& r : rows) {
    out << fmt::format("  {:<22}{:<15}", r.name, r.unit);
    if (r.told)
      out << fmt::format("{:>11.4g}{:>12.4g} .. {:<12.4g}{:>9.4f}", r.sigma, r.low, r.high, r.percent);
    else
      out << fmt::format("{:>11}{:>12}    {:<12.4g}{:>9}", "not told", "below", r.high, "");
    out << (r.models > 0.0 ? fmt::format("{:>12.4g}", r.models) : fmt::format("{:>12}", "none"));
    if (r.told && r.models > 0.0) out << fmt::format("{:>7.2f}", r.sigma / r.models);
    out << '\n';
  }
}

void print_walks(const IdentifiedNoise& noise, std::ostream& out) {
  const IdentifiedVariance& walk = noise.walk;
  out << "\nWalk of health Qh, h[k+1] = h[k] + g, percent^2 a sample\n";
  if (walk.told)
    out << fmt::format("  one for all parameters: {:.3g}, 95 % {:.3g} .. {:.3g}; in an hour {:.3g} %\n", walk.value,
                       walk.low, walk.high, in_an_hour(noise, walk.value));
  else
    out << fmt::format("  one for all parameters: not told, below {:.3g}; in an hour below {:.3g} %\n", walk.high,
                       in_an_hour(noise, walk.high));
  out << fmt::format("  one each: {} (at 1 %); condition {:.3g}\n",
                     noise.walks_differ ? "they differ" : "no difference is seen", noise.condition);
  for (std::size_t i = 0; i < noise.walks.size(); ++i) {
    const IdentifiedWalk& w = noise.walks[i];
    if (!w.seen) {
      out << fmt::format("  {:<22}no sensor sees it\n", noise.model.health[i].name);
      continue;
    }
    out << fmt::format("  {:<22}", noise.model.health[i].name);
    if (w.variance.told)
      out << fmt::format("{:>12.3g}{:>12.3g} .. {:<12.3g}", w.variance.value, w.variance.low, w.variance.high);
    else
      out << fmt::format("{:>12}{:>12}    {:<12.3g}", "not told", "below", w.variance.high);
    if (w.alike >= 0)
      out << fmt::format("most like {} ({:.2f})", noise.model.health[as_size(w.alike)].name, w.correlation);
    out << '\n';
  }
}

void print_remarks(const IdentifiedNoise& noise, std::ostream& out) {
  out << "\nIs the noise as modelled, independent and white?\n";
  for (const NoiseCheck& c : noise.checks) {
    const std::string& name = noise.model.sensors[as_size(c.sensor)].name;
    const std::string of =
        c.sensor == c.other ? fmt::format("{} is coloured: one sample and the next correlate by", name)
                            : fmt::format("{} and {} correlate by", name, noise.model.sensors[as_size(c.other)].name);
    out << fmt::format("  {} {:.3f} +- {:.3f}\n", of, c.correlation, c.standard_error);
  }
  if (noise.checks.empty()) out << "  nothing stands out among the sensors (at 1 % for all together)\n";
  for (std::size_t range = 0; range < noise.fit.size(); ++range) {
    const PowerRatio& fit = noise.fit[range];
    for (Eigen::Index i = 0; i < fit.ratio.size(); ++i) {
      if (std::abs(fit.ratio(i) - 1.0) <= std::max(misfit, misfit_sigmas * fit.standard_error)) continue;
      out << fmt::format(
          "  {}: measured power is {:.2f} +- {:.2f} of the fit's where it is {}: the model misses something\n",
          noise.model.sensors[as_size(noise.selection.sensors[as_size(i)])].name, fit.ratio(i), fit.standard_error,
          range_names[range]);
    }
  }
}

void print_advice(const IdentifiedNoise& noise, const IdentifySource& source, std::ostream& out) {
  const std::string model = source.out.empty() ? "M.json" : source.out;
  out << fmt::format(
      "\nInto a design\n  {} the model with this R and Q; of what is not told the model's, or the "
      "upper end where that is less\n",
      source.out.empty() ? "--out M.json writes" : model + " is");
  out << fmt::format("  tuner_design design --model {} --out D.json", model);
  out << (noise.walk.told
              ? fmt::format(" --qh {:.3g}: as fast as health walks; a larger --qh answers faster\n", noise.walk.value)
              : ": with --qh by the time the filter may take, since health walks slower\n");
}

Json variance_as_json(const IdentifiedVariance& v) {
  return {{"value", v.value}, {"standard_error", v.standard_error}, {"low", v.low}, {"high", v.high}, {"told", v.told}};
}

Json rows_as_json(const std::vector<Shown>& rows) {
  Json all = Json::array();
  for (const Shown& r : rows)
    all.push_back({{"name", r.name},
                   {"unit", r.unit},
                   {"sigma", r.sigma},
                   {"low", r.low},
                   {"high", r.high},
                   {"told", r.told},
                   {"percent", r.percent},
                   {"models_sigma", r.models}});
  return all;
}

Json walks_as_json(const IdentifiedNoise& noise) {
  Json all = Json::array();
  for (std::size_t i = 0; i < noise.walks.size(); ++i) {
    Json walk{{"name", noise.model.health[i].name}, {"seen", noise.walks[i].seen}};
    if (noise.walks[i].seen) walk.update(variance_as_json(noise.walks[i].variance));
    if (const int alike = noise.walks[i].alike; alike >= 0) {
      walk["most_like"] = noise.model.health[as_size(alike)].name;
      walk["correlation"] = noise.walks[i].correlation;
    }
    all.push_back(std::move(walk));
  }
  return all;
}

Json fit_as_json(const IdentifiedNoise& noise) {
  Json all = Json::array();
  for (std::size_t range = 0; range < noise.fit.size(); ++range) {
    Json power = Json::object();
    for (Eigen::Index i = 0; i < noise.fit[range].ratio.size(); ++i)
      power[noise.model.sensors[as_size(noise.selection.sensors[as_size(i)])].name] = noise.fit[range].ratio(i);
    all.push_back({{"range", range_names[range]},
                   {"measured_over_modelled", std::move(power)},
                   {"standard_error", noise.fit[range].standard_error}});
  }
  return all;
}

}  // namespace

void print_identified(const IdentifiedNoise& noise, const IdentifySource& source, std::ostream& out) {
  print_samples(noise, source, out);
  print_sigmas("Sensor noise R", shown_sensors(noise), out);
  print_sigmas("Process noise Q", shown_motion(noise), out);
  print_walks(noise, out);
  print_remarks(noise, out);
  print_advice(noise, source, out);
}

Json identified_as_json(const IdentifiedNoise& noise, const IdentifySource& source) {
  const SteadySelection& s = noise.selection;
  Json remarks = Json::array();
  for (const NoiseCheck& c : noise.checks)
    remarks.push_back({{"sensor", noise.model.sensors[as_size(c.sensor)].name},
                       {"kind", c.sensor == c.other ? "coloured" : "correlated"},
                       {"other", noise.model.sensors[as_size(c.other)].name},
                       {"correlation", c.correlation},
                       {"standard_error", c.standard_error}});
  return {{"recording", source.recording},
          {"model", source.model},
          {"name", noise.model.name},
          {"engine_id", source.engine_id},
          {"samples",
           {{"recorded", s.recorded},
            {"used", s.used},
            {"pieces", s.segments.size()},
            {"mended", noise.mended},
            {"without_value", s.missing},
            {"off_point", s.off_point},
            {"moving", s.moving},
            {"too_short", s.too_short},
            {"not_accepted", source.not_accepted},
            {"gaps", s.gaps},
            {"jumps", s.jumps},
            {"drifts", s.drifts}}},
          {"lowest_hz", hertz(noise, noise.lowest_rad)},
          {"sensors", rows_as_json(shown_sensors(noise))},
          {"states", rows_as_json(shown_motion(noise))},
          {"walk_percent2", variance_as_json(noise.walk)},
          {"walks_percent2", walks_as_json(noise)},
          {"walks_differ", noise.walks_differ},
          {"condition", noise.condition},
          {"remarks", std::move(remarks)},
          {"fit", fit_as_json(noise)},
          {"out", source.out}};
}

}  // namespace ehm::tuner_design
