// SPDX-License-Identifier: Apache-2.0
#include "deploy/command/order_answer.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace {

using namespace ehm;
using namespace ehm::operating;

CommandReply reply(std::uint32_t source_id, std::uint32_t role, bool accepted, const char* message) {
  CommandReply r;
  r.source_id(source_id);
  r.role(role);
  r.accepted(accepted ? 1 : 0);
  r.message() = message;
  return r;
}

OrderAnswer report_of(std::vector<CommandReply> replies) {
  return {.topic = "SimCommand",
          .partition = "fleet/a",
          .domain = 3,
          .engine_id = 1,
          .readers = 2,
          .order = "T48: dropout until cleared",
          .replies = std::move(replies)};
}

TEST(OrderAnswer, IsAcceptedIfAllAnsweredAndNobodyRefused) {
  EXPECT_FALSE(report_of({}).accepted());
  EXPECT_TRUE(report_of({reply(1, 1, true, "done")}).accepted());
  EXPECT_FALSE(report_of({reply(1, 1, true, "done"), reply(2, 1, false, "no")}).accepted());
  OrderAnswer silent = report_of({reply(1, 1, true, "done")});
  silent.unanswered = {"source 2: no answer within 5 s"};
  EXPECT_FALSE(silent.accepted());
}

TEST(OrderAnswer, LinesForPeople) {
  EXPECT_EQ(opening(report_of({})), "engine 1: T48: dropout until cleared\n2 readers of SimCommand on domain 3\n");
  EXPECT_EQ(line(reply(1, 1, true, "so it is")), "source 1: done: so it is\n");
  EXPECT_EQ(line(reply(101, 2, false, "too soon")), "monitor 101: refused: too soon\n");
}

TEST(OrderAnswer, OneObjectForMachines) {
  OrderAnswer report = report_of({reply(1, 1, false, "too \"far\"")});
  report.unanswered = {"source 2: no answer within 5 s"};
  const auto j = nlohmann::json::parse(json(report));
  EXPECT_EQ(j["accepted"], false);
  EXPECT_EQ(j["readers"], 2);
  EXPECT_EQ(j["partition"], "fleet/a");
  EXPECT_EQ(j["replies"][0]["from"], "source 1");
  EXPECT_EQ(j["replies"][0]["message"], "too \"far\"");
  EXPECT_EQ(j["unanswered"][0], "source 2: no answer within 5 s");
}

}  // namespace
