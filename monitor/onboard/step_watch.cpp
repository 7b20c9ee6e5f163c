// SPDX-License-Identifier: Apache-2.0
#include "monitor/onboard/step_watch.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace ehm::onboard {
namespace {

using estimation::SensorMask;
using estimation::SensorVector;
using SensorMatrix = estimation::BoundedMatrix<estimation::max_sensors, estimation::max_sensors>;

constexpr double test_every_s = 0.25;
constexpr double most_sigmas = 6.0;    ///< of a reading that is held back
constexpr double filling_means = 2.0;  ///< mean times after a reset, until the mean is one

}  // namespace

StepWatch::StepWatch(const UnknownLayout& layout, const OnBoardOptions& options)
    : layout_(layout),
      gain_(-std::expm1(-options.sample_time_s / options.step_mean_s)),
      threshold_(options.step_threshold),
      explains_(options.step_explains),
      test_samples_(std::max<std::int64_t>(1, std::llround(test_every_s / options.sample_time_s))),
      filling_samples_(std::llround(filling_means * options.step_mean_s / options.sample_time_s)),
      confirm_samples_(std::llround(options.step_confirm_s / options.sample_time_s)),
      finding_{.health = estimation::HealthVector::Zero(layout.health_count),
               .sensor = SensorVector::Zero(layout.sensor_count)} {
  reset();
}

void StepWatch::reset() noexcept {
  samples_ = above_ = 0;
  mean_.setZero(layout_.sensor_count);
  statistic_ = 0.0;
}

bool StepWatch::take(const estimation::Innovation& percent, SensorMask in_use, SensorMask fused,
                     const EngineTangent& tangent, const UnknownCovariance& covariance,
                     const ReadingDoubt& doubt) noexcept {
  for (Eigen::Index i = 0; i < layout_.sensor_count; ++i) {
    const auto s = as_size(i);
    const double most = most_sigmas * std::sqrt(percent.variance(i));
    const double value = fused[s] ? percent.value(i) : std::clamp(percent.value(i), -most, most);
    if (!in_use[s])
      mean_(i) = 0.0;
    else if (std::isfinite(value))
      mean_(i) += gain_ * (value - mean_(i));
  }
  ++samples_;
  if (samples_ < filling_samples_ || samples_ % test_samples_ != 0) return false;
  above_ = test(in_use, tangent, covariance, doubt) ? above_ + test_samples_ : 0;
  if (above_ <= confirm_samples_) return false;
  reset();
  return true;
}

bool StepWatch::test(SensorMask in_use, const EngineTangent& tangent, const UnknownCovariance& covariance,
                     const ReadingDoubt& doubt) noexcept {
  const Eigen::Index m = layout_.sensor_count, p = layout_.health_count;
  SensorMatrix s = tangent.readings() * covariance.matrix() * tangent.readings().transpose();
  s.diagonal() += gain_ / (2.0 - gain_) * doubt.noise + doubt.slow;
  estimation::BoundedMatrix<estimation::max_sensors, most_health + estimation::max_sensors> slopes(m, p + m);
  slopes << tangent.settled_health(), SensorMatrix::Identity(m, m);
  for (Eigen::Index i = 0; i < m; ++i) {
    if (in_use[as_size(i)]) continue;  // tells nothing otherwise
    s.row(i).setZero();
    s.col(i).setZero();
    s(i, i) = 1.0;
    slopes.row(i).setZero();
  }
  const Eigen::LLT<SensorMatrix> root(s);
  if (root.info() != Eigen::Success) return false;
  const SensorVector white = root.matrixL().solve(mean_);
  root.matrixL().solveInPlace(slopes);
  statistic_ = white.squaredNorm();
  if (!(statistic_ > threshold_)) return false;

  const auto information = slopes.colwise().squaredNorm().transpose().eval();
  const auto explained = (slopes.transpose() * white).eval();  // s_j' S^-1 v
  const auto share = [&](Eigen::Index j) {
    return information(j) > 0.0 ? explained(j) * explained(j) / information(j) : 0.0;
  };
  Eigen::Index best = 0;
  for (Eigen::Index j = 1; j < p + m; ++j)
    if (share(j) > share(best)) best = j;
  if (share(best) < explains_ * statistic_) return false;
  double sum = 0.0;
  for (Eigen::Index j = 0; j < p + m; ++j) {
    const double weight = information(j) > 0.0 ? std::exp(0.5 * (share(j) - share(best))) : 0.0;
    (j < p ? finding_.health(j) : finding_.sensor(j - p)) = weight;
    sum += weight;
  }
  finding_.health /= sum;
  finding_.sensor /= sum;
  finding_.parameter = best < p ? best : -1;
  finding_.size_percent = explained(best) / information(best);
  finding_.threshold_percent = std::sqrt(threshold_ / information(best));
  return true;
}

}  // namespace ehm::onboard
