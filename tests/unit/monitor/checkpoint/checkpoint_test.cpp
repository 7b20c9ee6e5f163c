// SPDX-License-Identifier: Apache-2.0
// A checkpoint's text: exact round trip, and every defect named.

#include "monitor/checkpoint/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "deploy/runtime/files/content_hash.h"
#include "deploy/runtime/files/file_error.h"
#include "tests/unit/monitor/checkpoint/some_checkpoint.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
using nlohmann::json;
using testing::HasSubstr;

std::string message(const std::string& text) {
  try {
    parse_checkpoint(text, "some.json");
  } catch (const files::FileError& e) {
    return e.what();
  }
  return "accepted";
}

std::string with_hash(json j) {
  j.erase("hash");
  j["hash"] = files::sha256_hex(j.dump());
  return j.dump();
}

/// The text with one value changed and a valid hash: what a defect looks like behind the checksum.
std::string changed(const std::string& pointer, const json& value) {
  json j = json::parse(to_text(test::some_checkpoint()));
  j[json::json_pointer(pointer)] = value;
  return with_hash(j);
}

TEST(Checkpoint, RoundTripsToTheBit) {
  const Checkpoint before = test::some_checkpoint();
  const Checkpoint after = parse_checkpoint(to_text(before), "some.json");
  EXPECT_EQ(after.engine_id, before.engine_id);
  EXPECT_EQ(after.design_hash, before.design_hash);
  EXPECT_EQ(after.wall_time_ns, before.wall_time_ns);
  EXPECT_EQ(after.state.source_id, before.state.source_id);
  EXPECT_EQ(after.state.sequence, before.state.sequence);
  EXPECT_EQ(after.state.source_time_ns, before.state.source_time_ns);
  EXPECT_EQ(after.state.watch.missing_sensor, before.state.watch.missing_sensor);
  EXPECT_EQ(after.state.excluded, before.state.excluded);
  EXPECT_EQ(after.state.watch.estimate, before.state.watch.estimate);
  EXPECT_EQ(after.state.watch.error.mean, before.state.watch.error.mean);
  EXPECT_EQ(after.state.watch.error.covariance, before.state.watch.error.covariance);
  EXPECT_EQ(after.state.watch.error.remaining, before.state.watch.error.remaining);
  EXPECT_EQ(after.state.watch.held_samples, before.state.watch.held_samples);
  ASSERT_EQ(after.state.companions.size(), 1u);
  const CompanionState &companion = after.state.companions.front(), &stored = before.state.companions.front();
  EXPECT_EQ(companion.name, "time_varying");
  EXPECT_EQ(companion.state.estimate, stored.state.estimate);
  EXPECT_EQ(companion.state.error.mean.rows(), 4);
  EXPECT_EQ(companion.state.error.mean.cols(), 0);
  EXPECT_EQ(companion.state.error.covariance, stored.state.error.covariance);
  EXPECT_EQ(companion.state.error.remaining, stored.state.error.remaining);
  EXPECT_EQ(after.state.return_gate.age_s, before.state.return_gate.age_s);
  EXPECT_EQ(after.state.bias_return.sensor, before.state.bias_return.sensor);
  EXPECT_EQ(after.state.bias_return.mean, before.state.bias_return.mean);
  EXPECT_EQ(after.state.bias_return.largest, before.state.bias_return.largest);
  EXPECT_EQ(after.state.bias_return.least, before.state.bias_return.least);
}

TEST(Checkpoint, EveryTruncationIsRefused) {
  const std::string text = to_text(test::some_checkpoint());
  for (std::size_t length = 0; length + 2 < text.size(); length += 7)
    EXPECT_NE(message(text.substr(0, length)), "accepted") << length;
}

TEST(Checkpoint, AFlippedDigitIsRefusedByItsHash) {
  std::string text = to_text(test::some_checkpoint());
  const auto at = text.find("\"sequence\":12345");
  ASSERT_NE(at, std::string::npos);
  text[at + 12] = '7';
  EXPECT_THAT(message(text), HasSubstr("some.json: hash"));
}

