// SPDX-License-Identifier: Apache-2.0
// A flight in other units than the design's gives the estimates of the same flight in the design's: from a table by its
// column map, and from a source by its description, also where that comes late. What does not convert is not used.

#include <gmock/gmock.h>

#include <csignal>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/recording/recording_rows.h"
#include "tests/integration/pair/engine_samples.h"
#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using recording::Row;
using testing::HasSubstr;

constexpr double psi = 0.45359237 * 9.80665 / (0.0254 * 0.0254);  // Pa, by definition
constexpr double pound = 0.45359237, foot = 0.3048;

/// The design's channels in an order and units that an engineer in the US would have.
struct Us {
  const char *name, *unit, *si;
  double (*from_si)(double);
};
constexpr Us us[]{{"Nf", "rpm", "rpm", [](double v) { return v; }},
                  {"Nc", "rpm", "rpm", [](double v) { return v; }},
                  {"P24", "psia", "Pa", [](double v) { return v / psi; }},
                  {"T24", "degR", "K", [](double v) { return 1.8 * v; }},
                  {"Ps30", "psia", "Pa", [](double v) { return v / psi; }},
                  {"T30", "degF", "K", [](double v) { return 1.8 * v - 459.67; }},
                  {"T48", "degC", "K", [](double v) { return v - 273.15; }}};

class UnitsTest : public PairTest {
 protected:
  /// The flight as a table, in the design's units or the others.
  std::string table(const std::string& name, bool others) {
    EngineSamples engine(design_file(), 1);
    std::string text = "time,alt,fuel,vsv,vbv,Nf,Nc,P24,T24,Ps30,T30,T48\n";
    for (int k = 0; k < 200; ++k) {
      const EngineSensors s = engine.next();
      const double fuel = s.actuator()[0], altitude = s.altitude_m();
      text += files::shortest(0.015 * k) + "," + files::shortest(others ? altitude / foot : altitude) + "," +
              files::shortest(others ? fuel / pound * 3600.0 : fuel) + "," + files::shortest(s.actuator()[1]) + "," +
              files::shortest(s.actuator()[2]);
      for (std::size_t i = 0; i < 7; ++i)
        text += "," + files::shortest(others ? us[i].from_si(s.sensor()[i]) : s.sensor()[i]);
      text += "\n";
    }
    return folder_.file(name, text);
  }
  std::string map(const std::string& name, bool others) {
    std::string text = "[file]\nseparator = \"comma\"\nheader = true\nengine_id = 1\ntime_column = \"time\"\n";
    const auto add = [&](const char* kind, const std::string& channel, const std::string& rest) {
      text += std::string("[[") + kind + "]]\nname = \"" + channel + "\"\n" + rest + "\n";
    };
    const auto in = [&](const char* unit, const char* si) {
      return std::string("unit = \"") + (others ? unit : si) + "\"\n";
    };
    add("flight", "altitude_m", in("ft", "m") + "column = \"alt\"");
    add("flight", "mach", "value = 0.8");
    add("flight", "delta_isa_k", "value = 0.0");
    add("actuator", "fuel_flow", in("pph", "kg/s") + "column = \"fuel\"");
    add("actuator", "VSV", "column = \"vsv\"");
    add("actuator", "VBV", "column = \"vbv\"");
    add("actuator", "customer_bleed", "value = 0.0");
    add("actuator", "power_offtake", "value = 0.0");
    for (const Us& channel : us)
      add("sensor", channel.name, in(channel.unit, channel.si) + "column = \"" + channel.name + "\"");
    return folder_.file(name, text);
  }
  /// The last row of the estimates of a table.
  Row offline(const std::string& table, const std::string& map) {
    const std::string out = table + ".h5";
    Process process(
        {monitor_program(), "--monitor-design", design_file(), "--offline", table, "--column-map", map, "--out", out});
    EXPECT_EQ(process.wait(seconds(20)), 0) << process.log();
    recording::RecordingRows rows(out);
    Row row, last;
    while (rows.next(row)) last = row;
    return last;
  }
  TemporaryFolder folder_;
};

TEST_F(UnitsTest, ATableInOtherUnitsGivesTheSameEstimates) {
  const Row si = offline(table("si.csv", false), map("si.toml", false));
  const Row others = offline(table("us.csv", true), map("us.toml", true));
  ASSERT_EQ(si.a.sequence, 199);
  ASSERT_EQ(si.a.estimates, 1);
  EXPECT_EQ(others.a.estimates, 1);
  EXPECT_EQ(others.a.flags, si.a.flags);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(others.t[i], si.t[i], 1e-9) << i;
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(others.x_s[i], si.x_s[i], 1e-9 * si.x_s[i]) << us[i].name;
  EXPECT_NEAR(others.w[0], 10668.0, 1e-6);
}

