// SPDX-License-Identifier: Apache-2.0
#include "deploy/command/order.h"

#include <gmock/gmock.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "idl/wire_values.h"

namespace {

using namespace ehm;
using namespace ehm::operating;
using idl::SensorFaultKind;
using idl::SimCommandKind;
using testing::HasSubstr;

Order parsed(const std::string& line) {
  CLI::App app;
  Order order;
  add_orders(app, order);
  app.parse(line);
  return order;
}

std::string error(const std::string& line) {
  try {
    parsed(line);
  } catch (const CLI::ParseError& e) {
    return e.what();
  }
  return "";
}

const SimCommand& sim(const Order& order) {
  return std::get<SimCommand>(order.command);
}

void expect_fault(const std::string& line, SensorFaultKind kind, double magnitude, double duration_s) {
  const Order order = parsed(line);
  EXPECT_EQ(sim(order).kind(), static_cast<std::uint32_t>(SimCommandKind::sensor_fault)) << line;
  EXPECT_EQ(sim(order).fault(), static_cast<std::uint32_t>(kind)) << line;
  EXPECT_EQ(sim(order).value()[0], magnitude) << line;
  EXPECT_EQ(sim(order).value()[1], duration_s) << line;
  EXPECT_EQ(sim(order).schema(), idl::schema_version);
  EXPECT_EQ(order.channel_kind, ChannelKind::sensor) << line;
  EXPECT_EQ(order.channel, "T48") << line;
}

TEST(Order, FaultsOfEachKind) {
  expect_fault("fault T48 bias 10", SensorFaultKind::bias, 10, 0);
  expect_fault("fault T48 bias -10.5 --duration 5", SensorFaultKind::bias, -10.5, 5);
  expect_fault("fault --duration 5 T48 drift -2e-1", SensorFaultKind::drift, -0.2, 5);
  expect_fault("fault T48 noise 4", SensorFaultKind::noise, 4, 0);
  expect_fault("fault T48 stuck", SensorFaultKind::stuck, 0, 0);
  expect_fault("fault T48 dropout --duration 1", SensorFaultKind::dropout, 0, 1);
  expect_fault("clear T48", SensorFaultKind::none, 0, 0);
}

TEST(Order, HealthIsSetOrAdded) {
  const Order set = parsed("health hpt_efficiency -0.02 --ramp 60"), added = parsed("health hpt_flow 0.01 --add");
  EXPECT_EQ(sim(set).kind(), static_cast<std::uint32_t>(SimCommandKind::set_health));
  EXPECT_EQ(sim(set).value()[0], -0.02);
  EXPECT_EQ(sim(set).value()[1], 60.0);
  EXPECT_EQ(set.channel_kind, ChannelKind::health);
  EXPECT_EQ(set.channel, "hpt_efficiency");
  EXPECT_EQ(sim(added).kind(), static_cast<std::uint32_t>(SimCommandKind::add_health));
  EXPECT_EQ(sim(added).value()[0], 0.01);
  EXPECT_EQ(sim(added).value()[1], 0.0);
}

TEST(Order, FlightAndDemand) {
  const Order flight = parsed("flight --altitude 9000 --mach 0.7 --delta-isa -5");
  EXPECT_EQ(sim(flight).kind(), static_cast<std::uint32_t>(SimCommandKind::set_flight));
  EXPECT_THAT(sim(flight).value(), testing::ElementsAre(9000, 0.7, -5, 0));
  EXPECT_EQ(flight.channel_kind, ChannelKind::none);
  const Order speed = parsed("demand --n1-rpm 3300"), thrust = parsed("demand --thrust-n 30000");
  EXPECT_EQ(sim(speed).kind(), static_cast<std::uint32_t>(SimCommandKind::set_demand));
  EXPECT_EQ(sim(speed).value()[0], 3300);
  EXPECT_EQ(sim(thrust).kind(), static_cast<std::uint32_t>(SimCommandKind::set_thrust));
  EXPECT_EQ(sim(thrust).value()[0], 30000);
}

TEST(Order, ClearAndReset) {
  EXPECT_EQ(sim(parsed("clear")).kind(), static_cast<std::uint32_t>(SimCommandKind::clear_faults));
  const auto reset = std::get<MonitorCommand>(parsed("reset").command);
  EXPECT_EQ(reset.kind(), static_cast<std::uint32_t>(idl::MonitorCommandKind::reset));
  EXPECT_EQ(reset.schema(), idl::schema_version);
}

TEST(Order, PublishNamesAnEstimatorByItsNumber) {
  const auto publish = std::get<MonitorCommand>(parsed("publish ekf").command);
  EXPECT_EQ(publish.kind(), 256u + 5u);  // wire_values.h
  EXPECT_EQ(publish.schema(), idl::schema_version);
  EXPECT_THAT(error("publish"), HasSubstr("estimator is required"));
  EXPECT_THAT(error("publish kalman"), HasSubstr("kalman not in {tuner,gauss_markov,"));
}

TEST(Order, WhatIsWrongIsSaid) {
  EXPECT_THAT(error(""), HasSubstr("A subcommand is required"));
  EXPECT_THAT(error("fault T48 bais 1"), HasSubstr("bais not in {bias,drift,stuck,dropout,noise}"));
  EXPECT_THAT(error("fault T48 bias"), HasSubstr("magnitude of bias is required"));
  EXPECT_THAT(error("fault T48 stuck 3"), HasSubstr("stuck has none"));
  EXPECT_THAT(error("fault T48 bias nan"), HasSubstr("'nan', allowed is a finite number"));
  EXPECT_THAT(error("fault T48 bias 1 --duration -1"), HasSubstr("'-1', allowed is a finite number from 0"));
  EXPECT_THAT(error("health hpt_flow 2%"), HasSubstr("'2%', allowed is a finite number"));
  EXPECT_THAT(error("flight --mach 0.8"), HasSubstr("--altitude"));
  EXPECT_THAT(error("demand"), HasSubstr("required"));
  EXPECT_THAT(error("demand --n1-rpm 3300 --thrust-n 3"), HasSubstr("Exactly 1 option from ["));
  EXPECT_THAT(error("demand --n1-rpm inf"), HasSubstr("'inf', allowed is a finite number"));
}

}  // namespace
