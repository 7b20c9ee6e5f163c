// SPDX-License-Identifier: Apache-2.0
#pragma once
// One bad word among the flight condition and the actuators: not finite, or a jump that no aircraft or actuator makes
// in the time since the last good word,
//
//   |word - good| > jump + slew * time      altitude 100 m + 150 m/s, Mach 0.03 + 0.1/s, ambient 5 K + 2 K/s
//                                           actuator 10 % of trim + 100 %/s; in degrees 3 + 60/s; fraction 0.03 + 1/s
//
// or an actuator farther than a thousand such jumps from its trim, which no engine survives. With a trim of 0 in another
// unit its reach (actuator_reach.h) stands for the trim. A bad word is replaced by the last good one, for
// checks.bridge_samples at most, so that neither filter nor validity sees it. What lasts longer:
//
//   moved    the words agree among each other, at another place: they are believed from then on (a real step of the
//            operating point, which ends the estimates by the validity check, that much later)
//   lost     they are not finite, too far, or agree with nothing; or no good one has been there yet: no estimate is honest
//
// Either raises condition_fault once, cleared after checks.requalify_samples good words; until then a return to the
// place before a move is believed at once. Real-time safe: yes, after construction.

#include <cstdint>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/data/events.h"
#include "monitor/data/options.h"
#include "monitor/data/sample.h"

namespace ehm::monitor {

/// Channels of condition_fault: 0 altitude_m, 1 mach, 2 delta_isa_k, then the actuators.
inline constexpr std::uint32_t flight_words = 3;

/// One word over time.
class WordCheck {
 public:
  enum class State { good, held, moved, lost };

  /// A word farther from `centre` than `farthest` is as bad as one that is not finite.
  WordCheck(double jump, double slew_per_sample, double centre, double farthest, const CheckOptions& options)
      : jump_(jump),
        slew_(slew_per_sample),
        centre_(centre),
        farthest_(farthest),
        bridge_(options.bridge_samples),
        requalify_(options.requalify_samples) {}

  /// Takes a word, `steps` sample times after the last one.
  State take(double word, int steps) noexcept;
  /// What to use for it; `otherwise` where there has been no good one.
  double value(double otherwise) const noexcept { return has_good_ ? good_ : otherwise; }
  /// Good words since it moved or was lost are enough to say so.
  bool steady() const noexcept { return good_run_ >= requalify_; }
  void reset() noexcept;

 private:
  bool near(double word, double other, std::int64_t samples) const noexcept;
  State believe(double word, State state) noexcept;
  State doubt() noexcept;

  double jump_, slew_, centre_, farthest_;
  std::int64_t bridge_, requalify_;
  double good_ = 0.0, before_ = 0.0, candidate_ = 0.0;
  bool has_good_ = false, has_before_ = false;
  std::int64_t good_run_ = 0;       ///< good words since the last move or loss
  std::int64_t bad_run_ = 0;        ///< bad words in a row
  std::int64_t candidate_run_ = 0;  ///< of them, those that agree with each other
  std::int64_t since_good_ = 0;     ///< samples
};

class ConditionCheck {
 public:
  ConditionCheck(const CheckOptions& options, const linear_model::LinearModel& model);

  /// Puts good words in the place of bad ones. False where a word is lost: the sample is not to be estimated from.
  bool mend(Sample& sample, int steps, EventList& events) noexcept;
  /// Words of the latest sample that were replaced.
  std::uint64_t replaced() const noexcept { return replaced_; }
  /// As before the first sample.
  void reset(EventList& events) noexcept;

 private:
  bool mend(std::size_t word, double& value, int steps, EventList& events) noexcept;

  std::vector<WordCheck> words_;
  std::vector<double> otherwise_;
  std::vector<Condition> fault_;
  std::uint64_t replaced_ = 0;
};

}  // namespace ehm::monitor
