// SPDX-License-Identifier: Apache-2.0
#pragma once
// Abrupt faults: has something happened, and was it a sensor or a component? The generalised likelihood ratio test of
// the innovations over a step of every sensor's bias and of every health parameter, at every onset of the last seconds:
//
//   l_j = max over onsets of d_j^2 / J_j     (fault_signatures.h, onset_ring.h)
//
//   happened     the largest l_j exceeds the chi-square quantile
//                (one degree of freedom) of false_alarm_per_hour,
//                shared by all hypotheses, samples and octaves of onsets
//   sensor s     l_s beats every other sensor and every component by the margin, and explains the innovations:
//                E - l_s within four standard deviations of a chi-square
//   component h  l_h beats every sensor by the margin; which component matters less than that it is one
//   ambiguous    decide_within_s after it happened neither holds for persistence_s
//   margin       2 ln((1-p)/p) + share * l: p is the probability of the wrong name if the signatures are right; the
//                share allows for their error, since the real engine is not linear
//
// The noise of each sensor is watched beside that (noise_watch.h). A named sensor is the caller's to exclude, then
// start() with the set that is left; until it is named it is the suspect, and need not be fused. A named component, or
// an ambiguous answer, is said once; the evidence fades when the filter has followed, and then the detector is free
// again. Real-time safe: yes, after construction.

#include <algorithm>
#include <memory>

#include "monitor/data/options.h"
#include "monitor/diagnosis/fault_signatures.h"
#include "monitor/diagnosis/noise_watch.h"
#include "monitor/diagnosis/onset_ring.h"

namespace ehm::monitor {

enum class FaultKind { none, sensor_bias, sensor_noise, component_step, ambiguous };

struct FaultVerdict {
  FaultKind kind = FaultKind::none;
  int channel = 0;          ///< sensor; health parameter for a component_step; likeliest sensor if ambiguous
  double size = 0.0;        ///< channel units; sensor_noise: factor on the noise
  double noticeable = 0.0;  ///< the smallest size that would have been noticed, same unit
  int age = 0;              ///< samples since the onset
};

class FaultDetector {
 public:
  FaultDetector(const FaultOptions& options, std::shared_ptr<const FaultTables> tables, double sample_time_s);

  /// Starts anew with the sensor set without `missing` (-1: the full one), deaf for `deaf_samples`.
  void start(int missing, Eigen::Index deaf_samples) noexcept;
  /// As after a cold start of the filter.
  void reset() noexcept { start(-1, tables_->full.settling_samples); }
  /// Another sensor set goes on where this one was; deaf for `least` samples, or as long as it still is.
  void change_set(int missing, Eigen::Index least) noexcept { start(missing, std::max(deaf_, least)); }
  /// Takes the innovations of one sample, sensor units, 0 where there is none.
  FaultVerdict step(const estimation::SensorVector& innovation, estimation::SensorMask present, int steps) noexcept;

  /// It listens: the filter has converged.
  bool armed() const noexcept { return deaf_ <= 0; }
  /// Something happened, and there is still time to name it.
  bool pending() const noexcept { return excited_ > 0 && !named_ && excited_ < patience_samples_; }
  /// The sensor that is most likely at fault while no name has been given, -1 for none: better not fused.
  int suspect() const noexcept { return pending() ? suspect_ : -1; }
  /// Something happened that has not faded.
  bool excited() const noexcept { return excited_ > 0; }
  double threshold() const noexcept { return threshold_; }
  const FaultSignatures& signatures() const noexcept { return *active_; }
  const FaultTables& tables() const noexcept { return *tables_; }

 private:
  FaultVerdict decide() noexcept;
  FaultVerdict candidate() noexcept;
  FaultVerdict verdict(FaultKind kind, int hypothesis, const OnsetRing::Evidence& evidence) const noexcept;

  FaultOptions options_;
  std::shared_ptr<const FaultTables> tables_;
  const FaultSignatures* active_;
  OnsetRing onsets_;
  NoiseWatch noise_;
  double threshold_, certain_;  ///< of l_j; 2 ln((1-p)/p)
  std::int64_t persistence_samples_, patience_samples_;
  Eigen::Index deaf_ = 0;
  int missing_ = -1, suspect_ = -1;
  std::int64_t excited_ = 0, held_ = 0;  ///< samples above the threshold; samples with the same candidate
  bool named_ = false;
  FaultVerdict held_candidate_;
};

}  // namespace ehm::monitor
