// SPDX-License-Identifier: Apache-2.0
// Linear models of engines whose files name other channels than the default one's.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/engine_file.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/engines/shipped_engines.h"
#include "engine_sim/linear_model/model_check.h"
#include "tuner_design/linearise/engine_match.h"
#include "tuner_design/linearise/linearise.h"

namespace ehm::tuner_design {
namespace {

using engine_sim::EngineDefinition;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

LineariseOptions cruise(double t40_k) {
  LineariseOptions options;
  options.flight = {10668.0, 0.8, 0.0};
  options.demand = {engine_sim::DemandKind::t40_k, t40_k};
  options.fleet = 0;
  return options;
}

std::vector<std::string> names(const std::vector<linear_model::Channel>& channels) {
  std::vector<std::string> list;
  for (const auto& channel : channels) list.push_back(channel.name);
  return list;
}

TEST(EngineChannels, AModelHasTheChannelsOfItsEngine) {
  const auto engine = engine_sim::named_engine("high_bypass");
  const linear_model::LinearModel model = linearise(engine, cruise(1500.0)).model;
  EXPECT_NO_THROW(linear_model::check_model(model, "high bypass"));
  EXPECT_EQ(model.engine_type, "high-bypass-turbofan");
  EXPECT_EQ(model.engine_hash, engine_sim::engine_hash(*engine));
  EXPECT_THAT(names(model.sensors), testing::ElementsAre("Nf", "Nc", "P13", "P24", "T24", "Ps30", "T30", "T48"));
  EXPECT_THAT(names(model.auxiliary), testing::ElementsAre("T40", "T50", "Fn", "SmHPC", "EGTM"));
  // the EGT margin is the rating less T48: its slopes are those of T48, turned round
  EXPECT_NEAR((model.F.row(4) + model.C.row(7)).norm(), 0.0, 1e-6 * model.C.row(7).norm());
  EXPECT_NEAR((model.N.row(4) + model.M.row(7)).norm(), 0.0, 1e-6 * model.M.row(7).norm());
  EXPECT_LT(model.A.eigenvalues().real().maxCoeff(), 0.0);
}

/// Rows or columns of the JT9D's matrices where the other engine has them.
const std::vector<Eigen::Index> sensors{6, 0, 4}, outputs{2, 0}, controls{2, 0}, healths{5, 7, 1};

std::shared_ptr<const EngineDefinition> rearranged() {
  auto engine = std::make_shared<EngineDefinition>(engine_sim::jt9d_engine());
  auto& channels = engine->channels;
  const engine_sim::NamedChannels all = channels;
  channels = {};
  for (const auto i : sensors) channels.sensors.push_back(all.sensors[as_size(i)]);
  for (const auto i : outputs) channels.auxiliary.push_back(all.auxiliary[as_size(i)]);
  for (const auto i : controls) channels.controls.push_back(all.controls[as_size(i)]);
  for (const auto i : healths) channels.health.push_back(all.health[as_size(i)]);
  return engine;
}

// The order is the file's and changes nothing else: also where the balance of the fit looks for the fuel flow.
TEST(EngineChannels, AnotherOrderGivesTheSameNumbersElsewhere) {
  const LineariseOptions options = cruise(1308.6);
  const linear_model::LinearModel a = linearise(engine_sim::default_engine(), options).model;
  const linear_model::LinearModel b = linearise(rearranged(), options).model;
  EXPECT_LT((b.A - a.A).norm(), 1e-6 * a.A.norm());
  EXPECT_LT((b.B - a.B(Eigen::all, controls)).norm(), 1e-6 * a.B.norm());
  EXPECT_LT((b.L - a.L(Eigen::all, healths)).norm(), 1e-6 * a.L.norm());
  EXPECT_LT((b.D - a.D(sensors, controls)).norm(), 1e-6 * a.D.norm());
  EXPECT_LT((b.M - a.M(sensors, healths)).norm(), 1e-6 * a.M.norm());
  EXPECT_LT((b.N - a.N(outputs, healths)).norm(), 1e-6 * a.N.norm());
  EXPECT_EQ(b.sensors[0].trim, a.sensors[6].trim);
}

TEST(EngineChannels, TheFleetFitFindsTheFuelFlowWhereverItStands) {
  LineariseOptions options = cruise(1308.6);
  options.method = LineariseMethod::fleet;
  options.fleet = 60;
  const auto engine = rearranged();
  const linear_model::LinearModel model = linearise(engine, options).model;
  EXPECT_NO_THROW(linear_model::check_model(model, "fleet"));
  EXPECT_THAT(names(model.controls), testing::ElementsAre("VBV", "fuel_flow"));
  const double cruise_fuel_kg_s = 0.816;  // of the new engine at this point; the fit moves it by some percent at most
  EXPECT_NEAR(model.controls[1].trim, cruise_fuel_kg_s, 0.05 * cruise_fuel_kg_s);
  EXPECT_EQ(model.controls[0].trim, 0.0);  // the valves do not take part
}

TEST(EngineChannels, ResolutionAndLagOfTheFileAreTheModels) {
  auto engine = std::make_shared<EngineDefinition>(engine_sim::jt9d_engine());
  engine->channels.sensors[6].resolution = 2.0;
  engine->channels.sensors[5].lag_s = 0.7;
  const linear_model::LinearModel plain = linearise(engine_sim::default_engine(), cruise(1308.6)).model;
  const linear_model::LinearModel model = linearise(engine, cruise(1308.6)).model;
  EXPECT_EQ(model.sensor_resolution(6), 2.0);
  EXPECT_NEAR(model.sensor_noise_sigma(6), std::hypot(plain.sensor_noise_sigma(6), 2.0 / std::sqrt(12.0)), 1e-12);
  EXPECT_EQ(model.states.back().name, "T30_sensor");
  EXPECT_DOUBLE_EQ(model.A(2, 2), -1.0 / 0.7);
  LineariseOptions without = cruise(1308.6);
  without.sensors.lag_temperature_s = 0.0;
  EXPECT_EQ(linearise(engine, without).model.states.size(), 2u);
}

TEST(EngineMatch, ADesignFliesOnItsOwnEngineOnly) {
  const EngineDefinition& jt9d = engine_sim::jt9d_engine();
  linear_model::LinearModel model;
  model.engine_type = "jt9d";
  model.engine_hash = engine_sim::engine_hash(jt9d);
  model.operating_point = {10668.0, 0.8, 0.0};
  EXPECT_NO_THROW(require_engine(model, jt9d, "study"));
  const auto high_bypass = engine_sim::named_engine("high_bypass");
  EXPECT_THAT(
      [&] { require_engine(model, *high_bypass, "study"); },
      ThrowsMessage<std::invalid_argument>(
          AllOf(HasSubstr("study: the design is for the engine 'jt9d' (hash " + model.engine_hash.substr(0, 12) + ")"),
                HasSubstr("'high-bypass-turbofan' (hash " + engine_sim::engine_hash(*high_bypass).substr(0, 12)))));
  EngineDefinition changed = jt9d;
  changed.data.lp_inertia_kg_m2 *= 1.001;
  EXPECT_THROW(require_engine(model, changed, "study"), std::invalid_argument);
  model.engine_hash.clear();  // of before there were engine files
  EXPECT_NO_THROW(require_engine(model, changed, "study"));
  model.operating_point.reset();
  EXPECT_THROW(require_engine(model, jt9d, "study"), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::tuner_design