TEST(Checkpoint, DefectsBehindTheHashAreNamed) {
  EXPECT_EQ(message(changed("/source/sequence", 5)), "accepted");  // changed() itself makes valid texts
  EXPECT_THAT(message(changed("/schema", "ehm-checkpoint/9")),
              HasSubstr("allowed: ehm-checkpoint/3, or one of the versions before it"));
  EXPECT_THAT(message(changed("/engine_id", 0)), HasSubstr("engine_id is 0; allowed: 1 to"));
  EXPECT_THAT(message(changed("/engine_id", -3)), HasSubstr("engine_id is -3"));
  EXPECT_THAT(message(changed("/missing_sensor", 16)), HasSubstr("missing_sensor is 16; allowed: -1 to 15"));
  EXPECT_THAT(message(changed("/missing_sensor", -2)), HasSubstr("missing_sensor is -2"));
  EXPECT_THAT(message(changed("/excluded_sensors", 1 << 16)), HasSubstr("excluded_sensors"));
  EXPECT_THAT(message(changed("/estimate", std::vector<double>(40, 1.0))), HasSubstr("estimate is 40 long"));
  EXPECT_THAT(message(changed("/estimate", json::array())), HasSubstr("estimate is 0 long"));
  EXPECT_THAT(message(changed("/estimate/0", 1e300)), HasSubstr("estimate is 1e+300"));
  EXPECT_THAT(message(changed("/estimate/0", nullptr)), HasSubstr("estimate[0]"));
  EXPECT_THAT(message(changed("/error/covariance/1/1", -1.0)), HasSubstr("error.covariance[1][1] is -1"));
  EXPECT_THAT(message(changed("/error/mean", json::array({1, 2}))), HasSubstr("error.mean"));
  EXPECT_THAT(message(changed("/error/remaining_samples", -1)), HasSubstr("error.remaining_samples"));
  EXPECT_THAT(message(changed("/return_gate/narrow_variance", 0.0)), HasSubstr("return_gate.narrow_variance"));
  EXPECT_THAT(message(changed("/error/covariance/0/1", 0.1)), HasSubstr("error.covariance is 0.1"));
  EXPECT_THAT(message(changed("/held_samples", -1)), HasSubstr("held_samples is -1; allowed: 0 to"));
  EXPECT_THAT(message(changed("/bias_return/sensor", 16)), HasSubstr("bias_return.sensor is 16; allowed: -1 to 15"));
  EXPECT_THAT(message(changed("/bias_return/largest", -1.0)), HasSubstr("bias_return.largest is -1"));
  EXPECT_THAT(message(changed("/surplus", 1)), HasSubstr("surplus"));
}

TEST(Checkpoint, ABrokenPartOfACompanionIsNamed) {
  const std::string own = "companions.time_varying.";
  EXPECT_THAT(message(changed("/companions", 3)), HasSubstr("companions"));
  EXPECT_THAT(message(changed("/companions/kalman", 3)), HasSubstr("companions is \"kalman\"; allowed: estimators"));
  EXPECT_THAT(message(changed("/companions/tuner", 3)), HasSubstr("tuner, gauss_markov, time_varying"));
  EXPECT_THAT(message(changed("/companions/time_varying", nullptr)), HasSubstr("companions.time_varying"));
  EXPECT_THAT(message(changed("/companions/time_varying/estimate/0", "x")), HasSubstr(own + "estimate[0]"));
  EXPECT_THAT(message(changed("/companions/time_varying/estimate", {1.0, 2.0})), HasSubstr(own + "error.mean"));
  EXPECT_THAT(message(changed("/companions/time_varying/missing_sensor", 99)), HasSubstr(own + "missing_sensor is 99"));
  EXPECT_THAT(message(changed("/companions/time_varying/surplus", 1)), HasSubstr(own + "surplus"));
  // variances of 1/7, correlated by more than 1: no covariance, though symmetric
  json j = json::parse(to_text(test::some_checkpoint()));
  json& covariance = j["companions"]["time_varying"]["error"]["covariance"];
  covariance[0][1] = covariance[1][0] = 0.2;
  EXPECT_THAT(message(with_hash(j)), HasSubstr(own + "error.covariance is -0.05"));
}

