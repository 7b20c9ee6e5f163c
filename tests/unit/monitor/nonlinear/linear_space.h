// SPDX-License-Identifier: Apache-2.0
#pragma once
// A linear model as a state space, and a flight of it: where every nonlinear filter must give what the Kalman filter
// gives, since nothing is lost by its way of propagating.

#include <Eigen/Dense>
#include <cstdint>

#include "deploy/runtime/numbers/noise_source.h"
#include "monitor/nonlinear/nonlinear_filter.h"

namespace ehm::nonlinear::test {

class LinearSpace final : public StateSpace {
 public:
  LinearSpace(Eigen::MatrixXd a, Eigen::MatrixXd c) : a_(std::move(a)), c_(std::move(c)) {}
  [[nodiscard]] Eigen::Index order() const noexcept override { return a_.rows(); }
  [[nodiscard]] Eigen::Index sensor_count() const noexcept override { return c_.rows(); }
  bool respond(const OrderVector& x, Response& response) noexcept override {
    if (silent) return false;
    response.next = a_ * x;
    response.readings = c_ * x;
    return true;
  }
  bool respond(const OrderVector& x, Response& response, Slopes& slopes) noexcept override {
    if (!respond(x, response)) return false;
    slopes.f = a_;
    slopes.g = c_;
    return true;
  }
  const Eigen::MatrixXd& a() const { return a_; }
  const Eigen::MatrixXd& c() const { return c_; }

  bool silent = false;  ///< it has no answer

 private:
  Eigen::MatrixXd a_, c_;
};

/// 4 states, stable but for two that walk, 3 sensors.
inline LinearSpace some_space() {
  Eigen::Matrix4d a;
  a << 0.9, 0.05, 0.1, 0.0, -0.05, 0.85, 0.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  Eigen::MatrixXd c(3, 4);
  c << 1.0, 0.0, 0.3, 0.0, 0.0, 1.0, 0.0, -0.2, 0.5, 0.5, 1.0, 1.0;
  return {a, c};
}

inline const FilterNoise& some_noise() {
  static const FilterNoise noise{(OrderVector(4) << 0.2, 0.2, 0.1, 0.1).finished()};
  return noise;
}

inline SensorVector some_sigma() {
  return (SensorVector(3) << 0.5, 0.6, 0.5).finished();
}

inline OrderMatrix some_prior() {
  return (OrderVector(4) << 1.0, 1.0, 0.5, 0.5).finished().asDiagonal();
}

/// The Kalman filter in its textbook form (Simon, Optimal State Estimation, 5.17 to 5.19), which is not ours.
struct TextbookKalman {
  explicit TextbookKalman(const LinearSpace& space) : a(space.a()), c(space.c()) {}
  Eigen::MatrixXd a, c;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  Eigen::MatrixXd p = some_prior();

  void update(const SensorVector& y, SensorMask fused) {
    Eigen::MatrixXd r = some_sigma().cwiseAbs2().asDiagonal();
    for (Eigen::Index i = 0; i < 3; ++i)
      if (!fused[static_cast<std::size_t>(i)]) r(i, i) = 1e12;  // as good as not measured
    const Eigen::MatrixXd k = p * c.transpose() * (c * p * c.transpose() + r).inverse();
    x += k * (y - c * x);
    p = (Eigen::MatrixXd::Identity(4, 4) - k * c) * p;
  }
  void advance() {
    x = a * x;
    p = a * p * a.transpose();
    p.diagonal() += some_noise().process_variance;
  }
};

/// A truth of that model.
class Flight {
 public:
  Flight(const LinearSpace& space, std::uint64_t seed) : space_(space), random_(seed) {
    const Eigen::MatrixXd root = some_prior().llt().matrixL();
    x_ = root * normal(4);
  }
  SensorVector measured() { return space_.c() * x_ + some_sigma().cwiseProduct(normal(3)); }
  void advance() {
    x_ = space_.a() * x_ + Eigen::VectorXd(some_noise().process_variance.cwiseSqrt().cwiseProduct(normal(4)));
  }
  const Eigen::VectorXd& x() const { return x_; }

 private:
  Eigen::VectorXd normal(Eigen::Index n) {
    Eigen::VectorXd z(n);
    for (double& value : z) value = random_.normal();
    return z;
  }
  const LinearSpace& space_;
  NoiseSource random_;
  Eigen::VectorXd x_;
};

}  // namespace ehm::nonlinear::test
