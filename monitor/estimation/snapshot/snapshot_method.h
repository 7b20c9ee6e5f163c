// SPDX-License-Identifier: Apache-2.0
#pragma once
// What makes an estimate of health, in sigmas of the fleet, of samples e (snapshot_model.h), and knows the error of it:
// the part in which the estimators of this folder differ. The rest of them is snapshot_estimator.h.
//
// Errors: none. Real-time safe: yes, all but fresh().

#include <memory>

#include "monitor/estimation/snapshot/snapshot_error.h"

namespace ehm::estimation {

class SnapshotMethod {
 public:
  virtual ~SnapshotMethod() = default;
  /// A new one of the same constants. Allocates.
  [[nodiscard]] virtual std::unique_ptr<SnapshotMethod> fresh() const = 0;

  /// Nothing is seen.
  virtual void reset() noexcept = 0;
  /// So many samples further, 1 or more.
  virtual void pass(int samples) noexcept = 0;
  /// Entries of sensors that are not fused may be NaN. @returns whether that is an answer to this sample; if not, the
  /// one before stands.
  virtual bool update(const SensorVector& readings, SensorMask fused) noexcept = 0;
  /// Goes on from there. False, and nothing is changed: not a state of this method.
  virtual bool restore(const HealthVector& health, const SnapshotError& error) noexcept = 0;
  /// Goes on from another health; the error stays. False, and nothing is changed: it cannot.
  virtual bool correct(const HealthVector& health) noexcept = 0;

  [[nodiscard]] virtual const HealthVector& health() const noexcept = 0;
  [[nodiscard]] virtual const SnapshotError& error() const noexcept = 0;
  /// What it takes the covariance of its error for.
  [[nodiscard]] virtual HealthCovariance own_covariance() const noexcept = 0;

 protected:
  SnapshotMethod() = default;
  SnapshotMethod(const SnapshotMethod&) = default;
  SnapshotMethod& operator=(const SnapshotMethod&) = default;
};

}  // namespace ehm::estimation
