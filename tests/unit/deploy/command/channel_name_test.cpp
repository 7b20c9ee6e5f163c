// SPDX-License-Identifier: Apache-2.0
#include "deploy/command/channel_name.h"

#include <gmock/gmock.h>

#include <initializer_list>
#include <vector>

#include "idl/wire_values.h"

namespace {

using namespace ehm;
using namespace ehm::operating;

EngineDescription described(std::initializer_list<const char*> sensors) {
  EngineDescription d;
  for (const char* name : sensors) {
    d.sensors()[d.sensor_count()].name() = name;
    d.sensors()[d.sensor_count()].unit() = "K";
    d.sensor_count(d.sensor_count() + 1);
  }
  d.health_count(2);
  d.health()[0].name() = "hpt_efficiency";
  d.health()[1].name() = "hpt_flow";
  d.health()[1].unit() = "fraction";
  return d;
}

using Descriptions = std::vector<EngineDescription>;

std::string refusal(Order order, const Descriptions& descriptions) {
  try {
    address(order, 1, descriptions);
  } catch (const UnknownChannel& e) {
    return e.what();
  }
  return "";
}

TEST(ChannelName, IsFoundAndNumbered) {
  Order sensor{SimCommand{}, ChannelKind::sensor, "T48"}, health{SimCommand{}, ChannelKind::health, "hpt_flow"};
  const auto channel = address(sensor, 9, Descriptions{described({"T30", "T48"})});
  EXPECT_EQ(channel.name, "T48");
  EXPECT_EQ(channel.unit, "K");
  EXPECT_EQ(std::get<SimCommand>(sensor.command).channel(), 1u);
  EXPECT_EQ(std::get<SimCommand>(sensor.command).engine_id(), 9u);
  EXPECT_EQ(address(health, 9, Descriptions{described({})}).unit, "fraction");
  EXPECT_EQ(std::get<SimCommand>(health.command).channel(), 1u);
}

TEST(ChannelName, CapitalsCountOnlyWhereTheyTellNamesApart) {
  Order order{SimCommand{}, ChannelKind::sensor, "t48"};
  EXPECT_EQ(address(order, 1, Descriptions{described({"T30", "T48"})}).name, "T48");
  EXPECT_EQ(address(order, 1, Descriptions{described({"T48", "t48"})}).name, "t48");
  EXPECT_EQ(refusal({SimCommand{}, ChannelKind::sensor, "nf"}, Descriptions{described({"NF", "Nf"})}),
            "the engine has more than one sensor 'nf'; there are NF, Nf");
}

TEST(ChannelName, AWrongOneListsThoseThereAre) {
  EXPECT_EQ(refusal({SimCommand{}, ChannelKind::sensor, "T99"}, Descriptions{described({"T30", "T48"})}),
            "the engine has no sensor 'T99'; there are T30, T48");
  EXPECT_EQ(refusal({SimCommand{}, ChannelKind::health, "T48"}, Descriptions{described({"T48"})}),
            "the engine has no health parameter 'T48'; there are hpt_efficiency, hpt_flow");
  EXPECT_EQ(refusal({SimCommand{}, ChannelKind::sensor, ""}, Descriptions{described({})}),
            "the engine has no sensor ''; there are none");
}

TEST(ChannelName, TwoSimulatorsHaveToAgree) {
  const Order order{SimCommand{}, ChannelKind::sensor, "T48"};
  EXPECT_EQ(refusal(order, {described({"T30", "T48"}), described({"T31", "T48"})}), "");
  EXPECT_EQ(refusal(order, {described({"T30", "T48"}), described({"T48"})}),
            "the simulators of engine 1 number 'T48' differently; stop one of them");
}

TEST(ChannelName, OrdersWithoutAChannelNeedNone) {
  Order order{MonitorCommand{}};
  EXPECT_EQ(address(order, 3, {}).name, "");
  EXPECT_EQ(std::get<MonitorCommand>(order.command).engine_id(), 3u);
}

}  // namespace
