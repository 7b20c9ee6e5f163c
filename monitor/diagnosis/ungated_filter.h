// SPDX-License-Identifier: Apache-2.0
#pragma once
// The innovations and the state as they would be had the innovation gate let every plausible value through: the
// signatures of fault_signatures.h hold for that filter. It is carried as the difference to the one that flies,
//
//   delta = xhat_ungated - xhat,     nu_ungated = nu - Cxq Axq delta
//   delta <- Axq delta + K (M_present nu_ungated - M_fused nu)
//
// which is zero, and costs nothing, until the gate closes. Channel units. Real-time safe: yes.

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/tuner_filter.h"

namespace ehm::monitor {

class UngatedFilter {
 public:
  void reset() noexcept { apart_ = false; }

  /// After the flying filter's update with `fused`; `present` were plausible and are in its set.
  void step(const estimation::TunerFilter& filter, estimation::SensorMask present,
            estimation::SensorMask fused) noexcept {
    const estimation::SubsetGain& gain = filter.gain();
    innovation_ = filter.innovation();
    for (Eigen::Index i = 0; i < innovation_.size(); ++i)
      if (!present[as_size(i)]) innovation_(i) = 0.0;
    if (!apart_ && present == fused) return;
    if (!apart_) difference_.setZero(gain.A.rows());
    predicted_.noalias() = gain.A.lazyProduct(difference_);
    correction_.noalias() = gain.C.lazyProduct(predicted_);
    for (Eigen::Index i = 0; i < innovation_.size(); ++i) {
      const auto s = as_size(i);
      const double flown = fused[s] ? innovation_(i) : 0.0;
      if (present[s]) innovation_(i) -= correction_(i);
      correction_(i) = innovation_(i) - flown;
    }
    difference_ = predicted_;
    difference_.noalias() += gain.K.lazyProduct(correction_);
    apart_ = difference_.cwiseAbs().maxCoeff() > negligible_percent;
  }

  /// nu_ungated, 0 where there is no value.
  const estimation::SensorVector& innovation() const noexcept { return innovation_; }
  /// Adds delta to `shift`, a shift of the flying filter's state.
  void add_difference(estimation::AugmentedVector& shift) const noexcept {
    if (apart_) shift += difference_;
  }

 private:
  static constexpr double negligible_percent = 1e-9;
  estimation::AugmentedVector difference_, predicted_;
  estimation::SensorVector innovation_, correction_;
  bool apart_ = false;
};

}  // namespace ehm::monitor
