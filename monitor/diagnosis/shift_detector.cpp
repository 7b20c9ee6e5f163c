// SPDX-License-Identifier: Apache-2.0
#include "monitor/diagnosis/shift_detector.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/design/closed_loop.h"
#include "monitor/diagnosis/quantiles.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::monitor {

namespace {

ShiftStatistic make_statistic(const design::Design& design, const design::SubsetDesign& subset) {
  const auto model = linear_model::scaled(design.model, design.scaling);
  const auto steady = estimation::steady_gain(model);
  const Eigen::MatrixXd scatter = 2.0 * design::tuner_noise(subset, model);
  const Eigen::LLT<Eigen::MatrixXd> factor(scatter);
  if (factor.info() != Eigen::Success)
    throw std::invalid_argument("the design's noise covariance of the tuners is not positive definite");
  // S = lower rows of (I - Acl)^-1 K H: the filter's answer to a constant h; column i is s_i.
  const Eigen::MatrixXd response =
      design::settled(design::closed_loop(subset), subset.K * steady.H).bottomRows(subset.V.rows());

  ShiftStatistic s;
  const auto tuners = subset.V.rows();
  s.information = factor.solve(Eigen::MatrixXd::Identity(tuners, tuners));
  s.signature = factor.solve(response).transpose();
  s.signature_information = (s.signature * response).diagonal();
  s.looks_per_hour = 3600.0 / subset.slowest_time_constant_s;
  s.settling_samples =
      static_cast<std::int64_t>(std::ceil(4.0 * subset.slowest_time_constant_s / design.model.sample_time_s));
  return s;
}

}  // namespace

std::shared_ptr<const ShiftTables> shift_tables(const design::Design& design) {
  auto tables = std::make_shared<ShiftTables>();
  tables->emplace_back(make_statistic(design, design.full));
  for (const auto& subset : design.missing)
    tables->push_back(subset ? std::optional(make_statistic(design, *subset)) : std::nullopt);
  return tables;
}

ShiftDetector::ShiftDetector(const ShiftOptions& options, const design::Design& design,
                             std::shared_ptr<const ShiftTables> tables)
    : tables_(std::move(tables)),
      health_scales_(design.scaling.health),
      length_(static_cast<std::size_t>(std::max(1.0, std::round(options.window_s / design.model.sample_time_s)))) {
  for (const auto& table : *tables_)
    thresholds_.push_back(
        table ? chi_square_quantile(static_cast<double>(table->information.rows()),
                                    normal_quantile_above(options.false_alarm_per_hour / table->looks_per_hour))
              : 0.0);
  for (const auto& table : *tables_)
    if (table) stride_ = std::max(stride_, as_size(table->information.rows()));
  window_.resize(length_ * stride_);
  persistence_samples_ = static_cast<std::int64_t>(std::round(options.persistence_s / design.model.sample_time_s));
}

void ShiftDetector::reset() noexcept {
  next_ = filled_ = 0;
  above_ = since_start_ = hold_ = 0;
}

Event ShiftDetector::isolate(const estimation::TunerVector& change) const noexcept {
  Eigen::Index best = 0;
  double best_ratio = -1.0, best_size = 0.0;
  for (Eigen::Index i = 0; i < active().signature_information.size(); ++i) {
    const double information = active().signature_information(i);
    if (!(information > 0.0)) continue;  // the sensors do not see this parameter
    const double size = active().signature.row(i).dot(change) / information;
    if (const double ratio = size * size * information; ratio > best_ratio)
      best = i, best_ratio = ratio, best_size = size;
  }
  const double scale = health_scales_(best);
  const double least = std::sqrt(threshold() / active().signature_information(best));
  return {.kind = idl::EventKind::health_shift,
          .channel = static_cast<std::uint32_t>(best),
          .raised = true,
          .value = scale * best_size,
          .threshold = scale * least};
}

void ShiftDetector::name(const Event& shift, EventList& events) noexcept {
  if (condition_.raised()) return;
  named_ = shift;
  hold_ = static_cast<std::int64_t>(length_);
  condition_.set(true, named_, events);
}

void ShiftDetector::check(const estimation::TunerVector& tuners, int missing, bool wait, EventList& events) noexcept {
  if (const auto set = as_size(missing + 1); set != active_) {
    active_ = set;
    reset();
  }
  if (since_start_ < active().settling_samples) {
    ++since_start_;
    return;
  }
  Eigen::Map<Eigen::VectorXd> oldest(window_.data() + next_ * stride_, tuners.size());
  estimation::TunerVector change;
  if (filled_ == length_) change = tuners - oldest;
  oldest = tuners;
  next_ = (next_ + 1) % length_;
  if (filled_ < length_) {
    ++filled_;
    return;
  }

  const double statistic = change.dot(active().information.lazyProduct(change));
  if (condition_.raised()) {
    if (hold_ > 0) {
      --hold_;
    } else if (statistic < 0.5 * threshold()) {
      above_ = 0;
      condition_.set(false, named_, events);
    }
    return;
  }
  above_ = statistic > threshold() ? above_ + 1 : 0;
  if (!wait && above_ > persistence_samples_) {
    named_ = isolate(change);
    condition_.set(true, named_, events);
  }
}

}  // namespace ehm::monitor
