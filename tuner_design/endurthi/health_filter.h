// SPDX-License-Identifier: Apache-2.0
#pragma once
// The filters of Endurthi's thesis, chapter V, on one linear model: the time-varying Kalman filter on [x; h], and what
// the knowledge that wear goes one way makes of it, at each sample:
//   unconstrained   xhat
//   projected       min (x - xhat)^T P^-1 (x - xhat) in a box (box_projection.h): no parameter is better than it was found
//                   at the end of a flight before (health_constraint.h), nor than new; the filter goes on from xhat
//   every sample    the same with a box that each sample tightens: the thesis' "from one time step to next" to the
//                   letter. A ratchet: what noise has pushed into the box once stays there
//   fed back        as projected, and the filter goes on from the projected estimate
// h[k+1] = h[k] + w, cov(w) = Qh I, so that the filter follows wear: [x; h] are the states of a FullOrderModel without
// constant health. States and sensors in percent of the model's trim, health in percent; controls in channel units.
// Health is 0 of the new engine, which the filter knows to within P0. The thesis gives neither P0 nor Q: those here are
// a reading. Errors: @throws what discretise throws.

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "monitor/estimation/constrained/health_constraint.h"
#include "monitor/estimation/time_varying_filter.h"
#include "tuner_design/endurthi/study_engine.h"

namespace ehm::tuner_design::endurthi {

enum class FilterKind { unconstrained, projected, every_sample, fed_back };
inline constexpr std::array<std::string_view, 4> filter_kind_names{"unconstrained", "projected", "every sample",
                                                                   "fed back"};

struct FilterSettings {
  double p0_percent = 0.5;              ///< standard deviation of each state and health parameter at the start
  double qh_percent2 = 1e-5;            ///< of health, a sample
  double process_noise_percent = 0.01;  ///< of each state's trim, a sample
  double sample_time_s = 0.1;
};

class HealthFilter {
 public:
  HealthFilter(const StudyPoint& point, const Eigen::MatrixXd& jacobian, FilterKind kind,
               const FilterSettings& settings);

  /// One sample, absolute, channel units.
  void fuse(const Eigen::VectorXd& y, const Eigen::VectorXd& u);
  /// What is estimated now bounds what comes, if the kind says so.
  void end_flight();
  /// Percent.
  const Eigen::VectorXd& health() const { return health_; }
  /// Goes on with another model of the same channels.
  void relinearise(const StudyPoint& point, const Eigen::MatrixXd& jacobian);

 private:
  void constrain();

  FilterKind kind_;
  FilterSettings settings_;
  Eigen::VectorXd state_trim_, health_trim_, sensor_trim_, control_trim_;  ///< of the model; health in percent
  estimation::TimeVaryingFilter filter_;
  estimation::HealthConstraint constraint_;  ///< of absolute health, percent
  estimation::ActuatorVector du_previous_;
  Eigen::VectorXd health_;
  bool begun_ = false;
};

}  // namespace ehm::tuner_design::endurthi