TEST_F(UnitsTest, AUnitThatDoesNotConvertIsRefusedWithBothNamed) {
  const std::string file = table("us.csv", true);
  map("us.toml", true);
  std::string text = folder_.content("us.toml");
  text.replace(text.find("degC"), 4, "psig");
  const std::string bad = folder_.file("bad.toml", text);
  Process process({monitor_program(), "--monitor-design", design_file(), "--offline", file, "--column-map", bad,
                   "--out", folder_.path("out.h5")});
  EXPECT_EQ(process.wait(seconds(20)), 2);
  EXPECT_THAT(process.log(), HasSubstr("bad.toml: sensor T48 is in 'psig', the design has it in 'K', which cannot be "
                                       "converted: 'psig' is a gauge pressure, 'K' is a temperature"));
}

/// A source that describes its channels as it likes, and when.
class DescribedSourceTest : public UnitsTest {
 protected:
  EngineDescription description() const {
    EngineDescription d;
    d.engine_id(1);
    d.source_id(9);
    d.role(static_cast<std::uint32_t>(idl::DescriptionRole::source));
    d.schema(idl::schema_version);
    d.sensor_count(7);
    for (std::size_t i = 0; i < 7; ++i) {
      d.sensors()[i].name() = us[i].name;
      d.sensors()[i].unit() = us[i].si;
    }
    return d;
  }
  EngineSensors celsius(EngineSensors s) const {
    for (const std::size_t i : {3u, 5u, 6u}) s.sensor()[i] -= 273.15;
    return s;
  }
  EngineDescription in_celsius() const {
    EngineDescription d = description();
    for (const std::size_t i : {3u, 5u, 6u}) d.sensors()[i].unit() = "degC";
    return d;
  }
  /// Until the monitor hears us, and we hear it: by samples of another engine.
  void meet(idl::Writer<EngineSensors>& sensors) {
    EngineSamples other(design_file(), 2);
    ASSERT_TRUE(listener_.await([&] { return sensors.matched() == 2; }));  // the monitor and the listener
    const auto answered = [&] { return !listener_.residuals.empty(); };
    for (int k = 0; k < 20 && !answered(); ++k) {
      sensors.write(other.next());
      listener_.await(answered, seconds(1));
    }
    ASSERT_TRUE(answered()) << monitor_->log();
  }
  std::vector<EngineResiduals> answers() const {
    std::vector<EngineResiduals> own;
    for (const EngineResiduals& r : listener_.residuals)
      if (r.engine_id() == 1) own.push_back(r);
    return own;
  }
  /// Sends samples one by one, and waits for the monitor's answer to each.
  template <class Change>
  void fly(idl::Writer<EngineSensors>& sensors, std::size_t count, Change&& change) {
    const std::size_t before = answers().size();
    for (std::size_t k = 0; k < count; ++k) {
      sensors.write(change(engine_.next()));
      ASSERT_TRUE(listener_.await([&] { return answers().size() == before + k + 1; })) << k << "\n" << monitor_->log();
    }
  }
  const HealthEvent* channel_event(bool raised) const {
    return listener_.find_event(idl::EventKind::source_channels, raised);
  }
  EngineSamples engine_{design_file(), 1};
  std::unique_ptr<Process> monitor_;
};

TEST_F(DescribedSourceTest, IsConvertedFromItsFirstSampleOn) {
  monitor_ = start_monitor();
  idl::Participant participant(options(domain_));
  idl::Writer<EngineDescription> descriptions(participant);
  idl::Writer<EngineSensors> sensors(participant);
  meet(sensors);
  descriptions.write(in_celsius());
  fly(sensors, 20, [&](EngineSensors s) { return celsius(s); });
  for (const EngineResiduals& r : answers())
    EXPECT_EQ(r.fused(), 0b1111111u) << r.sequence_number();  // near the trim, as in K
  EXPECT_FALSE(listener_.has_event(idl::EventKind::filter_restart, true));
  EXPECT_EQ(channel_event(true), nullptr);
  EXPECT_THAT(monitor_->log(),
              HasSubstr("3 channels of source 9 are converted to the design's units, the first T24 from "
                        "degC to K"));
}

TEST_F(DescribedSourceTest, WhatAStrangerSaysInItsNameIsNotHeard) {
  monitor_ = start_monitor();
  idl::Participant participant(options(domain_)), elsewhere(options(domain_));
  idl::Writer<EngineDescription> descriptions(participant), forged(elsewhere);
  idl::Writer<EngineSensors> sensors(participant);
  meet(sensors);
  ASSERT_TRUE(listener_.await([&] { return forged.matched() == 2; }));
  forged.write(in_celsius());
  descriptions.write(description());
  const auto unchanged = [](EngineSensors s) { return s; };
  fly(sensors, 5, unchanged);
  forged.write(in_celsius());
  ASSERT_TRUE(forged.drain(5.0));  // the monitor has it
  fly(sensors, 20, unchanged);
  for (const EngineResiduals& r : answers()) EXPECT_EQ(r.fused(), 0b1111111u) << r.sequence_number();
  EXPECT_FALSE(listener_.has_event(idl::EventKind::filter_restart, true));
  EXPECT_EQ(channel_event(true), nullptr);
}

