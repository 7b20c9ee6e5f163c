// SPDX-License-Identifier: Apache-2.0
#include "monitor/schedule/point_lookup.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/model/units.h"

namespace ehm::schedule {
namespace {

constexpr double least_weight = 0.5;  ///< of valid nodes around a place

/// `visit(matrix)` for each part of a node or a point model, in one order.
template <class Model, class Visit>
void each_part(Model& model, Visit&& visit) {
  visit(model.x0), visit(model.u0), visit(model.y0), visit(model.z0);
  visit(model.A), visit(model.B), visit(model.L);
  visit(model.C), visit(model.D), visit(model.M);
  visit(model.F), visit(model.G), visit(model.N);
  visit(model.lambda_x), visit(model.lambda_y), visit(model.lambda_z);
}

Eigen::Index size_of(const Node& node) {
  Eigen::Index size = 0;
  each_part(node, [&](const auto& part) { size += part.size(); });
  return size;
}

double factor(const Similarity& s, const Place& place) noexcept {
  return std::pow(place.delta, s.delta_power) * std::pow(place.theta, s.theta_power);
}

}  // namespace

PointLookup::PointLookup(Schedule schedule) : schedule_(std::move(schedule)) {
  std::size_t count = 1;
  for (const Axis& axis : schedule_.axes) {
    if (axis.points.size() < 2 || !std::is_sorted(axis.points.begin(), axis.points.end(), std::less_equal<>()))
      throw std::invalid_argument(std::string("schedule: the axis ") +
                                  variable_names[static_cast<std::size_t>(axis.variable)] +
                                  " needs two points or more, ascending");
    count *= axis.points.size();
  }
  if (schedule_.axes.empty() || schedule_.axes.size() > as_size(max_variables) || schedule_.nodes.size() != count)
    throw std::invalid_argument("schedule: " + std::to_string(schedule_.nodes.size()) +
                                " nodes do not fill a grid of " + std::to_string(count) + " by " +
                                std::to_string(schedule_.axes.size()) + " variables (1 to 3)");
  const auto first =
      std::find_if(schedule_.nodes.begin(), schedule_.nodes.end(), [](const Node& n) { return n.valid; });
  if (first == schedule_.nodes.end()) throw std::invalid_argument("schedule: no node is valid");
  states_ = first->x0.size();
  actuators_ = first->u0.size();
  sensors_ = first->y0.size();
  auxiliary_ = first->z0.size();
  health_ = first->L.cols();
  numbers_.setZero(size_of(*first), as_index(count));
  for (std::size_t k = 0; k < count; ++k) {
    const Node& node = schedule_.nodes[k];
    if (!node.valid) continue;
    if (size_of(node) != numbers_.rows())
      throw std::invalid_argument("schedule: node " + std::to_string(k) + " has other shapes than the first");
    Eigen::Index at = 0;
    each_part(node, [&](const auto& part) {
      numbers_.col(as_index(k)).segment(at, part.size()) = part.reshaped();
      at += part.size();
    });
  }
}

double PointLookup::coordinate(Variable variable, const Place& place) noexcept {
  switch (variable) {
    case Variable::n1_corrected:
      return place.n1_corrected_rpm;
    case Variable::mach:
      return place.mach;
    case Variable::t2:
      return place.theta * engine_sim::reference_temperature_k;
    case Variable::altitude:
      return place.altitude_m;
  }
  return 0.0;
}

/// The valid nodes of the cell, weights summing to one; none where they weigh too little.
int PointLookup::corners(const Place& place, std::array<Corner, 8>& around) const noexcept {
  int count = 1;
  around[0] = {0, 1.0};
  Eigen::Index stride = 1;
  for (const Axis& axis : schedule_.axes) {
    const std::vector<double>& p = axis.points;
    const double x = std::clamp(coordinate(axis.variable, place), p.front(), p.back());
    const auto above = std::clamp<std::ptrdiff_t>(std::upper_bound(p.begin(), p.end(), x) - p.begin(), 1,
                                                  static_cast<std::ptrdiff_t>(p.size()) - 1);
    const auto hi = static_cast<std::size_t>(above);
    const double share = (x - p[hi - 1]) / (p[hi] - p[hi - 1]);
    for (int i = 0; i < count; ++i) {
      Corner& low = around[as_size(i)];
      around[as_size(i + count)] = {low.node + stride * above, low.weight * share};
      low = {low.node + stride * (above - 1), low.weight * (1.0 - share)};
    }
    count *= 2;
    stride *= as_index(p.size());
  }
  double weight = 0.0;
  int valid = 0;
  for (int i = 0; i < count; ++i) {
    const Corner corner = around[as_size(i)];
    if (corner.weight == 0.0 || !schedule_.nodes[as_size(corner.node)].valid) continue;
    around[as_size(valid++)] = corner;
    weight += corner.weight;
  }
  if (!(weight >= least_weight)) return 0;
  for (int i = 0; i < valid; ++i) around[as_size(i)].weight /= weight;
  return valid;
}

bool PointLookup::at(const Place& place, PointModel& model) const noexcept {
  std::array<Corner, 8> around;
  const int count = corners(place, around);
  if (count == 0) return false;
  model.x0.resize(states_), model.lambda_x.resize(states_), model.u0.resize(actuators_);
  model.y0.resize(sensors_), model.lambda_y.resize(sensors_);
  model.z0.resize(auxiliary_), model.lambda_z.resize(auxiliary_);
  model.A.resize(states_, states_), model.B.resize(states_, actuators_), model.L.resize(states_, health_);
  model.C.resize(sensors_, states_), model.D.resize(sensors_, actuators_), model.M.resize(sensors_, health_);
  model.F.resize(auxiliary_, states_), model.G.resize(auxiliary_, actuators_), model.N.resize(auxiliary_, health_);
  Eigen::Index from = 0;
  each_part(model, [&](auto& part) {
    double* const out = part.data();
    const Eigen::Index size = part.size();
    std::fill(out, out + size, 0.0);
    for (int i = 0; i < count; ++i) {
      const Corner corner = around[as_size(i)];
      const double* const in = numbers_.col(corner.node).data() + from;
      for (Eigen::Index k = 0; k < size; ++k) out[k] += corner.weight * in[k];
    }
    from += size;
  });
  scale(place, model);
  return true;
}

void PointLookup::scale(const Place& place, PointModel& model) const noexcept {
  if (!schedule_.reduced) return;
  const double pace = place.delta / std::sqrt(place.theta);
  for (Eigen::Index i = 0; i < states_; ++i) {
    const double f = factor(schedule_.states[as_size(i)], place);
    model.x0(i) *= f;
    model.A.row(i) *= pace * f, model.B.row(i) *= pace * f, model.L.row(i) *= pace * f;
    model.lambda_x(i) *= pace * f;
    model.A.col(i) /= f, model.C.col(i) /= f, model.F.col(i) /= f;
  }
  for (Eigen::Index i = 0; i < actuators_; ++i) {
    const double f = factor(schedule_.actuators[as_size(i)], place);
    model.u0(i) *= f;
    model.B.col(i) /= f, model.D.col(i) /= f, model.G.col(i) /= f;
  }
  for (Eigen::Index i = 0; i < sensors_; ++i) {
    const double f = factor(schedule_.sensors[as_size(i)], place);
    model.y0(i) *= f, model.lambda_y(i) *= f;
    model.C.row(i) *= f, model.D.row(i) *= f, model.M.row(i) *= f;
  }
  for (Eigen::Index i = 0; i < auxiliary_; ++i) {
    const double f = factor(schedule_.auxiliary[as_size(i)], place);
    model.z0(i) *= f, model.lambda_z(i) *= f;
    model.F.row(i) *= f, model.G.row(i) *= f, model.N.row(i) *= f;
  }
}

double PointLookup::outside(const Place& place) const noexcept {
  double outside = 0.0;
  for (const Axis& axis : schedule_.axes) {
    const std::vector<double>& p = axis.points;
    const double x = coordinate(axis.variable, place);
    if (x < p.front()) outside = std::max(outside, (p.front() - x) / (p[1] - p[0]));
    if (x > p.back()) outside = std::max(outside, (x - p.back()) / (p.back() - p[p.size() - 2]));
    if (!std::isfinite(x)) return std::numeric_limits<double>::infinity();
  }
  return outside;
}

double PointLookup::n1_of_actuator(Eigen::Index u, double value, Place place) const noexcept {
  const Axis* speed = nullptr;
  for (const Axis& axis : schedule_.axes)
    if (axis.variable == Variable::n1_corrected) speed = &axis;
  if (speed == nullptr) return place.n1_corrected_rpm;
  double best = speed->points.back(), before = 0.0, before_n1 = 0.0;
  PointModel model;
  bool first = true;
  for (const double n1 : speed->points) {
    place.n1_corrected_rpm = n1;
    if (!at(place, model)) continue;
    if (model.u0(u) >= value) {
      best = first ? n1 : before_n1 + (n1 - before_n1) * (value - before) / (model.u0(u) - before);
      break;
    }
    before = model.u0(u), before_n1 = n1;
    first = false;
  }
  return best;
}

}  // namespace ehm::schedule
