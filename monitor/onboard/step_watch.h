// SPDX-License-Identifier: Apache-2.0
#pragma once
// Has something stepped that the on-board filter takes to be constant? A filter that has learned is deaf to it: its
// covariance P no longer admits a change. The mean of its innovations tells.
//   v   <- v + g (innovation - v)              percent, over mean_time_s;  g = 1 - exp(-dt/mean_time_s)
//                                              of every sensor in use, also of a reading that the gate has held back: a
//                                              biased one is held back half of the time. Of those at most 6 sigma
//                                              count, so that a spike is no step; where several are beyond it the
//                                              gate holds none back, for the engine has changed
//   S   =  Y P Y' + diag(sigma^2 g/(2 - g) + slow^2)      sigma: noise of a sample; slow: what no mean takes away
//   T   =  v' S^-1 v                           chi-square with a degree of freedom for each sensor while nothing steps
//   b_j =  (s_j' S^-1 v)^2/(s_j' S^-1 s_j)     what of T one cause explains, and its size (s_j' S^-1 v)/(s_j' S^-1 s_j):
//                                              s_j is the settled slope of a health parameter, or a sensor by itself
//   p_j ~  exp(b_j/2)                          how likely it was that one, all causes being as likely before
// Found where T has been above step_threshold for step_confirm_s (2 s name no better, and meanwhile the filter teaches the
// step to the other parameters: SSEE at landing 30 instead of 1), and one cause explains step_explains of it; what no single cause explains is a fault of the model, and opening P for a parameter
// would teach that to it. The mean then begins anew.
// Source: Basseville and Nikiforov, Detection of Abrupt Changes, ch. 7 (generalised likelihood ratio, linear Gaussian).
// Errors: none; where S is not definite, nothing is found. Real-time safe: yes.

#include <cstdint>

#include "monitor/onboard/engine_tangent.h"
#include "monitor/onboard/unknown_covariance.h"

namespace ehm::onboard {

/// What has stepped, most likely.
struct StepFinding {
  estimation::HealthVector health;  ///< p_j of each health parameter
  estimation::SensorVector sensor;  ///< and of each sensor
  Eigen::Index parameter = -1;      ///< the most likely one of health; -1: it was a sensor
  double size_percent = 0.0;        ///< of the most likely one, of either, as far as the mean has seen it yet
  double threshold_percent = 0.0;   ///< the least of it that would have been found
};

/// Variances of the mean's ingredients, percent^2.
struct ReadingDoubt {
  estimation::SensorVector noise, slow;
};

class StepWatch {
 public:
  StepWatch(const UnknownLayout& layout, const OnBoardOptions& options);

  /// Begins anew: the mean knows nothing.
  void reset() noexcept;
  /// The innovations of one sample and their variance, percent, of the sensors in use, of which `fused` were not held
  /// back; one that is no number leaves the mean as it is. True: something has stepped, see finding().
  bool take(const estimation::Innovation& percent, estimation::SensorMask in_use, estimation::SensorMask fused,
            const EngineTangent& tangent, const UnknownCovariance& covariance, const ReadingDoubt& doubt) noexcept;
  const StepFinding& finding() const noexcept { return finding_; }
  /// T of the latest test.
  double statistic() const noexcept { return statistic_; }

 private:
  bool test(estimation::SensorMask in_use, const EngineTangent& tangent, const UnknownCovariance& covariance,
            const ReadingDoubt& doubt) noexcept;

  UnknownLayout layout_;
  double gain_, threshold_, explains_;
  std::int64_t test_samples_, filling_samples_, confirm_samples_;
  std::int64_t samples_ = 0;       ///< in the mean
  std::int64_t above_ = 0;         ///< of them, since every test was above
  estimation::SensorVector mean_;  ///< v
  double statistic_ = 0.0;
  StepFinding finding_;
};

}  // namespace ehm::onboard