TEST_F(DescribedSourceTest, ThatSpeaksLateStartsTheFilterAnewInTheRightUnits) {
  monitor_ = start_monitor();
  idl::Participant participant(options(domain_));
  idl::Writer<EngineSensors> sensors(participant);
  meet(sensors);
  fly(sensors, 5, [&](EngineSensors s) { return celsius(s); });  // nobody can know yet
  EXPECT_LT(answers().at(0).innovation()[5], -200.0);            // of T30, as if it were in K
  idl::Writer<EngineDescription> descriptions(participant);
  descriptions.write(in_celsius());
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::filter_restart, true); }));
  fly(sensors, 5, [&](EngineSensors s) { return celsius(s); });
  EXPECT_EQ(answers().back().fused(), 0b1111111u);
  EXPECT_NEAR(answers().back().innovation()[5], 0.0, 1.0);
}

TEST_F(DescribedSourceTest, ChannelsThatDoNotFitAreNotUsedAndNamed) {
  monitor_ = start_monitor();
  idl::Participant participant(options(domain_));
  idl::Writer<EngineDescription> descriptions(participant);
  idl::Writer<EngineSensors> sensors(participant);
  meet(sensors);
  EngineDescription odd = description();
  odd.sensors()[6].unit() = "psi";
  descriptions.write(odd);
  fly(sensors, 20, [](EngineSensors s) { return s; });
  ASSERT_TRUE(listener_.await([&] { return channel_event(true) != nullptr; }));
  EXPECT_EQ(channel_event(true)->channel(), 6u);
  EXPECT_EQ(channel_event(true)->value(), 9.0);
  EXPECT_STREQ(channel_event(true)->message().c_str(),
               "sensor 6 is T48 in psi by source 9, T48 in K by the design: 'psi' is a pressure, 'K' is a temperature; "
               "it is not used");
  EXPECT_EQ(answers().back().fused(), 0b0111111u);

  // Mended while it flies: the event ends, the sensor comes back by requalifying.
  descriptions.write(description());
  ASSERT_TRUE(listener_.await([&] { return channel_event(false) != nullptr; }));
  EXPECT_STREQ(channel_event(false)->message().c_str(), "sensor T48 of source 9 fits the design");
}

TEST_F(DescribedSourceTest, AnEngineOfAnotherTypeIsNamed) {
  monitor_ = start_monitor();
  idl::Participant participant(options(domain_));
  idl::Writer<EngineDescription> descriptions(participant);
  idl::Writer<EngineSensors> sensors(participant);
  meet(sensors);
  EngineDescription other = description();
  other.engine_type() = "high-bypass-turbofan";
  descriptions.write(other);
  fly(sensors, 5, [](EngineSensors s) { return s; });
  ASSERT_TRUE(listener_.await([&] { return channel_event(true) != nullptr; })) << monitor_->log();
  EXPECT_EQ(channel_event(true)->channel(), 24u);
  EXPECT_EQ(channel_event(true)->value(), 9.0);
  EXPECT_STREQ(channel_event(true)->message().c_str(),
               "the engine is high-bypass-turbofan by source 9, jt9d by the design: what is estimated is another "
               "engine's");
  EXPECT_EQ(answers().back().fused(), 0b1111111u);

  other.engine_type() = "jt9d";
  descriptions.write(other);
  ASSERT_TRUE(listener_.await([&] { return channel_event(false) != nullptr; }));
  EXPECT_STREQ(channel_event(false)->message().c_str(), "the engine of source 9 is the design's, jt9d");
}

TEST_F(DescribedSourceTest, AnotherOrderIsNotUsedAndAnotherNameIsNamed) {
  monitor_ = start_monitor();
  idl::Participant participant(options(domain_));
  idl::Writer<EngineDescription> descriptions(participant);
  idl::Writer<EngineSensors> sensors(participant);
  meet(sensors);
  EngineDescription odd = description();
  odd.sensors()[0].name() = "N1";
  odd.sensors()[3].name() = "T30";
  descriptions.write(odd);
  fly(sensors, 3, [](EngineSensors s) { return s; });
  const auto logs = [&](const std::string& text) {
    return listener_.await([&] { return monitor_->log().find(text) != std::string::npos; });
  };
  EXPECT_TRUE(logs("sensor 0 is N1 in rpm by source 9, Nf in rpm by the design; it is used")) << monitor_->log();
  EXPECT_TRUE(
      logs("sensor 3 is T30 in K by source 9, T24 in K by the design: the order is not the design's; it is not "
           "used"))
      << monitor_->log();
  EXPECT_EQ(answers().back().fused(), 0b1110111u);
}

}  // namespace
