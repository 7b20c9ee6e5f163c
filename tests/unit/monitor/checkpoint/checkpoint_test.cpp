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

/// The text with one value changed and a valid hash: what a defect looks like behind the checksum.
std::string changed(const std::string& pointer, const json& value) {
  json j = json::parse(to_text(test::some_checkpoint()));
  j[json::json_pointer(pointer)] = value;
  j.erase("hash");
  j["hash"] = files::sha256_hex(j.dump());
  return j.dump();
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
  EXPECT_EQ(after.state.missing_sensor, before.state.missing_sensor);
  EXPECT_EQ(after.state.excluded, before.state.excluded);
  EXPECT_EQ(after.state.estimate, before.state.estimate);
  EXPECT_EQ(after.state.error.mean, before.state.error.mean);
  EXPECT_EQ(after.state.error.covariance, before.state.error.covariance);
  EXPECT_EQ(after.state.error.remaining, before.state.error.remaining);
  EXPECT_EQ(after.state.return_gate.age_s, before.state.return_gate.age_s);
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
  EXPECT_THAT(message(changed("/schema", "ehm-checkpoint/9")), HasSubstr("ehm-checkpoint/1"));
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
  EXPECT_THAT(message(changed("/surplus", 1)), HasSubstr("surplus"));
}

}  // namespace
