// SPDX-License-Identifier: Apache-2.0
#include "monitor/cycle/accommodation.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::monitor {

using estimation::SensorSet;
using estimation::TunerEstimator;

namespace {

/// How many sensors that a design needs are excluded; `last` is one of them.
int excluded_sensors(const TunerEstimator& watch, const SensorSupervision& supervision, int& last) noexcept {
  const estimation::TunerFilterModel& model = watch.filter().model();
  int excluded = 0;
  for (Eigen::Index i = 0; i < model.D.rows(); ++i)
    if (model.full.sensors[as_size(i)] && supervision.excluded(static_cast<int>(i)))
      ++excluded, last = static_cast<int>(i);
  return excluded;
}

}  // namespace

bool Accommodation::find_design(const TunerEstimator& watch, const SensorSupervision& supervision,
                                EventList& events) noexcept {
  missing_ = -1;
  const int excluded = excluded_sensors(watch, supervision, missing_);
  have_design_ = excluded == 0 || (excluded == 1 && watch.filter().available(SensorSet::without(missing_)));
  no_design_.set(!have_design_,
                 {.kind = idl::EventKind::no_design, .value = static_cast<double>(excluded), .threshold = 1.0}, events);
  return have_design_;
}

int Accommodation::start(TunerEstimator& watch, const SensorSupervision& supervision) noexcept {
  int missing = -1;
  if (excluded_sensors(watch, supervision, missing) != 1) {
    watch.reset();
    return -1;
  }
  if (!watch.start_without(missing)) return -1;
  cold_return_ = true;
  await_return(watch, missing);
  return missing;
}

/// What the gate knows of this sensor stays; of another one's it would be wrong.
void Accommodation::await_return(const TunerEstimator& watch, int sensor) noexcept {
  if (gated_sensor_ == sensor) return;
  const double variance = watch.filter().innovation_variance()(sensor);
  return_gate_.start(0.0, variance, variance, 0.0);
  return_gate_.forget();
  gated_sensor_ = sensor;
}

void Accommodation::respond(const Verdict& verdict, TunerEstimator& watch, FaultDetection& detection) noexcept {
  if (verdict.fault.kind != FaultKind::none && verdict.ends_drift) follow_return(verdict.fault, watch, detection);
  if (watch.filter().sensor_set().missing() == missing_) return;
  if (!watch.filter().sensor_set().is_full()) readmit(watch, detection);
  if (missing_ >= 0) exclude(missing_, verdict.fault, watch, detection);
}

int Accommodation::check_return(const TunerEstimator& watch, estimation::SensorMask plausible, bool shifted,
                                double gate_sigma, estimation::SensorVector& ratio) noexcept {
  const int missing = watch.filter().sensor_set().missing();
  // Without a design there is no prediction worth comparing with: the checks alone requalify.
  if (!have_design_ || missing < 0) return -1;
  const bool here = plausible[as_size(missing)];
  const double innovation = watch.innovation().value(missing);
  return_gate_.step(sample_time_s_);
  if (here) return_gate_.observe(innovation);
  if (shifted) return_gate_.forget();
  ratio(missing) = return_gate_.ratio(innovation, gate_sigma);
  cold_return_ = cold_return_ && !watch.estimate().settled;
  return here && (cold_return_ || ratio(missing) > 1.0) ? missing : -1;
}

void Accommodation::take_out(const FaultVerdict& fault, TunerEstimator& watch,
                             const FaultDetection& detection) noexcept {
  if (fault.kind != FaultKind::sensor_bias) return;
  // What the flying filter has of the bias: had the gate let all through, xi[age] times its size.
  const FaultDetector& detector = detection.detector();
  const Eigen::Index sensors = watch.innovation().value.size();
  shift_by_ = -fault.size / detector.tables().noise_sigma(fault.channel) *
              detector.signatures().state.col(fault.age * sensors + fault.channel);
  detection.add_ungated(shift_by_);
  watch.shift(shift_by_);
}

/// The filter goes at once to where the good sensor would lead it.
void Accommodation::follow_return(const FaultVerdict& fault, TunerEstimator& watch,
                                  FaultDetection& detection) noexcept {
  const FaultDetector& detector = detection.detector();
  const auto& signatures = detector.signatures();
  const Eigen::Index sensors = watch.innovation().value.size();
  shift_by_ = fault.size / detector.tables().noise_sigma(fault.channel) *
              (signatures.steady_state.col(fault.channel) - signatures.state.col(fault.age * sensors + fault.channel));
  watch.shift(shift_by_);
  detection.with_all();
  detection.expect_step();
}

void Accommodation::exclude(int sensor, const FaultVerdict& fault, TunerEstimator& watch,
                            FaultDetection& detection) noexcept {
  take_out(fault, watch, detection);
  const double with_it = watch.predicted(sensor);
  const double narrow = watch.filter().innovation_variance()(sensor);
  const bool knew_it = watch.error().settled();
  // What the sensor has taught stays true, and the estimates go on without a step.
  watch.leave_out(sensor, knew_it, sample_time_s_ / ReturnGate::memory_s);
  const double bias = fault.kind == FaultKind::sensor_bias ? fault.size : 0.0;
  return_gate_.start(with_it - watch.predicted(sensor), narrow, watch.filter().innovation_variance()(sensor), bias);
  if (!knew_it) return_gate_.forget();
  gated_sensor_ = sensor;
  cold_return_ = false;
  detection.without(sensor);
}

void Accommodation::readmit(TunerEstimator& watch, FaultDetection& detection) noexcept {
  const int sensor = watch.filter().sensor_set().missing();
  watch.take_back();
  // The prediction without the sensor missed it by so much; the full filter would end where it does not.
  const FaultTables& tables = detection.detector().tables();
  const double sigmas = return_gate_.innovation_mean() / tables.noise_sigma(sensor);
  shift_by_ = sigmas * tables.full.steady_state.col(sensor);
  watch.shift(shift_by_);
  detection.with_all();
}

void Accommodation::forget(EventList& events) noexcept {
  gated_sensor_ = -1;
  have_design_ = true;
  no_design_.reassess(idl::EventKind::no_design, 0, events);
}

void Accommodation::resume(int missing, const ReturnGate::Memory& memory) noexcept {
  return_gate_.resume(memory);
  gated_sensor_ = missing;
}

}  // namespace ehm::monitor
