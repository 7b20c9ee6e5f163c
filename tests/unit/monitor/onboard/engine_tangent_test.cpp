// SPDX-License-Identifier: Apache-2.0
// Every column of the on-board tangent against differences of the engine itself, built and misread as each cause says.

#include "monitor/onboard/engine_tangent.h"

#include <gtest/gtest.h>

#include "engine_sim/model/solve/flow_balance.h"
#include "tests/unit/monitor/onboard/on_board_point.h"

namespace ehm::onboard {
namespace {

namespace sim = engine_sim;
using test::OnBoardPoint;

/// What an engine answers on its own.
sim::GasPath answer_of(const sim::Turbofan& engine, const sim::Operation& operation, const EngineMotion& motion) {
  sim::FlowUnknowns unknowns = engine.data().design.unknowns;
  return engine.gas_path(operation, motion.speeds, unknowns, &motion.metal_k);
}

/// Slopes by a central difference: y(+) - y(-) over 2, of percent of readings and of rates.
struct Slopes {
  Eigen::VectorXd rates, readings;
};
Slopes difference(const OnBoardPoint& p, const sim::GasPath& up, const sim::GasPath& down, double by) {
  const auto y = p.tangent.readings_of(p.tangent.gas());
  return {(p.tangent.rates_of(up) - p.tangent.rates_of(down)) / by,
          100.0 * (p.tangent.readings_of(up) - p.tangent.readings_of(down)).cwiseQuotient(y) / by};
}
void expect_column(const OnBoardPoint& p, Eigen::Index column, const Slopes& expected, double tolerance,
                   const std::string& what) {
  const double rate_size = std::max(0.01, expected.rates.cwiseAbs().maxCoeff());
  EXPECT_LT((p.tangent.rates().col(column) - expected.rates).cwiseAbs().maxCoeff(), tolerance * rate_size) << what;
  const double size = std::max(1e-3, expected.readings.cwiseAbs().maxCoeff());
  EXPECT_LT((p.tangent.readings().col(column) - expected.readings).cwiseAbs().maxCoeff(), tolerance * size) << what;
}

TEST(EngineTangent, SpeedsAndHealthAreTheDerivatives) {
  const OnBoardPoint p = test::on_board_cruise();
  const UnknownLayout layout(*p.model);
  const auto& engine = p.model->engine();
  for (int k = 0; k < 2; ++k) {
    EngineMotion up = p.motion, down = p.motion;
    const sim::SpoolSpeeds& design = engine.data().design.speeds;
    (k == 0 ? up.speeds.n1_rpm : up.speeds.n2_rpm) += 1e-4 * (k == 0 ? design.n1_rpm : design.n2_rpm);
    (k == 0 ? down.speeds.n1_rpm : down.speeds.n2_rpm) -= 1e-4 * (k == 0 ? design.n1_rpm : design.n2_rpm);
    expect_column(p, k, difference(p, answer_of(engine, p.operation, up), answer_of(engine, p.operation, down), 0.02),
                  1e-4, "speed");
  }
  for (Eigen::Index j = 0; j < layout.health_count; ++j) {
    sim::Operation up = p.operation, down = p.operation;
    up.health[as_size(j)] += 1e-4;
    down.health[as_size(j)] -= 1e-4;
    expect_column(p, 2 + j, difference(p, answer_of(engine, up, p.motion), answer_of(engine, down, p.motion), 0.02),
                  1e-4, std::string(sim::health_names[as_size(j)]));
  }
}

TEST(EngineTangent, CausesAreWhatABuiltOrMisreadEngineDoes) {
  const OnBoardPoint p = test::on_board_cruise();
  const UnknownLayout layout(*p.model);
  for (Eigen::Index i = 0; i < layout.cause_count; ++i) {
    const OnBoardCause& cause = p.model->causes()[as_size(i)];
    const std::string name(sim::mismatch_causes()[cause.index].name);
    sim::Mismatch up{}, down{};
    up[cause.index] = 0.5 * cause.sigma;
    down[cause.index] = -0.5 * cause.sigma;
    Slopes expected;
    if (cause.kind == CauseKind::input) {
      // The same report with a positive error: the truth is lower.
      const auto truth = [&](const sim::Mismatch& error) {
        sim::Operation o = p.operation;
        const sim::ReportedInputs said = sim::misread({o.flight, o.fuel_flow_kg_s}, error);
        o.flight = said.flight;
        o.fuel_flow_kg_s = said.fuel_flow_kg_s;
        return answer_of(p.model->engine(), o, p.motion);
      };
      expected = difference(p, truth(down), truth(up), 1.0);
    } else if (cause.kind == CauseKind::capacity) {
      expected = {Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(layout.sensor_count)};  // at first: it acts with time
    } else {
      const auto engine = [&](const sim::Mismatch& m) {
        return answer_of(sim::Turbofan(sim::built(p.model->engine().data(), m)), p.operation, p.motion);
      };
      expected = difference(p, engine(up), engine(down), 1.0);
    }
    // one-sided at one sigma, and the metal to first order: curvature over sigma is some percent
    expect_column(p, layout.first_cause() + i, expected, cause.kind == CauseKind::conductance ? 0.15 : 0.06, name);
  }
}

TEST(EngineTangent, TheMetalsMemoryOfAWrongCapacityIsThatOfAMetalThatIsSo) {
  // Two metals run beside ours for a minute of an engine out of balance, with 1 % more and less capacity.
  OnBoardPoint p = test::on_board_cruise();
  const auto& options = p.model->options();
  EngineMotion more = p.motion, less = p.motion;
  more.capacity = 1.01;
  less.capacity = 0.99;
  EngineTangent of_more(p.model), of_less(p.model);
  for (int k = 0; k < 1000; ++k) {
    ASSERT_TRUE(p.tangent.answer(p.operation, p.motion));
    ASSERT_TRUE(of_more.answer(p.operation, more));
    ASSERT_TRUE(of_less.answer(p.operation, less));
    p.tangent.advance_metal(options.sample_time_s, p.motion);
    of_more.advance_metal(options.sample_time_s, more);
    of_less.advance_metal(options.sample_time_s, less);
  }
  ASSERT_TRUE(p.tangent.answer(p.operation, p.motion));
  const UnknownLayout layout(*p.model);
  for (Eigen::Index i = 0; i < layout.cause_count; ++i) {
    const OnBoardCause& cause = p.model->causes()[as_size(i)];
    if (cause.kind != CauseKind::capacity) continue;
    const auto y = p.tangent.readings_of(p.tangent.gas());
    const Eigen::VectorXd expected = cause.sigma / 0.02 * 100.0 *
                                     (p.tangent.readings_of(answer_of(p.model->engine(), p.operation, more)) -
                                      p.tangent.readings_of(answer_of(p.model->engine(), p.operation, less)))
                                         .cwiseQuotient(y);
    const Eigen::VectorXd column = p.tangent.readings().col(layout.first_cause() + i);
    EXPECT_GT(expected.cwiseAbs().maxCoeff(), 0.01);
    EXPECT_LT((column - expected).cwiseAbs().maxCoeff(), 0.05 * expected.cwiseAbs().maxCoeff());
  }
}

TEST(EngineTangent, WhereTheEngineHasNoAnswerTheLastOneStands) {
  OnBoardPoint p = test::on_board_cruise();
  const double t48_k = p.tangent.gas().s48.tt_k;
  sim::Operation flooded = p.operation;
  flooded.fuel_flow_kg_s *= 50.0;
  EXPECT_FALSE(p.tangent.answer(flooded, p.motion));
  EXPECT_EQ(p.tangent.gas().s48.tt_k, t48_k);
  EXPECT_TRUE(p.tangent.answer(p.operation, p.motion));
}

}  // namespace
}  // namespace ehm::onboard
