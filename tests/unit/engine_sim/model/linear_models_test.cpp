// SPDX-License-Identifier: Apache-2.0
// Slopes of the engine against linear models made by central differences of T-MATS' own components on the same tables:
// what of them stands in the repository (fixtures/jt9d_linear_points.json), and all of it where the reference data are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine_sim/engines/jt9d.h"
#include "engine_sim/model/solve/steady.h"
#include "engine_sim/model/units.h"
#include "reference_cases.h"

namespace ehm::engine_sim {
namespace {

// Nf Nc P24 T24 P30 T30 T48 T40 T50 Fn SmLPC
constexpr std::size_t output_count = 11;
using Outputs = std::array<double, output_count>;

Outputs outputs(const GasPath& g) {
  return {g.speeds.n1_rpm,
          g.speeds.n2_rpm,
          g.s24.pt_pa,
          g.s24.tt_k,
          g.s30.pt_pa,
          g.s30.tt_k,
          g.s48.tt_k,
          g.s40.tt_k,
          g.s50.tt_k,
          g.net_thrust_n,
          g.stall_margin_lpc_percent};
}

/// Percent of the unworn value; the stall margin in points.
Outputs change(const Outputs& from, const Outputs& to) {
  Outputs d;
  for (std::size_t i = 0; i < output_count; ++i) d[i] = 100.0 * (to[i] / from[i] - 1.0);
  d[10] = to[10] - from[10];
  return d;
}

struct Point {
  const char* name;
  FlightCondition flight;
};
constexpr Point points[] = {{"alt35000_MN0.8_PC100", {10668.0, 0.8, 0.0}},
                            {"alt35000_MN0.8_PC80", {10668.0, 0.8, 0.0}},
                            {"alt0_MN0_PC100", {0.0, 0.0, 15.0}}};

class LinearModels : public testing::TestWithParam<Point> {
 protected:
  void SetUp() override {
    model_ = point_of(reference::fixture("jt9d_linear_points.json"));
    if (!model_.contains(influence_key) && reference::available())
      model_[influence_key] = point_of(reference::path("jt9d_linear_models.json")).at(influence_key);
    fuel_flow_kg_s_ = model_.at("trim").at("Wf").get<double>() * kg_per_lbm;
    trim_ = solve({}, nullptr);
  }
  static nlohmann::json point_of(const std::string& file) {
    std::ifstream in(file);
    return nlohmann::json::parse(in).at("models").at(GetParam().name);
  }
  SteadyPoint solve(const HealthVector& health, const SteadyPoint* start) const {
    return solve_steady(engine_, GetParam().flight, health, {DemandKind::fuel_flow_kg_s, fuel_flow_kg_s_}, start);
  }
  /// Change of the outputs with one health parameter, fuel flow held.
  Outputs influence(std::size_t parameter, double h) const {
    HealthVector health{};
    health[parameter] = h;
    return change(outputs(trim_.gas), outputs(solve(health, &trim_).gas));
  }

  static constexpr const char* influence_key = "icm_minus2pct_fixedWf_percent";
  Turbofan engine_{jt9d()};
  nlohmann::json model_;
  double fuel_flow_kg_s_ = 0.0;
  SteadyPoint trim_{};
};

TEST_P(LinearModels, InfluenceCoefficientsAtMinusTwoPercent) {
  if (!model_.contains(influence_key)) GTEST_SKIP() << reference::absent;
  const auto& expected = model_.at(influence_key);
  double sum = 0.0, worst = 0.0;
  for (std::size_t k = 0; k < health_count; ++k) {
    const Outputs d = influence(k, -0.02);
    for (std::size_t i = 0; i < output_count; ++i) {
      const double reference = expected.at(k).at(i), deviation = d[i] - reference;
      sum += deviation * deviation;
      worst = std::max(worst, std::abs(deviation));
      if (std::abs(reference) > 0.2) {
        EXPECT_GT(d[i] * reference, 0.0) << health_names[k] << " on output " << i;
      }
    }
  }
  const double rms = std::sqrt(sum / static_cast<double>(health_count * output_count));
  std::printf("%s: influence of -2 %%: rms %.3f, worst %.3f percent absolute\n", GetParam().name, rms, worst);
  EXPECT_LT(rms, 0.2);
}

TEST_P(LinearModels, SlopesPredictTheChangeAtMinusTwoPercent) {
  Outputs largest{}, miss{};
  for (std::size_t k = 0; k < health_count; ++k) {
    const Outputs far = influence(k, -0.02), below = influence(k, -0.001), above = influence(k, 0.001);
    for (std::size_t i = 0; i < output_count; ++i) {
      largest[i] = std::max(largest[i], std::abs(far[i]));
      miss[i] = std::max(miss[i], std::abs(10.0 * (below[i] - above[i]) - far[i]));
    }
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < output_count; ++i) worst = std::max(worst, miss[i] / largest[i]);
  std::printf("%s: slopes at 0.1 %% miss the change at -2 %% by %.1f %% of the largest entry\n", GetParam().name,
              100.0 * worst);
  EXPECT_LT(worst, 0.10);  // bilinear maps: 0.46
}

TEST_P(LinearModels, EigenvaluesAgreeWithTheReference) {
  const auto rates = [&](double n1, double n2) {
    FlowUnknowns unknowns = trim_.unknowns;
    const GasPath g = engine_.gas_path(trim_.operation, {n1, n2}, unknowns);
    return std::array{g.n1_dot_rpm_s, g.n2_dot_rpm_s};
  };
  const auto [n1, n2] = trim_.gas.speeds;
  const auto east = rates(n1 + 1.0, n2), west = rates(n1 - 1.0, n2), north = rates(n1, n2 + 1.0),
             south = rates(n1, n2 - 1.0);
  const double a11 = 0.5 * (east[0] - west[0]), a21 = 0.5 * (east[1] - west[1]);
  const double a12 = 0.5 * (north[0] - south[0]), a22 = 0.5 * (north[1] - south[1]);
  const double half_trace = 0.5 * (a11 + a22);
  const std::complex<double> root = std::sqrt(std::complex<double>(half_trace * half_trace - (a11 * a22 - a12 * a21)));
  const std::complex<double> slow = half_trace + root, fast = half_trace - root;
  std::printf("%s: eigenvalues %.3f%+.3fi, %.3f%+.3fi; reference %s\n", GetParam().name, slow.real(), slow.imag(),
              fast.real(), fast.imag(), model_.at("eig").dump().c_str());
  const double slow_reference = model_.at("eig").at(0), fast_reference = model_.at("eig").at(1);
  EXPECT_NEAR(slow.imag(), 0.0, 1e-9);
  EXPECT_NEAR(slow.real(), slow_reference, 0.15 * std::abs(slow_reference));
  EXPECT_NEAR(fast.real(), fast_reference, 0.15 * std::abs(fast_reference));
}

INSTANTIATE_TEST_SUITE_P(Points, LinearModels, testing::ValuesIn(points), [](const auto& point) {
  std::string name = point.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

}  // namespace
}  // namespace ehm::engine_sim
