// SPDX-License-Identifier: Apache-2.0
#include "monitor/diagnosis/fleet_watch.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/scaling.h"
#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/design/closed_loop.h"
#include "monitor/diagnosis/quantiles.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::monitor {

namespace {

constexpr double common_tail = 0.003, ordinary_tail = 1e-3;
constexpr double stands_apart = 4.0;
constexpr double clear_share = 0.8;

}  // namespace

FleetTable fleet_table(const design::Design& design, const design::SubsetDesign& subset,
                       const estimation::ErrorModel& error) {
  const linear_model::LinearModel model = linear_model::scaled(design.model, design.scaling);
  const Eigen::MatrixXd H = estimation::steady_gain(model).H;
  const Eigen::MatrixXd closed_loop = error.closed_loop;
  const Eigen::Index t = subset.V.rows();
  const Eigen::MatrixXd mean = design::settled(closed_loop, error.drive).bottomRows(t);
  const Eigen::MatrixXd covariance =
      mean * mean.transpose() + linear_model::stationary_covariance(closed_loop, error.noise).bottomRightCorner(t, t);
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  if (factor.info() != Eigen::Success)
    throw std::invalid_argument("the covariance of the design's tuners over the fleet is not positive definite");
  const Eigen::MatrixXd HW = H * subset.W;
  const double samples = subset.averaged_samples(model.sample_time_s);
  const Eigen::MatrixXd of_sensors =
      HW * covariance * HW.transpose() + Eigen::MatrixXd(model.sensor_noise_sigma.cwiseAbs2().asDiagonal()) / samples;
  const Eigen::MatrixXd inverse = of_sensors.llt().solve(Eigen::MatrixXd::Identity(H.rows(), H.rows()));

  FleetTable table;
  table.information = factor.solve(Eigen::MatrixXd::Identity(t, t));
  table.stance = inverse.diagonal().cwiseSqrt().cwiseInverse().asDiagonal() * inverse * HW;
  table.tuners = static_cast<double>(t);
  table.common = chi_square_quantile(table.tuners, normal_quantile_above(common_tail));
  table.ordinary = chi_square_quantile(table.tuners, normal_quantile_above(ordinary_tail));
  return table;
}

std::shared_ptr<const FleetTables> fleet_tables(const design::Design& design,
                                                const std::vector<estimation::ErrorModel>& error_models) {
  auto tables = std::make_shared<FleetTables>();
  tables->emplace_back(fleet_table(design, design.full, error_models.front()));
  for (std::size_t i = 0; i < design.missing.size(); ++i)
    tables->push_back(design.missing[i] ? std::optional(fleet_table(design, *design.missing[i], error_models[1 + i]))
                                        : std::nullopt);
  return tables;
}

FleetWatch::FleetWatch(const FleetOptions& options, const linear_model::LinearModel& model,
                       std::shared_ptr<const FleetTables> tables)
    : tables_(std::move(tables)),
      warn_sigma_(options.warn_sigma),
      farther_(options.withhold_sigma / options.warn_sigma),
      persistence_samples_(std::llround(options.persistence_s / model.sample_time_s)),
      trim_(as_index(model.health.size())),
      sigma_(model.health_sigma),
      far_(model.health.size()),
      implausible_health_(model.health.size()) {
  const double z = normal_quantile_above(std::erfc(warn_sigma_ / std::sqrt(2.0)));
  for (const auto& table : *tables_)
    distance_limits_.push_back(table ? std::sqrt(chi_square_quantile(table->tuners, z)) : 0.0);
  for (Eigen::Index i = 0; i < trim_.size(); ++i) trim_(i) = model.health[as_size(i)].trim;
}

bool FleetWatch::Persistent::check(double value, double limit, std::int64_t persistence) noexcept {
  above = value > limit ? above + 1 : 0;
  raised = raised ? value > clear_share * limit : above > persistence;
  return raised;
}

void FleetWatch::check(const estimation::TunerVector& tuners, const estimation::HealthVector& health, int missing,
                       EventList& events) noexcept {
  const auto set = as_size(1 + missing);
  const FleetTable& table = *(*tables_)[set];
  const double distance2 = table.distance2(tuners);
  overflown_ = !std::isfinite(distance2);
  if (overflown_) return;
  excess_ = table.excess(distance2);

  const double distance = std::sqrt(std::max(0.0, distance2)), limit = distance_limits_[set];
  implausible_ = far_together_.check(distance, limit, persistence_samples_);
  unlikely_.set(implausible_,
                {.kind = idl::EventKind::unlikely_engine,
                 .value = distance,
                 .threshold = limit,
                 .detail = implausible_ != unlikely_.raised() ? apart(tuners, table) : 0},
                events);
  double farthest = distance / limit;
  for (Eigen::Index i = 0; i < health.size(); ++i) {
    if (!(sigma_(i) > 0.0)) continue;  // no engine of the fleet differs in it
    const auto at = as_size(i);
    const double z = std::abs(health(i) - trim_(i)) / sigma_(i);
    const bool far = far_[at].check(z, warn_sigma_, persistence_samples_);
    implausible_health_[at].set(far,
                                {.kind = idl::EventKind::implausible,
                                 .channel = static_cast<std::uint32_t>(i),
                                 .value = z,
                                 .threshold = warn_sigma_},
                                events);
    implausible_ = implausible_ || far;
    farthest = std::max(farthest, z / warn_sigma_);
  }
  withheld_.check(farthest, farther_, persistence_samples_);
}

std::uint32_t FleetWatch::apart(const estimation::TunerVector& tuners, const FleetTable& table) const noexcept {
  std::uint32_t sensors = 0;
  for (Eigen::Index i = 0; i < table.stance.rows(); ++i)
    if (std::abs(table.stance.row(i).dot(tuners)) > stands_apart) sensors |= 1u << i;
  return sensors;
}

void FleetWatch::reset(EventList& events) noexcept {
  for (std::size_t i = 0; i < far_.size(); ++i) {
    far_[i] = {};
    implausible_health_[i].reassess(idl::EventKind::implausible, static_cast<std::uint32_t>(i), events);
  }
  far_together_ = withheld_ = {};
  unlikely_.reassess(idl::EventKind::unlikely_engine, 0, events);
  excess_ = 1.0;
  implausible_ = overflown_ = false;
}

}  // namespace ehm::monitor
