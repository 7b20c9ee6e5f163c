// SPDX-License-Identifier: Apache-2.0
#include "monitor/export/metrics.h"

#include <prometheus/text_serializer.h>

#include <algorithm>
#include <bit>
#include <string_view>

#include "monitor/export/process_metrics.h"
#include "monitor/realtime/clock.h"

namespace ehm::monitor {

namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;
using Labels = std::vector<ClientMetric::Label>;

constexpr double us = 1e-6;

struct StatusMetric {
  const char *name, *help;
  MetricType type;
  double (*value)(const MonitorStatus&);
};

double number(std::uint64_t count) {
  return static_cast<double>(count);
}

#define EHM_COUNTER(NAME, FIELD, HELP)                                                        \
  {                                                                                           \
    NAME, HELP, MetricType::Counter, [](const MonitorStatus& s) { return number(s.FIELD()); } \
  }
#define EHM_GAUGE(NAME, VALUE, HELP)                                                      \
  {                                                                                       \
    NAME, HELP, MetricType::Gauge, [](const MonitorStatus& s) -> double { return VALUE; } \
  }

constexpr StatusMetric engine_metrics[]{
    EHM_GAUGE("ehm_level", s.level(), "0 OK, 1 WARN, 2 ERROR, 3 STALE, 4 STOPPED."),
    EHM_GAUGE("ehm_input_rate_hertz", s.rate_hz(), "Samples per second since the status before."),
    EHM_GAUGE("ehm_sensors_used", std::popcount(s.sensors_used()), "Sensors in the design that flies."),
    EHM_GAUGE("ehm_latency_max_seconds", us* s.latency_max_us(),
              "Longest time from a sample's reception to its estimate's publication."),
    EHM_GAUGE("ehm_flight_phase", s.flight_phase(),
              "0 unknown, 1 taxi, 2 take-off, 3 climb, 4 cruise, 5 descent, 6 approach."),
    EHM_GAUGE("ehm_flight_number", s.flight(), "Of the present flight, or the latest; 0 before the first."),
    EHM_GAUGE("ehm_n1_corrected_rpm", s.n1_corrected_rpm(), "Corrected fan speed N1c; 0 while unknown."),
    EHM_GAUGE("ehm_eta", s.eta(), "ln N1c less its lag of 25 s: how far the metal is from its balance."),
    EHM_GAUGE("ehm_validity_distance", s.validity_distance(),
              "Of the published estimator at the present conditions; above 1 it does not hold."),
    EHM_COUNTER("ehm_samples_received_total", samples_received, "Sensor samples that came."),
    EHM_COUNTER("ehm_samples_processed_total", samples_processed, "Samples that led to estimates."),
    EHM_COUNTER("ehm_samples_lost_total", samples_lost, "Gaps of the sequence, in samples."),
    EHM_COUNTER("ehm_samples_duplicated_total", samples_duplicated, "Samples that came twice, dropped."),
    EHM_COUNTER("ehm_samples_reordered_total", samples_reordered, "Samples that were overtaken, dropped."),
    EHM_COUNTER("ehm_samples_foreign_total", samples_foreign, "Samples of a second source, dropped."),
    EHM_COUNTER("ehm_samples_malformed_total", samples_malformed, "Samples that cannot be read, dropped."),
    EHM_COUNTER("ehm_samples_withheld_total", samples_withheld, "Samples in order without an honest estimate."),
    EHM_COUNTER("ehm_sensor_rejections_total", sensor_rejections,
                "Sensor values that were not fused, words of flight condition and actuators that were replaced."),
    EHM_COUNTER("ehm_filter_restarts_total", filter_restarts, "Cold starts of the filter."),
    EHM_COUNTER("ehm_deadline_misses_total", deadline_misses, "Estimates later than one sample time."),
    EHM_COUNTER("ehm_writes_refused_total", writes_refused, "Estimates that the middleware did not take."),
};

/// Counted for the whole service; every status carries them, the largest is the newest.
constexpr StatusMetric service_metrics[]{
    EHM_COUNTER("ehm_input_deadline_misses_total", input_deadline_misses,
                "Deadlines on EngineSensors that the middleware saw missed."),
    EHM_COUNTER("ehm_input_liveliness_losses_total", input_liveliness_losses,
                "Times that the writer of EngineSensors lost its liveliness."),
    EHM_COUNTER("ehm_unknown_engine_samples_total", unknown_engine_samples, "Samples of engines without a design."),
    EHM_COUNTER("ehm_reports_lost_total", reports_lost, "Events and status that the reporter's queue had no room for."),
    EHM_COUNTER("ehm_records_lost_total", records_lost, "Samples that the recorder's queue had no room for."),
    EHM_COUNTER("ehm_checkpoints_written_total", checkpoints_written, "Checkpoints written."),
    EHM_COUNTER("ehm_checkpoints_failed_total", checkpoints_failed, "Checkpoints that could not be written."),
    EHM_COUNTER("ehm_reloads_total", reloads, "Configurations taken over while running."),
    EHM_COUNTER("ehm_reloads_refused_total", reloads_refused, "Invalid configurations that were refused."),
};

#undef EHM_COUNTER
#undef EHM_GAUGE

ClientMetric sample(Labels labels, double value) {
  ClientMetric metric;
  metric.label = std::move(labels);
  metric.gauge.value = metric.counter.value = value;  // the family's type tells which one counts
  return metric;
}

/// Adds one sample an engine to each family that holds several by a label of its own.
class Fleet {
 public:
  explicit Fleet(const ServiceView& view) : view_(view), source_(std::to_string(view.source_id)) {}

