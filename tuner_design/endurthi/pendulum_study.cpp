// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/pendulum_study.h"

#include <cmath>
#include <functional>
#include <memory>

#include "monitor/nonlinear/extended_filter.h"
#include "monitor/nonlinear/unscented_filter.h"
#include "tuner_design/endurthi/pendulum_space.h"
#include "tuner_design/monte_carlo/random_stream.h"

namespace ehm::tuner_design::endurthi {
namespace {

using namespace nonlinear;

constexpr double cart_kg = 1.0, bob_kg = 0.2, length_m = 1.0, radius_m = 0.02, friction_n_s_m = 0.1, gravity = 9.81;
constexpr double position_noise_m = 0.01, rate_noise = 1e-3, start_sigma = 0.05, start_angle_rad = 0.1, flown_s = 3.0;

/// The two equations of motion as [a b; b d] [y'' th''] = [r1 r2], and their derivatives by th.
struct Motion {
  double a, b, d, r1, r2, determinant, y2, th2;
  explicit Motion(const Eigen::Vector4d& x)
      : a(cart_kg + bob_kg),
        b(bob_kg * length_m * std::cos(x(1))),
        d(bob_kg * (0.5 * radius_m * radius_m + length_m * length_m)),
        r1(-friction_n_s_m * x(2) + bob_kg * length_m * std::sin(x(1)) * x(3) * x(3)),
        r2(bob_kg * gravity * length_m * std::sin(x(1))),
        determinant(a * d - b * b),
        y2((d * r1 - b * r2) / determinant),
        th2((a * r2 - b * r1) / determinant) {}
};

}  // namespace

Eigen::Vector4d PendulumSpace::rates(const Eigen::Vector4d& x) {
  const Motion m(x);
  return {x(2), x(3), m.y2, m.th2};
}

Eigen::Matrix4d PendulumSpace::rate_slopes(const Eigen::Vector4d& x) {
  const Motion m(x);
  const double s = bob_kg * length_m * std::sin(x(1)), b_th = -s, det_th = 2.0 * m.b * s;
  const double r1_th = m.b * x(3) * x(3), r2_th = gravity * m.b, r1_om = 2.0 * s * x(3);
  Eigen::Matrix4d slopes = Eigen::Matrix4d::Zero();
  slopes(0, 2) = slopes(1, 3) = 1.0;
  slopes(2, 1) = (m.d * r1_th - b_th * m.r2 - m.b * r2_th - m.y2 * det_th) / m.determinant;
  slopes(3, 1) = (m.a * r2_th - b_th * m.r1 - m.b * r1_th - m.th2 * det_th) / m.determinant;
  slopes(2, 2) = -m.d * friction_n_s_m / m.determinant;
  slopes(3, 2) = m.b * friction_n_s_m / m.determinant;
  slopes(2, 3) = m.d * r1_om / m.determinant;
  slopes(3, 3) = -m.b * r1_om / m.determinant;
  return slopes;
}

bool PendulumSpace::respond(const OrderVector& x, Response& response) noexcept {
  Slopes ignored;
  return respond(x, response, ignored);
}

bool PendulumSpace::respond(const OrderVector& at, Response& response, Slopes& slopes) noexcept {
  constexpr double dt = pendulum_step_s;
  const Eigen::Vector4d x = at;
  // x and Phi = dx/dx0 together, stage by stage
  const Eigen::Matrix4d one = Eigen::Matrix4d::Identity();
  const Eigen::Vector4d k1 = rates(x);
  const Eigen::Matrix4d p1 = rate_slopes(x);
  const Eigen::Vector4d x2 = x + 0.5 * dt * k1, k2 = rates(x2);
  const Eigen::Matrix4d p2 = rate_slopes(x2) * (one + 0.5 * dt * p1);
  const Eigen::Vector4d x3 = x + 0.5 * dt * k2, k3 = rates(x3);
  const Eigen::Matrix4d p3 = rate_slopes(x3) * (one + 0.5 * dt * p2);
  const Eigen::Vector4d x4 = x + dt * k3, k4 = rates(x4);
  const Eigen::Matrix4d p4 = rate_slopes(x4) * (one + dt * p3);
  response.next = x + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  response.readings = x.head<1>();
  if (upright_) {
    slopes.f = one + dt * rate_slopes(Eigen::Vector4d::Zero());
  } else {
    slopes.f = one + dt / 6.0 * (p1 + 2.0 * p2 + 2.0 * p3 + p4);
  }
  slopes.g.setZero(1, 4);
  slopes.g(0, 0) = 1.0;
  return true;
}

namespace {

struct Contender {
  std::string name;
  bool upright;
  std::function<std::unique_ptr<NonlinearFilter>(const FilterNoise&)> make;
};

std::vector<Contender> contenders() {
  const auto extended = [](const FilterNoise& noise) {
    return std::make_unique<ExtendedFilter>(noise, ExtendedOptions{});
  };
  const auto unscented = [](double beta) {
    return [beta](const FilterNoise& noise) {
      UnscentedOptions options;
      options.points.beta = beta;
      return std::make_unique<UnscentedFilter>(noise, options);
    };
  };
  return {{"ekf, upright", true, extended},
          {"ekf", false, extended},
          {"ukf, beta 2", false, unscented(2.0)},
          {"ukf, beta 0", false, unscented(0.0)}};
}

/// Adds the squared errors of one run.
void fly(const Contender& contender, const FilterNoise& noise, std::uint64_t seed, std::size_t run,
         PendulumFilter& sums) {
  PendulumSpace truth, model(contender.upright);
  RandomStream random(seed, run);
  OrderVector x = (OrderVector(4) << 0.0, start_angle_rad, 0.0, 0.0).finished(), guess = x;
  for (double& value : guess) value += start_sigma * random.normal();
  const auto filter = contender.make(noise);
  filter->start(guess, OrderMatrix(start_sigma * start_sigma * OrderMatrix::Identity(4, 4)));
  const SensorVector sigma = SensorVector::Constant(1, position_noise_m);
  Response moved;
  for (double t = 0.0; t < flown_s; t += pendulum_step_s) {
    const SensorVector y = SensorVector::Constant(1, x(0) + position_noise_m * random.normal());
    if (filter->foresee(model, sigma)) filter->update(model, y - filter->predicted(), SensorMask(1));
    const OrderVector error = filter->estimate() - x;
    (t < pendulum_split_s ? sums.angle_before_rad : sums.angle_after_rad) += error(1) * error(1);
    (t < pendulum_split_s ? sums.position_before_m : sums.position_after_m) += error(0) * error(0);
    filter->advance(model);
    truth.respond(x, moved);
    x = moved.next;
    x(2) += rate_noise * random.normal();
    x(3) += rate_noise * random.normal();
  }
}

}  // namespace

std::vector<PendulumFilter> run_pendulum_study(const PendulumOptions& options) {
  const double q = rate_noise * rate_noise;
  const FilterNoise noise{(OrderVector(4) << 1e-12, 1e-12, q, q).finished()};
  const double judged = static_cast<double>(options.runs) * pendulum_split_s / pendulum_step_s;
  std::vector<PendulumFilter> out;
  for (const Contender& contender : contenders()) {
    PendulumFilter sums{.name = contender.name};
    for (std::size_t run = 0; run < options.runs; ++run) fly(contender, noise, options.seed, run, sums);
    for (double* sum : {&sums.angle_before_rad, &sums.angle_after_rad, &sums.position_before_m, &sums.position_after_m})
      *sum = std::sqrt(*sum / judged);
    out.push_back(sums);
  }
  return out;
}

}  // namespace ehm::tuner_design::endurthi
