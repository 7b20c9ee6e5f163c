// SPDX-License-Identifier: Apache-2.0
#pragma once
// Finds a step of health: the tuner estimate is compared with itself one window ago.
//
//   d      = q[k] - q[k-w]                        t tuners, percent
//   D      = d^T (2 S_q)^-1 d                     chi-square with t degrees of freedom while nothing changes;
//                                                 S_q = V (Th S Th^T) V^T, both ends independent after w
//   s_i    = [(I-Acl)^-1 Kinf H]_q e_i            how q answers to one percent of health parameter i in steady state
//   a_i    = s_i^T (2 S_q)^-1 d / g_i             its most likely size, g_i = s_i^T (2 S_q)^-1 s_i
//   i*     = argmax a_i^2 g_i                     the single parameter that explains most
//                                                 (generalised likelihood ratio)
//
// Raised when D has exceeded its threshold for the persistence time without a break, as an event on channel i* with
// value a_i* and threshold the smallest a_i* that D would see. Cleared when D is below half the threshold. Slow wear
// does not raise it; a sensor bias below the innovation gate does look like a health change and is named as one. The
// threshold is the chi-square quantile at false_alarm_per_hour over independent looks, by Wilson and Hilferty's cube
// root. An abrupt change is usually named earlier by the fault detector (fault_detector.h); this comparison then only
// tells when it has settled, and names what was too slow or too small for that. Source of the ratio: Basseville &
// Nikiforov, Detection of Abrupt Changes, ch. 7 (linear Gaussian case).

#include <memory>
#include <optional>
#include <vector>

#include "monitor/data/events.h"
#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/estimation/capacity.h"

namespace ehm::monitor {

/// Constants of one sensor set.
struct ShiftStatistic {
  estimation::BoundedMatrix<estimation::max_tuners, estimation::max_tuners> information;  ///< (2 S_q)^-1
  estimation::BoundedMatrix<estimation::max_health, estimation::max_tuners> signature;    ///< s_i^T (2 S_q)^-1
  estimation::HealthVector signature_information;                                         ///< g_i
  double looks_per_hour = 0.0;                                                            ///< independent ones
  std::int64_t settling_samples = 0;  ///< four of the slowest time constants: the start must not look like a change
};

/// [0] full set, [1 + i] without sensor i, empty where no design flies so.
using ShiftTables = std::vector<std::optional<ShiftStatistic>>;

/// What the detectors of all engines of one design share. @throws std::invalid_argument if S_q is not definite.
std::shared_ptr<const ShiftTables> shift_tables(const design::Design& design);

class ShiftDetector {
 public:
  /// `tables` as shift_tables(design) makes them.
  ShiftDetector(const ShiftOptions& options, const design::Design& design, std::shared_ptr<const ShiftTables> tables);

  /// Takes the estimate of one sample. `missing` is the sensor that the present design lacks, -1 for none; a change of
  /// it starts the comparison anew. With `wait` nothing is named. Real-time safe: yes.
  void check(const estimation::TunerVector& tuners, int missing, bool wait, EventList& events) noexcept;
  /// The fault detector has already found which parameter it was, and how much. Real-time safe: yes.
  void name(const Event& shift, EventList& events) noexcept;
  /// Starts the comparison anew, after a restart of the filter. Real-time safe: yes.
  void reset() noexcept;

  /// Nobody looks at the tuners any more: what was raised ends. Real-time safe: yes.
  void end(EventList& events) noexcept { condition_.reassess(idl::EventKind::health_shift, named_.channel, events); }

  bool raised() const noexcept { return condition_.raised(); }
  double threshold() const noexcept { return thresholds_[active_]; }

 private:
  const ShiftStatistic& active() const noexcept { return *(*tables_)[active_]; }
  Event isolate(const estimation::TunerVector& change) const noexcept;

  std::shared_ptr<const ShiftTables> tables_;
  std::vector<double> thresholds_;  ///< as tables_
  std::size_t active_ = 0;
  estimation::HealthVector health_scales_;

  std::size_t length_, stride_ = 0;  ///< w, and the most tuners of a set
  std::vector<double> window_;       ///< ring of the last w estimates, a stride each
  std::size_t next_ = 0, filled_ = 0;
  std::int64_t persistence_samples_, above_ = 0, since_start_ = 0;
  std::int64_t hold_ = 0;  ///< samples until the window has seen the whole of a change that was named early
  Condition condition_;
  Event named_;
};

}  // namespace ehm::monitor
