// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the on-board estimator keeps of a flight for the next one of the same engine: health and the causes of mismatch
// (unknowns.h, p + c values in that order), and how well they are known together. What is reported
// wrongly of air data and fuel is taken to be another error in every flight, and is not kept.
//   next flight   P <- [P_k 0; 0 I] + diag(w^2, 0)     k: all but the inputs' causes;  w: wear since, percent
// Errors: none.

#include "monitor/estimation/learned.h"
#include "monitor/onboard/unknowns.h"

namespace ehm::onboard {

using estimation::Learned;
static_assert(most_health + max_causes <= estimation::max_learned);

/// Of a fleet's engine that nobody knows: no health, no causes, with the spreads of the engine file and of the causes.
inline Learned learned_nothing(const OnBoardModel& model) {
  const UnknownLayout layout(model);
  const Eigen::Index n = layout.health_count + layout.cause_count;
  Learned nothing;
  nothing.value.setZero(n);
  nothing.covariance.setIdentity(n, n);
  const auto& health = model.definition().channels.health;
  for (std::size_t i = 0; i < health.size(); ++i)
    nothing.covariance(as_index(i), as_index(i)) = 1e4 * health[i].sigma * health[i].sigma;
  return nothing;
}

/// What is known at the start of the next flight, after wear of a standard deviation of so much in each parameter.
inline Learned after_wear(Learned learned, const OnBoardModel& model, double wear_percent) {
  const UnknownLayout layout(model);
  learned.covariance.diagonal().head(layout.health_count).array() += wear_percent * wear_percent;
  for (Eigen::Index i = 0; i < layout.cause_count; ++i) {
    if (model.causes()[as_size(i)].kind != CauseKind::input) continue;
    const Eigen::Index at = layout.health_count + i;
    learned.value(at) = 0.0;
    learned.covariance.row(at).setZero();
    learned.covariance.col(at).setZero();
    learned.covariance(at, at) = 1.0;
  }
  return learned;
}

}  // namespace ehm::onboard
