// SPDX-License-Identifier: Apache-2.0
#include "monitor/listen/listen_report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "deploy/runtime/numbers/index.h"

namespace ehm::monitor {

namespace {

using nlohmann::json;

bool has_error(const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.error; });
}

std::string findings_text(const std::vector<Finding>& findings, const char* indent) {
  std::string text;
  for (const Finding& f : findings) text += fmt::format("{}{}: {}\n", indent, f.error ? "ERROR" : "warning", f.text);
  return text;
}

std::string channels_text(const SourceFindings& s) {
  const auto& model = s.design->model;
  std::string text = fmt::format("  {:<14}{:<10}{:>12}{:>12}{:>11}{:>11}{:>12}{:>10}{:>9}\n", "channel", "unit", "last",
                                 "mean", "noise", "(design)", "expected", "+-", "off by");
  for (std::size_t i = 0; i < std::min<std::size_t>(model.controls.size(), s.record.last.actuator_count()); ++i) {
    const ChannelRecord& c = s.record.actuators[i];
    text += fmt::format("  {:<14}{:<10}{:>12.6g}{:>12.6g}{:>11.3g}{:>11}{:>12.6g}{:>10}{:>9}\n", model.controls[i].name,
                        model.controls[i].unit, c.last, c.mean(), c.noise(), "actuator", model.controls[i].trim, "trim",
                        "");
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(model.sensors.size(), s.record.last.sensor_count()); ++i) {
    const ChannelRecord& c = s.record.sensors[i];
    text += fmt::format("  {:<14}{:<10}{:>12.6g}{:>12.6g}{:>11.3g}{:>11.3g}", model.sensors[i].name,
                        model.sensors[i].unit, c.last, c.mean(), c.noise(), model.sensor_noise_sigma(as_index(i)));
    if (i < s.wiring.sensors.size()) {
      const SensorView& view = s.wiring.sensors[i];
      text += fmt::format("{:>12.6g}{:>10.3g}{:>9.1f}", view.expected, view.spread, view.deviation);
    }
    text += '\n';
  }
  return text;
}

std::string source_text(const SourceKey& key, const SourceFindings& s) {
  const SourceRecord& r = s.record;
  std::string text = fmt::format("engine {}, source {}: {} samples, {:.1f}/s, schema {}\n", key.first, key.second,
                                 r.samples, r.own.mean_s() > 0 ? 1.0 / r.own.mean_s() : 0.0, r.last.schema());
  text += fmt::format(
      "  by its clock {:.3f} ms a sample (jitter {:.3f}), by ours {:.3f} ms (jitter {:.3f}, longest {:.3f})\n",
      1e3 * r.source.mean_s(), 1e3 * r.source.jitter_s(), 1e3 * r.own.mean_s(), 1e3 * r.own.jitter_s(),
      1e3 * r.own.max_s);
  text += fmt::format("  lost {}, repeated {}, overtaken {}   altitude {:.0f} m, Mach {:.3f}, {:+.1f} K from ISA\n",
                      r.lost, r.repeated, r.overtaken, r.last.altitude_m(), r.last.mach(), r.last.delta_isa_k());
  if (s.design) text += channels_text(s);
  return text + findings_text(s.wiring.findings, "  ");
}

json findings_json(const std::vector<Finding>& findings) {
  json list = json::array();
  for (const Finding& f : findings) list.push_back({{"severity", f.error ? "error" : "warning"}, {"text", f.text}});
  return list;
}

json channel_json(const linear_model::Channel& channel, const ChannelRecord& c) {
  return {{"name", channel.name}, {"unit", channel.unit}, {"trim", channel.trim},
          {"last", c.last},       {"mean", c.mean()},     {"noise", c.noise()},
          {"good", c.good},       {"invalid", c.invalid}, {"not_finite", c.not_finite},
          {"min", c.min},         {"max", c.max},         {"longest_equal_run", c.longest_equal_run}};
}

json source_json(const SourceKey& key, const SourceFindings& s) {
  const SourceRecord& r = s.record;
  json j{{"engine", key.first},
         {"source", key.second},
         {"schema", r.last.schema()},
         {"samples", r.samples},
         {"lost", r.lost},
         {"repeated", r.repeated},
         {"overtaken", r.overtaken},
         {"sample_time_source_s", r.source.mean_s()},
         {"jitter_source_s", r.source.jitter_s()},
         {"sample_time_own_s", r.own.mean_s()},
         {"jitter_own_s", r.own.jitter_s()},
         {"longest_own_s", r.own.max_s},
         {"findings", findings_json(s.wiring.findings)},
         {"sensors", json::array()},
         {"actuators", json::array()}};
  if (!s.design) return j;
  const auto& model = s.design->model;
  for (std::size_t i = 0; i < std::min<std::size_t>(model.controls.size(), r.last.actuator_count()); ++i)
    j["actuators"].push_back(channel_json(model.controls[i], r.actuators[i]));
  for (std::size_t i = 0; i < std::min<std::size_t>(model.sensors.size(), r.last.sensor_count()); ++i) {
    json sensor = channel_json(model.sensors[i], r.sensors[i]);
    if (i < s.wiring.sensors.size()) {
      sensor["expected"] = s.wiring.sensors[i].expected;
      sensor["spread"] = s.wiring.sensors[i].spread;
      sensor["deviation"] = s.wiring.sensors[i].deviation;
    }
    j["sensors"].push_back(sensor);
  }
  return j;
}

}  // namespace

bool ListenReport::good() const {
  return !has_error(findings) && !sources.empty() && std::none_of(sources.begin(), sources.end(), [](const auto& s) {
    return has_error(s.second.wiring.findings);
  });
}

std::string report_text(const ListenReport& report) {
  std::string text;
  for (const auto& [key, source] : report.sources) text += source_text(key, source);
  text += findings_text(report.findings, "");
  return text + (report.good() ? "verdict: OK\n" : "verdict: NOT OK\n");
}

std::string report_json(const ListenReport& report) {
  json j{{"seconds", report.seconds},
         {"good", report.good()},
         {"findings", findings_json(report.findings)},
         {"sources", json::array()}};
  for (const auto& [key, source] : report.sources) j["sources"].push_back(source_json(key, source));
  return j.dump(2) + "\n";
}

}  // namespace ehm::monitor