  Labels labels(std::uint32_t engine) const { return {{"engine", std::to_string(engine)}, {"source", source_}}; }
  Labels labels(std::uint32_t engine, const char* name, const std::string& value) const {
    Labels all = labels(engine);
    all.push_back({name, value});
    return all;
  }
  /// `add(family, id, engine)` for each engine that has published a status, and for 0, the service, if it is asked for.
  template <class Add>
  MetricFamily family(const char* name, const char* help, MetricType type, Add&& add, bool with_service = false) const {
    MetricFamily family{name, help, type, {}};
    for (const auto& [id, engine] : view_.fleet)
      if (engine.status_ns != 0 || (id == 0 && with_service)) add(family, id, engine);
    return family;
  }
  MetricFamily family(const StatusMetric& m) const {
    return family(m.name, m.help, m.type, [&](MetricFamily& f, std::uint32_t id, const EngineView& engine) {
      f.metric.push_back(sample(labels(id), m.value(engine.status)));
    });
  }
  MetricFamily service_family(const StatusMetric& m) const {
    double largest = 0;
    for (const auto& [id, engine] : view_.fleet) largest = std::max(largest, m.value(engine.status));
    return {m.name, m.help, m.type, {sample({{"source", source_}}, largest)}};
  }
  MetricFamily service_family(const char* name, const char* help, MetricType type, Labels more, double value) const {
    more.push_back({"source", source_});
    return {name, help, type, {sample(std::move(more), value)}};
  }

