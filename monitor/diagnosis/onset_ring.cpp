// SPDX-License-Identifier: Apache-2.0
#include "monitor/diagnosis/onset_ring.h"

#include <algorithm>
#include <bit>

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/linear/matrix_vector_product.h"

namespace ehm::monitor {

namespace {
constexpr int kept_by_all = 8;  // samples
}

void OnsetRing::start(const FaultSignatures& signatures) noexcept {
  signatures_ = &signatures;
  count_ = 0;
  next_ = 0;
  largest_ = 0.0;
}

bool OnsetRing::expired(const Onset& onset) const noexcept {
  if (onset.age >= signatures_->ages) return true;
  const int octave = std::min(16, std::countr_zero(onset.number | (1u << 16)));
  return onset.age >= kept_by_all << octave;
}

void OnsetRing::step(const estimation::SensorVector& innovation, estimation::SensorMask present, int steps) noexcept {
  const FaultSignatures& s = *signatures_;
  for (int i = 0; i < count_;) {
    onsets_[as_size(i)].age += steps;
    if (expired(onsets_[as_size(i)]))
      onsets_[as_size(i)] = onsets_[as_size(--count_)];
    else
      ++i;
  }
  if (count_ == most_onsets) --count_;  // cannot happen within 512 ages
  Onset& opened = onsets_[as_size(count_++)];
  opened = Onset{};
  opened.number = next_++;

  estimation::SensorVector nu = innovation;
  for (int i = 0; i < s.sensors; ++i)
    if (!present[as_size(i)]) nu(i) = 0.0;
  double energy = 0.0;
  for (int i = 0; i < s.sensors; ++i) energy += nu(i) * s.inverse_S.col(i).head(s.sensors).dot(nu);
  const auto degrees = static_cast<double>(present.count());

  largest_ = 0.0;
  for (int i = 0; i < count_; ++i) {
    Onset& onset = onsets_[as_size(i)];
    estimation::add_product(s.weight.middleCols(onset.age * s.sensors, s.sensors), nu.data(), onset.sum.data());
    onset.energy += energy;
    onset.degrees += degrees;
    const double* information = s.information.col(onset.age).data();
    for (int j = 0; j < s.hypotheses; ++j) {
      const double d = onset.sum[as_size(j)];
      if (d * d > largest_ * information[j]) largest_ = d * d / information[j];
    }
  }
}

OnsetRing::Evidence OnsetRing::best(int hypothesis) const noexcept {
  Evidence best;
  for (int i = 0; i < count_; ++i) {
    const Onset& onset = onsets_[as_size(i)];
    const double d = onset.sum[as_size(hypothesis)];
    const double information = signatures_->information(hypothesis, onset.age);
    if (d * d > best.ratio * information)
      best = {d * d / information, d / information, onset.age, onset.energy, onset.degrees};
  }
  return best;
}

}  // namespace ehm::monitor
