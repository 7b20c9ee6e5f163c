// SPDX-License-Identifier: Apache-2.0
#pragma once
// The running sums of the likelihood ratio for a bounded number of onsets.
//
// For each onset theta that is kept, age a = k - theta, and each hypothesis j (fault_signatures.h):
//   d_j = sum over ages of g_j[a]^T S^-1 nu        E = sum of nu^T S^-1 nu       dof = number of values in E
//   l_j = d_j^2 / J_j[a]                           chi-square with one degree of freedom while nothing happens
//   size_j = d_j / J_j[a]                          the most likely size of the fault
//
// Every sample opens an onset. An onset whose number has r trailing zero bits is kept until age 8 2^r: all of the last
// eight samples, then four an octave. The nearest kept onset lies within an eighth of the age of the true one, which
// costs a slowly changing signature next to nothing, and 200 samples need 28 onsets.
// After lost samples the ages jump: the sums lack what those samples would have said.
// Real-time safe: yes, after construction.

#include <cstdint>
#include <vector>

#include "monitor/diagnosis/fault_signatures.h"
#include "monitor/estimation/capacity.h"

namespace ehm::monitor {

class OnsetRing {
 public:
  struct Evidence {
    double ratio = 0.0;  ///< l_j
    double size = 0.0;   ///< in the hypothesis' unit
    int age = 0;         ///< samples since the onset; 0: this sample
    double energy = 0.0, degrees = 0.0;
  };

  /// With room for `signatures` and all that have as many hypotheses and ages.
  explicit OnsetRing(const FaultSignatures& signatures);
  /// Forgets everything; `signatures` must outlive the use.
  void start(const FaultSignatures& signatures) noexcept;
  /// Takes the innovations of one sample, scaled; `present` are the sensors that have one. `steps` sample times after
  /// the last.
  void step(const estimation::SensorVector& innovation, estimation::SensorMask present, int steps) noexcept;
  /// The largest l_j of all hypotheses and onsets.
  double largest() const noexcept { return largest_; }
  /// The onset that speaks most for hypothesis j.
  Evidence best(int hypothesis) const noexcept;

 private:
  struct Onset {
    std::uint64_t number = 0;
    double energy = 0.0, degrees = 0.0;
    int age = 0;
    std::uint32_t place = 0;  ///< of its sums, for ever
  };
  bool expired(const Onset& onset) const noexcept;
  double* sums(const Onset& onset) noexcept { return sums_.data() + onset.place * hypotheses_; }
  const double* sums(const Onset& onset) const noexcept { return sums_.data() + onset.place * hypotheses_; }
  void open() noexcept;

  const FaultSignatures* signatures_;
  std::size_t hypotheses_;
  std::vector<Onset> onsets_;
  std::vector<double> sums_;  ///< d_j of each onset
  std::size_t count_ = 0;
  std::uint64_t next_ = 0;
  double largest_ = 0.0;
};

}  // namespace ehm::monitor