 private:
  const ServiceView& view_;
  std::string source_;
};

std::uint64_t heard(const FleetView& fleet) {
  return static_cast<std::uint64_t>(
      std::count_if(fleet.begin(), fleet.end(), [](const auto& engine) { return engine.second.status_ns != 0; }));
}

/// `value`: of each channel that is estimated.
MetricFamily estimates(const Fleet& fleet, const char* name, const char* help, double EstimateView::*value) {
  return fleet.family(name, help, MetricType::Gauge, [&](MetricFamily& f, std::uint32_t id, const EngineView& engine) {
    for (const EstimateView& e : engine.estimates) {
      Labels all = fleet.labels(id, "kind", e.kind);
      all.push_back({"channel", e.channel});
      all.push_back({"unit", e.unit});
      f.metric.push_back(sample(std::move(all), e.*value));
    }
  });
}

struct EstimatorMetric {
  const char *name, *help;
  MetricType type;
  double (*value)(const EstimatorFigures&);
};

constexpr EstimatorMetric estimator_metrics[]{
    {"ehm_estimator_published", "1 for the estimator whose estimates are published.", MetricType::Gauge,
     [](const EstimatorFigures& e) { return e.published ? 1.0 : 0.0; }},
    {"ehm_estimator_samples_total", "Samples in which the estimator flew.", MetricType::Counter,
     [](const EstimatorFigures& e) { return number(e.samples); }},
    {"ehm_estimator_answers_total", "Of those, with an estimate.", MetricType::Counter,
     [](const EstimatorFigures& e) { return number(e.answers); }},
    {"ehm_estimator_seconds_total", "Time that it took.", MetricType::Counter,
     [](const EstimatorFigures& e) { return e.spent_s; }},
    {"ehm_estimator_longest_seconds", "The longest that it took for one sample.", MetricType::Gauge,
     [](const EstimatorFigures& e) { return static_cast<double>(e.longest_s); }},
    {"ehm_estimator_innovation_ratio",
     "Its innovations squared over their variances, mean of the fused sensors over 1000 samples.", MetricType::Gauge,
     [](const EstimatorFigures& e) { return static_cast<double>(e.innovation_ratio); }},
    {"ehm_estimator_difference",
     "Root mean square over health of its estimate less the published one, in sigmas of the published.",
     MetricType::Gauge, [](const EstimatorFigures& e) { return static_cast<double>(e.difference); }},
};

MetricFamily estimators(const Fleet& fleet, const EstimatorMetric& m) {
  return fleet.family(m.name, m.help, m.type, [&](MetricFamily& f, std::uint32_t id, const EngineView& engine) {
    for (const EstimatorFigures& e : engine.estimators)
      f.metric.push_back(sample(fleet.labels(id, "estimator", std::string(e.name)), m.value(e)));
  });
}

double status_age_s(const ServiceView& view, const EngineView& engine) {
  return 1e-9 * static_cast<double>(view.ages.now_ns - engine.status_ns);
}

/// Of the present, not of the status: an age that stands still would hide that nothing moves.
MetricFamily input_ages(const Fleet& fleet, const ServiceView& view) {
  return fleet.family(
      "ehm_input_age_seconds", "Age of the latest sample that is known of, by the monitor's clock.", MetricType::Gauge,
      [&](MetricFamily& f, std::uint32_t id, const EngineView& engine) {
        f.metric.push_back(sample(fleet.labels(id), engine.status.age_s() + status_age_s(view, engine)));
      });
}

MetricFamily status_ages(const Fleet& fleet, const ServiceView& view) {
  return fleet.family("ehm_status_age_seconds", "Age of what these metrics tell of the engine.", MetricType::Gauge,
                      [&](MetricFamily& f, std::uint32_t id, const EngineView& engine) {
                        f.metric.push_back(sample(fleet.labels(id), status_age_s(view, engine)));
                      });
}

MetricFamily loop_ages(const ServiceView& view) {
  const std::string source = std::to_string(view.source_id);
  return {"ehm_loop_age_seconds",
          "Since the loop turned last; above 0.25 it has stalled.",
          MetricType::Gauge,
          {sample({{"loop", "cycle"}, {"source", source}}, view.ages.cycle_s),
           sample({{"loop", "reporter"}, {"source", source}}, view.ages.reporter_s)}};
}

MetricFamily latencies(const Fleet& fleet) {
  return fleet.family("ehm_latency_seconds", "From a sample's reception to its estimate's publication, by percentile.",
                      MetricType::Gauge, [&](MetricFamily& f, std::uint32_t id, const EngineView& engine) {
                        const MonitorStatus& s = engine.status;
                        const std::pair<const char*, double> percentiles[]{
                            {"50", s.latency_p50_us()}, {"99", s.latency_p99_us()}, {"99.9", s.latency_p999_us()}};
                        for (const auto& [percentile, latency_us] : percentiles)
                          f.metric.push_back(sample(fleet.labels(id, "percentile", percentile), us * latency_us));
                      });
}

MetricFamily flags(const Fleet& fleet) {
  return fleet.family(
      "ehm_estimate_flag", "1 while the flag is set on the estimates.", MetricType::Gauge,
      [&](MetricFamily& f, std::uint32_t id, const EngineView& engine) {
        for (const auto& [bit, name] : idl::estimate_flag_names)
          f.metric.push_back(sample(fleet.labels(id, "flag", name), (engine.status.flags() & bit) != 0 ? 1 : 0));
      });
}

MetricFamily events(const Fleet& fleet) {
  return fleet.family(
      "ehm_events_total", "Conditions that began, by kind.", MetricType::Counter,
      [&](MetricFamily& f, std::uint32_t id, const EngineView& engine) {
        for (std::size_t kind = 1; kind < idl::event_kind_names.size(); ++kind)
          f.metric.push_back(
              sample(fleet.labels(id, "kind", idl::event_kind_names[kind]), number(engine.raised[kind])));
      },
      true);
}

MetricFamily conditions(const Fleet& fleet) {
  return fleet.family(
      "ehm_condition_active", "1 while the condition is raised; absent before it was first raised.", MetricType::Gauge,
      [&](MetricFamily& f, std::uint32_t id, const EngineView& engine) {
        for (const auto& [key, state] : engine.conditions) {
          const char* kind = key.first < idl::event_kind_names.size() ? idl::event_kind_names[key.first] : "?";
          Labels all = fleet.labels(id, "kind", kind);
          all.push_back({"channel", state.first});
          f.metric.push_back(sample(std::move(all), state.second ? 1 : 0));
        }
      },
      true);
}

/// `value`: of the latest flight, where its margins are known.
MetricFamily margin(const Fleet& fleet, const char* name, const char* help, double (*value)(const FlightSummary&)) {
  return fleet.family(name, help, MetricType::Gauge, [&](MetricFamily& f, std::uint32_t id, const EngineView& engine) {
    if (engine.flight && engine.flight->margins_known() != 0)
      f.metric.push_back(sample(fleet.labels(id), value(*engine.flight)));
  });
}

MetricFamily engine_info(const Fleet& fleet) {
  return fleet.family("ehm_engine_info", "1; which design flies for which type of engine.", MetricType::Gauge,
                      [&](MetricFamily& f, std::uint32_t id, const EngineView& engine) {
                        Labels all = fleet.labels(id, "design", engine.design_hash);
                        all.push_back({"type", engine.engine_type});
                        f.metric.push_back(sample(std::move(all), 1));
                      });
}

}  // namespace