TEST(Checkpoint, WhatAFlightHasTaughtSoFarIsKeptAndChecked) {
  Checkpoint before = test::some_checkpoint();
  estimation::EstimatorState onboard;
  onboard.learned.value = Eigen::VectorXd::LinSpaced(3, 0.1, -1.0 / 3.0);
  onboard.learned.covariance = Eigen::MatrixXd::Identity(3, 3) / 7.0;
  before.state.companions.push_back({"onboard", onboard});
  const Checkpoint after = parse_checkpoint(to_text(before), "some.json");
  ASSERT_EQ(after.state.companions.size(), 2u);
  const CompanionState& kept =
      after.state.companions.front().name == "onboard" ? after.state.companions.front() : after.state.companions.back();
  EXPECT_EQ(kept.name, "onboard");
  EXPECT_EQ(kept.state.learned.value, onboard.learned.value);
  EXPECT_EQ(kept.state.learned.covariance, onboard.learned.covariance);

  json j = json::parse(to_text(before));
  j["companions"]["onboard"]["learned"]["covariance"][0][0] = -1.0;
  EXPECT_THAT(message(with_hash(j)), HasSubstr("companions.onboard.learned.covariance[0][0] is -1"));
  j["companions"]["onboard"]["learned"]["value"] = std::vector<double>(33, 1.0);
  EXPECT_THAT(message(with_hash(j)), HasSubstr("companions.onboard.learned.value is 33 long; allowed: 1 to 32"));
  j["companions"]["onboard"]["learned"] = 3;
  EXPECT_THAT(message(with_hash(j)), HasSubstr("companions.onboard.learned"));
}

TEST(Checkpoint, WhatAConstraintHoldsIsKeptBesideTheStateAndChecked) {
  Checkpoint before = test::some_checkpoint();
  estimation::EstimatorState state = before.state.companions.front().state;
  EXPECT_EQ(to_text(before).find("constrained"), std::string::npos);
  state.constrained = {Eigen::VectorXd::LinSpaced(3, -0.01, 0.02), Eigen::VectorXd::LinSpaced(3, -1.0 / 3.0, 0.1),
                       Eigen::VectorXd::Constant(3, 0.9)};
  before.state.companions.front() = {"constrained", state};
  const Checkpoint after = parse_checkpoint(to_text(before), "some.json");
  const estimation::ConstrainedState& kept = after.state.companions.front().state.constrained;
  EXPECT_EQ(after.state.companions.front().name, "constrained");
  EXPECT_EQ(kept.bound, state.constrained.bound);
  EXPECT_EQ(kept.health, state.constrained.health);
  EXPECT_EQ(kept.sigma_share, state.constrained.sigma_share);

  json j = json::parse(to_text(before));
  j["companions"]["constrained"]["constrained"]["health"] = {1.0, 2.0};
  EXPECT_THAT(message(with_hash(j)), HasSubstr("companions.constrained.constrained.health"));
  j = json::parse(to_text(before));
  j["companions"]["constrained"]["constrained"]["surplus"] = 1;
  EXPECT_THAT(message(with_hash(j)), HasSubstr("companions.constrained.constrained.surplus"));
  j["companions"]["constrained"]["constrained"] = 3;
  EXPECT_THAT(message(with_hash(j)), HasSubstr("companions.constrained.constrained"));
}

TEST(Checkpoint, OneOfTheVersionBeforeIsReadWithItsCompanions) {
  json j = json::parse(to_text(test::some_checkpoint()));
  j["schema"] = "ehm-checkpoint/2";
  EXPECT_EQ(parse_checkpoint(with_hash(j), "some.json").state.companions.size(), 1u);
}

TEST(Checkpoint, OneOfAnEarlierVersionIsReadWithoutCompanions) {
  json j = json::parse(to_text(test::some_checkpoint()));
  j["schema"] = "ehm-checkpoint/1";
  EXPECT_THAT(message(with_hash(j)), HasSubstr("companions"));  // that version had none
  j.erase("companions");
  j.erase("held_samples");
  j.erase("bias_return");
  const Checkpoint before = test::some_checkpoint(), after = parse_checkpoint(with_hash(j), "some.json");
  EXPECT_EQ(after.state.watch.estimate, before.state.watch.estimate);
  EXPECT_EQ(after.state.watch.error.covariance, before.state.watch.error.covariance);
  EXPECT_EQ(after.state.watch.held_samples, 0);
  EXPECT_TRUE(after.state.companions.empty());
}

}  // namespace
