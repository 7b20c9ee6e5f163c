// SPDX-License-Identifier: Apache-2.0
#include "monitor/diagnosis/onset_ring.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/linear/matrix_vector_product.h"

namespace ehm::monitor {

namespace {
constexpr int kept_by_all = 8;  // samples
}

/// 4 onsets an octave, and the 8 that all are kept for; what has aged goes before another one comes.
OnsetRing::OnsetRing(const FaultSignatures& signatures)
    : signatures_(&signatures),
      hypotheses_(as_size(signatures.hypotheses)),
      onsets_(kept_by_all + 4 * as_size(std::bit_width(static_cast<unsigned>((signatures.ages - 1) / kept_by_all)))),
      sums_(onsets_.size() * hypotheses_) {
  for (std::uint32_t i = 0; i < onsets_.size(); ++i) onsets_[i].place = i;
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

void OnsetRing::open() noexcept {
  if (count_ == onsets_.size()) --count_;  // cannot happen: it has room for all that are kept
  Onset& opened = onsets_[count_++];
  opened = {.number = next_++, .place = opened.place};
  std::fill_n(sums(opened), hypotheses_, 0.0);
}

void OnsetRing::step(const estimation::SensorVector& innovation, estimation::SensorMask present, int steps) noexcept {
  const FaultSignatures& s = *signatures_;
  for (std::size_t i = 0; i < count_;) {
    onsets_[i].age += steps;
    if (expired(onsets_[i]))
      std::swap(onsets_[i], onsets_[--count_]);
    else
      ++i;
  }
  open();

  estimation::SensorVector nu = innovation;
  for (int i = 0; i < s.sensors; ++i)
    if (!present[as_size(i)]) nu(i) = 0.0;
  double energy = 0.0;
  for (int i = 0; i < s.sensors; ++i) energy += nu(i) * s.inverse_S.col(i).head(s.sensors).dot(nu);
  const auto degrees = static_cast<double>(present.count());

  largest_ = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    Onset& onset = onsets_[i];
    double* sum = sums(onset);
    estimation::add_product(s.weight.middleCols(onset.age * s.sensors, s.sensors), nu.data(), sum);
    onset.energy += energy;
    onset.degrees += degrees;
    const double* information = s.information.col(onset.age).data();
    for (int j = 0; j < s.hypotheses; ++j) {
      const double d = sum[j];
      if (d * d > largest_ * information[j]) largest_ = d * d / information[j];
    }
  }
}

OnsetRing::Evidence OnsetRing::best(int hypothesis) const noexcept {
  Evidence best;
  for (std::size_t i = 0; i < count_; ++i) {
    const Onset& onset = onsets_[i];
    const double d = sums(onset)[hypothesis];
    const double information = signatures_->information(hypothesis, onset.age);
    if (d * d > best.ratio * information)
      best = {d * d / information, d / information, onset.age, onset.energy, onset.degrees};
  }
  return best;
}

}  // namespace ehm::monitor