std::string metrics_text(const ServiceView& view) {
  const Fleet fleet(view);
  std::vector<MetricFamily> families = process_metrics();
  families.push_back(
      fleet.service_family("ehm_build_info", "1; the version.", MetricType::Gauge, {{"version", EHM_VERSION}}, 1));
  families.push_back(fleet.service_family("ehm_cycle_turns_total", "Turns of the real-time loop, at least 60 a second.",
                                          MetricType::Counter, {}, number(view.cycle_turns)));
  families.push_back(fleet.service_family("ehm_engines", "Engines that a status has been published of.",
                                          MetricType::Gauge, {}, number(heard(view.fleet))));
  for (const StatusMetric& m : service_metrics) families.push_back(fleet.service_family(m));
  for (const StatusMetric& m : engine_metrics) families.push_back(fleet.family(m));
  if (view.certificate_expires_s != 0)
    families.push_back(fleet.service_family(
        "ehm_certificate_expiry_seconds", "Until the certificate of the monitor expires; negative afterwards.",
        MetricType::Gauge, {},
        static_cast<double>(view.certificate_expires_s) - 1e-9 * static_cast<double>(wall_clock_ns())));
  families.push_back(loop_ages(view));
  families.push_back(status_ages(fleet, view));
  families.push_back(input_ages(fleet, view));
  families.push_back(latencies(fleet));
  families.push_back(estimates(fleet, "ehm_estimate", "Estimated health parameter or output, in the channel's unit.",
                               &EstimateView::value));
  families.push_back(estimates(fleet, "ehm_estimate_sigma", "Standard deviation of the estimate's whole error.",
                               &EstimateView::sigma));
  for (const EstimatorMetric& m : estimator_metrics) families.push_back(estimators(fleet, m));
  families.push_back(margin(fleet, "ehm_egt_margin_kelvin",
                            "What T48 had left at hot-day take-off after the last flight.",
                            [](const FlightSummary& s) { return s.egt_margin_k(); }));
  families.push_back(margin(fleet, "ehm_egt_margin_sigma_kelvin", "Standard deviation of that margin.",
                            [](const FlightSummary& s) { return s.egt_margin_sigma_k(); }));
  families.push_back(flags(fleet));
  families.push_back(events(fleet));
  families.push_back(conditions(fleet));
  families.push_back(engine_info(fleet));
  std::erase_if(families, [](const MetricFamily& f) { return f.metric.empty(); });
  return prometheus::TextSerializer().Serialize(families);
}

}  // namespace ehm::monitor
