// SPDX-License-Identifier: Apache-2.0
#include "monitor/diagnosis/fault_detector.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "monitor/diagnosis/quantiles.h"

namespace ehm::monitor {

namespace {

constexpr int longest_gap = 20;        // lost samples over which the sums may go on
constexpr double fit_sigmas = 4.0;     // of the chi-square of what a hypothesis leaves unexplained
constexpr double excited_share = 0.5;  // of the threshold: below it the evidence has faded

double likelihood_threshold(const FaultOptions& options, const FaultSignatures& s, double sample_time_s) {
  const double octaves = std::max(1.0, std::log2(static_cast<double>(s.ages)));
  const double looks_per_hour = 3600.0 / sample_time_s * s.hypotheses * octaves;
  const double z = normal_quantile_above(0.5 * options.false_alarm_per_hour / looks_per_hour);
  return z * z;
}

/// Does the hypothesis leave no more than noise?
bool explains(const OnsetRing::Evidence& evidence) noexcept {
  return evidence.energy - evidence.ratio < evidence.degrees + fit_sigmas * std::sqrt(2.0 * evidence.degrees);
}

}  // namespace

FaultDetector::FaultDetector(const FaultOptions& options, std::shared_ptr<const FaultTables> tables,
                             double sample_time_s)
    : options_(options),
      tables_(std::move(tables)),
      active_(&tables_->full),
      onsets_(*active_),
      noise_(options.false_alarm_per_hour, active_->sensors, sample_time_s),
      threshold_(likelihood_threshold(options, *active_, sample_time_s)),
      certain_(2.0 * std::log((1.0 - options.wrong_name_probability) / options.wrong_name_probability)),
      persistence_samples_(std::max<std::int64_t>(1, std::llround(options.persistence_s / sample_time_s))),
      patience_samples_(std::llround(options.decide_within_s / sample_time_s)) {
  reset();
}

void FaultDetector::start(int missing, Eigen::Index deaf_samples) noexcept {
  missing_ = missing;
  active_ = &tables_->of(missing);
  onsets_.start(*active_);
  noise_.start();
  deaf_ = deaf_samples;
  excited_ = held_ = 0;
  named_ = false;
  suspect_ = -1;
}

FaultVerdict FaultDetector::step(const estimation::SensorVector& innovation, estimation::SensorMask present,
                                 int steps) noexcept {
  if (deaf_ > 0) {
    deaf_ -= steps;
    return {};
  }
  if (steps > longest_gap) start(missing_, 0);
  estimation::SensorVector scaled = innovation.cwiseQuotient(tables_->sensor_scale);
  onsets_.step(scaled, present, steps);
  scaled.array() /= active_->innovation_sigma.array();
  noise_.step(scaled, present);
  for (int i = 0; i < active_->sensors; ++i)
    if (present[as_size(i)] && noise_.loud(i))
      return {FaultKind::sensor_noise, i, noise_.factor(i), noise_.threshold_factor(), 0};
  return decide();
}

FaultVerdict FaultDetector::decide() noexcept {
  const double largest = onsets_.largest();
  if (largest < (excited_ > 0 ? excited_share : 1.0) * threshold_) {
    excited_ = held_ = 0;
    named_ = false;
    return {};
  }
  ++excited_;
  if (named_) return {};
  const FaultVerdict now = candidate();
  const bool same = now.kind == held_candidate_.kind && now.channel == held_candidate_.channel;
  held_ = same ? held_ + 1 : 1;
  held_candidate_ = now;
  if (now.kind == FaultKind::sensor_bias || now.kind == FaultKind::component_step) {
    if (held_ < persistence_samples_) return {};
    named_ = true;
    return now;
  }
  if (now.kind != FaultKind::ambiguous || excited_ < patience_samples_) return {};
  named_ = true;  // what the fading evidence would still say is worth less
  return now;
}

FaultVerdict FaultDetector::candidate() noexcept {
  int sensor = -1, component = -1;
  OnsetRing::Evidence first, second, of_component;
  for (int i = 0; i < active_->sensors; ++i) {
    const OnsetRing::Evidence evidence = onsets_.best(i);
    if (sensor < 0 || evidence.ratio > first.ratio) {
      second = first;
      first = evidence;
      sensor = i;
    } else if (evidence.ratio > second.ratio) {
      second = evidence;
    }
  }
  for (int j = active_->sensors; j < active_->hypotheses; ++j)
    if (const OnsetRing::Evidence evidence = onsets_.best(j); component < 0 || evidence.ratio > of_component.ratio)
      of_component = evidence, component = j;

  const double margin = certain_ + options_.signature_error * std::max(first.ratio, of_component.ratio);
  const bool loud_enough = std::max(first.ratio, of_component.ratio) > threshold_;
  suspect_ = first.ratio > of_component.ratio && explains(first) ? sensor : -1;
  if (!loud_enough) return {};
  if (of_component.ratio - first.ratio > margin) return verdict(FaultKind::component_step, component, of_component);
  if (!explains(first)) return {};
  if (first.ratio - std::max(second.ratio, of_component.ratio) > margin)
    return verdict(FaultKind::sensor_bias, sensor, first);
  return verdict(FaultKind::ambiguous, sensor, first);
}

FaultVerdict FaultDetector::verdict(FaultKind kind, int hypothesis,
                                    const OnsetRing::Evidence& evidence) const noexcept {
  const int sensors = active_->sensors;
  const bool component = kind == FaultKind::component_step;
  const int channel = component ? hypothesis - sensors : hypothesis;
  const double unit = component ? tables_->health_scale(channel) : tables_->noise_sigma(channel);
  return {kind, channel, unit * evidence.size,
          unit * std::sqrt(threshold_ / active_->information(hypothesis, evidence.age)), evidence.age};
}

}  // namespace ehm::monitor
