// SPDX-License-Identifier: Apache-2.0
// Each wiring mistake on its own: what is found, and that nothing else is. The design is a small model of our own whose
// steady gains are one by hand: y = trim + h + u.

#include "monitor/listen/wiring_check.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "idl/wire_values.h"
#include "monitor/listen/expectation.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
using testing::HasSubstr;

design::Design small_design() {
  design::Design design;
  auto& m = design.model;
  m.sample_time_s = 0.015;
  m.states = {{"x", "-", 0.0}};
  m.controls = {{"fuel", "kg/s", 1.0}};
  m.health = {{"h", "fraction", 0.0}};
  m.sensors = {{"N", "rpm", 5000.0}, {"P", "kPa", 1000.0}, {"T", "K", 700.0}};
  m.health_sigma = Eigen::VectorXd::Constant(1, 0.02);
  m.sensor_noise_sigma = Eigen::Vector3d(10.0, 2.0, 3.0);
  m.A = Eigen::MatrixXd::Constant(1, 1, 0.5);
  m.B = m.L = Eigen::MatrixXd::Zero(1, 1);
  m.C = Eigen::MatrixXd::Zero(3, 1);
  m.D = Eigen::Vector3d(1000.0, 500.0, 100.0);    // per kg/s
  m.M = Eigen::Vector3d(1000.0, 200.0, 100.0);    // per unit of health
  m.F = m.G = m.N = Eigen::MatrixXd::Zero(0, 1);  // nothing else is estimated
  m.operating_point = linear_model::OperatingPoint{10000.0, 0.8, 0.0};
  return design;
}

TEST(Expectation, IsTheSameWhereverTheZeroOfAScaleIs) {
  const design::Design kelvin = small_design();
  design::Design celsius = kelvin, fahrenheit = kelvin;
  celsius.model.sensors[2] = {"T", "degC", 700.0 - 273.15};
  fahrenheit.model.sensors[2] = {"T", "degF", 1.8 * 700.0 - 459.67};
  fahrenheit.model.sensor_noise_sigma(2) *= 1.8;
  fahrenheit.model.D.row(2) *= 1.8, fahrenheit.model.M.row(2) *= 1.8;
  const Eigen::VectorXd actuators = Eigen::VectorXd::Constant(1, 1.1);
  const Expectation k = expect_sensors(kelvin.model, actuators);
  // by hand: h moves T by 2 K, noise 3 K, one percent of 700 K
  EXPECT_NEAR(k.spread(2), std::sqrt(2.0 * 2.0 + 3.0 * 3.0 + 7.0 * 7.0), 1e-12);
  EXPECT_NEAR(expect_sensors(celsius.model, actuators).spread(2), k.spread(2), 1e-12);
  EXPECT_NEAR(expect_sensors(celsius.model, actuators).value(2), k.value(2) - 273.15, 1e-12);
  EXPECT_NEAR(expect_sensors(fahrenheit.model, actuators).spread(2), 1.8 * k.spread(2), 1e-12);
}

/// A source that is wired right, until `change` spoils sample k.
using Change = std::function<void(std::uint64_t, EngineSensors&)>;

SourceRecord fly(const Change& change = {}, std::uint64_t samples = 200) {
  SourceRecord record;
  for (std::uint64_t k = 0; k < samples; ++k) {
    EngineSensors s;
    s.engine_id(1);
    s.schema(idl::schema_version);
    s.sequence_number(k);
    s.source_time_ns(1'000'000'000'000 + static_cast<std::int64_t>(k) * 15'000'000);
    s.altitude_m(10000.0);
    s.mach(0.8);
    s.source_id(3);
    s.sensor_valid(7);
    s.sensor_count(3);
    s.actuator_count(1);
    s.actuator()[0] = 1.0;
    const double up = k % 2 == 0 ? 1.0 : -1.0;  // successive differences of 2 sigma / sqrt(2): noise as designed
    s.sensor() = {};
    s.sensor()[0] = 5000.0 + up * 7.07;
    s.sensor()[1] = 1000.0 + up * 1.414;
    s.sensor()[2] = 700.0 + up * 2.12;
    if (change) change(k, s);
    record.hear(s, 5'000'000'000 + static_cast<std::int64_t>(k) * 15'000'000);
  }
  return record;
}

std::string found(const SourceRecord& record, const EngineDescription* description = nullptr) {
  std::string all;
  for (const Finding& f : check_wiring(record, small_design(), CycleOptions{}, description).findings)
    all += (f.error ? "error: " : "warning: ") + f.text + "\n";
  return all;
}

TEST(WiringCheck, FindsNothingInAGoodSource) {
  EXPECT_EQ(found(fly()), "");
  const WiringReport report = check_wiring(fly(), small_design(), CycleOptions{}, nullptr);
  ASSERT_EQ(report.sensors.size(), 3u);
  EXPECT_DOUBLE_EQ(report.sensors[0].expected, 5000.0);
  // spread: fleet 1000 x 0.02, noise 10, one percent of trim 50
  EXPECT_NEAR(report.sensors[0].spread, std::sqrt(20.0 * 20.0 + 10.0 * 10.0 + 50.0 * 50.0), 1e-9);
}

TEST(WiringCheck, ExpectsWhatTheActuatorsMakeOfTheTrim) {
  // 0.1 kg/s more fuel: N +100, P +50, T +10 in the design's steady state.
  const auto record = fly([](std::uint64_t, EngineSensors& s) {
    s.actuator()[0] = 1.1;
    s.sensor()[0] += 100.0;
    s.sensor()[1] += 50.0;
    s.sensor()[2] += 10.0;
  });
  const WiringReport report = check_wiring(record, small_design(), CycleOptions{}, nullptr);
  for (const SensorView& sensor : report.sensors) EXPECT_NEAR(sensor.deviation, 0.0, 1e-9);
}

struct Mistake {
  const char* name;
  Change change;
  const char* said;
};

class WiringMistake : public testing::TestWithParam<Mistake> {};

TEST_P(WiringMistake, IsNamed) {
  EXPECT_THAT(found(fly(GetParam().change)), HasSubstr(GetParam().said));
}

INSTANTIATE_TEST_SUITE_P(
    Each, WiringMistake,
    testing::Values(
        Mistake{"schema", [](auto, auto& s) { s.schema(9); }, "error: schema is 9, this monitor reads 1"},
        Mistake{"source", [](auto, auto& s) { s.source_id(0); }, "error: source_id is 0"},
        Mistake{"constant_sequence", [](auto, auto& s) { s.sequence_number(5); },
                "error: sequence_number does not grow"},
        Mistake{"gap", [](auto k, auto& s) { s.sequence_number(k < 100 ? k : k + 3); },
                "warning: 3 samples are missing"},
        Mistake{"constant_time", [](auto, auto& s) { s.source_time_ns(7); },
                "warning: source_time_ns repeats in 199 samples"},
        Mistake{"unset_time", [](auto, auto& s) { s.source_time_ns(0); },
                "warning: source_time_ns is not set (0) in 200 samples"},
        Mistake{"coarse_time",
                [](auto k, auto& s) { s.source_time_ns(1 + static_cast<std::int64_t>(k) * 15 / 20 * 20'000'000); },
                "warning: source_time_ns repeats in 50 samples"},
        Mistake{"ntp", [](auto k, auto& s) { s.source_time_ns(s.source_time_ns() - (k < 100 ? 0 : 20'000'000)); },
                "warning: source_time_ns steps back in 1 samples, by up to 0.005 s"},
        Mistake{"set_back",
                [](auto k, auto& s) { s.source_time_ns(s.source_time_ns() - (k < 100 ? 0 : 60'000'000'000)); },
                "error: source_time_ns stepped back by up to 60 s: beyond 2 s the monitor's filter restarts"},
        Mistake{"microseconds", [](auto k, auto& s) { s.source_time_ns(static_cast<std::int64_t>(k) * 15'000); },
                "it looks like microseconds, nanoseconds are needed"},
        Mistake{"rate", [](auto k, auto& s) { s.source_time_ns(static_cast<std::int64_t>(k) * 20'000'000); },
                "error: source_time_ns grows by 0.02 s a sample, the design has 0.015 s"},
        Mistake{"clocks", [](auto k, auto& s) { s.source_time_ns(static_cast<std::int64_t>(k) * 15'300'000); },
                "warning: samples come every 0.015 s by our clock, every 0.0153 s by the source's"},
        Mistake{"few_sensors", [](auto, auto& s) { s.sensor_count(2); }, "error: sensor_count is 2, the design has 3"},
        Mistake{"few_actuators", [](auto, auto& s) { s.actuator_count(0); },
                "error: actuator_count is 0, the design has 1"},
        Mistake{"valid_never", [](auto, auto& s) { s.sensor_valid(5); },
                "error: sensor P: its bit in sensor_valid was never"},
        Mistake{"valid_sometimes", [](auto k, auto& s) { s.sensor_valid(k == 9 ? 5u : 7u); },
                "warning: sensor P: marked invalid in 1 samples"},
        Mistake{"nan",
                [](auto k, auto& s) {
                  if (k == 9) s.sensor()[1] = std::nan("");
                },
                "error: sensor P: NaN or infinite"},
        Mistake{"nan_actuator", [](auto, auto& s) { s.actuator()[0] = std::nan(""); }, "error: actuator fuel: NaN"},
        Mistake{"stuck", [](auto, auto& s) { s.sensor()[2] = 700.0; },
                "warning: sensor T: 200 equal values in a row; coarse, slow or frozen?"},
        Mistake{"loud", [](auto k, auto& s) { s.sensor()[1] = 1000.0 + (k % 2 == 0 ? 10.0 : -10.0); },
                "warning: sensor P: noise is 7.1 times"},
        Mistake{"quiet", [](auto k, auto& s) { s.sensor()[1] = 1000.0 + (k % 2 == 0 ? 0.05 : -0.05); },
                "warning: sensor P: noise is only 0.04 times"},
        Mistake{"swapped", [](auto, auto& s) { std::swap(s.sensor()[1], s.sensor()[2]); }, "swapped with T?"},
        Mistake{"order", [](auto, auto& s) { s.sensor()[1] = s.sensor()[2]; },
                "it would be right for T, is the order right?"},
        Mistake{"psi", [](auto, auto& s) { s.sensor()[1] /= 6.894757; }, "it looks like psi, kPa is needed"},
        Mistake{"celsius", [](auto, auto& s) { s.sensor()[2] -= 273.15; }, "it looks like degC, K is needed"},
        Mistake{"percent", [](auto, auto& s) { s.sensor()[0] = 100.0 + 1e-3 * s.sensor()[0]; },
                "it looks like percent of trim"},
        Mistake{"elsewhere", [](auto, auto& s) { s.altitude_m(5000.0); },
                "warning: the engine is not at the design's point"}),
    [](const auto& test) { return test.param.name; });

TEST(WiringCheck, StampsThatDoNotMeasureAreNoError) {
  for (const Change& change :
       {Change([](auto, auto& s) { s.source_time_ns(0); }), Change([](auto, auto& s) { s.source_time_ns(7); })})
    EXPECT_FALSE(check_wiring(fly(change), small_design(), CycleOptions{}, nullptr).has_error());
}

TEST(WiringCheck, WithoutStampsAnotherRateShowsInOurOwnClock) {
  design::Design faster = small_design();
  faster.model.sample_time_s = 0.01;
  const auto record = fly([](auto, auto& s) { s.source_time_ns(0); });
  const auto findings = check_wiring(record, faster, CycleOptions{}, nullptr).findings;
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Finding& f) {
    return f.error && f.text.find("samples come every 0.015 s by our clock, the design has 0.01 s") == 0;
  }));
}

TEST(WiringCheck, ACounterThatWrapsIsInOrder) {
  const auto record = fly([](auto k, auto& s) { s.sequence_number((k + 200) % 256); });
  EXPECT_EQ(found(record), "");
}

TEST(WiringCheck, OffTheDesignsPointPlausibilityIsAHintOnly) {
  const auto swapped = fly([](auto, auto& s) {
    s.altitude_m(5000.0);
    std::swap(s.sensor()[1], s.sensor()[2]);
  });
  EXPECT_FALSE(check_wiring(swapped, small_design(), CycleOptions{}, nullptr).has_error());
}

/// What the source would say of itself, with one sensor's words as given.
EngineDescription described(std::size_t sensor, const char* name, const char* unit) {
  EngineDescription d;
  d.sensor_count(3);
  d.actuator_count(1);
  d.actuators()[0].name() = "fuel";
  d.actuators()[0].unit() = "kg/s";
  const char* good[3][2] = {{"N", "rpm"}, {"P", "kPa"}, {"T", "K"}};
  for (std::size_t i = 0; i < 3; ++i) {
    d.sensors()[i].name() = i == sensor ? name : good[i][0];
    d.sensors()[i].unit() = i == sensor ? unit : good[i][1];
  }
  return d;
}

TEST(WiringCheck, ComparesNamesAndUnitsWithTheSourcesDescription) {
  const auto said = [](std::size_t sensor, const char* name, const char* unit) {
    const EngineDescription d = described(sensor, name, unit);
    return found(fly(), &d);
  };
  EXPECT_EQ(said(1, "P", "kPa"), "");
  EXPECT_EQ(said(2, "T", "degK"), "");
  EXPECT_EQ(
      said(1, "P", "K"),
      "error: sensor 1 is P in K by the source's description, P in kPa by the design: 'K' is a temperature, 'kPa' "
      "is a pressure\n");
  EXPECT_EQ(said(1, "P30", "kPa"),
            "error: sensor 1 is P30 in kPa by the source's description, P in kPa by the design\n");
  EXPECT_EQ(said(1, "T", "kPa"),
            "error: sensor 1 is T in kPa by the source's description, P in kPa by the design: the order is not the "
            "design's\n");
}

TEST(WiringCheck, ComparesTheSampleTimeWithTheSourcesDescription) {
  EngineDescription d = described(1, "P", "kPa");
  d.sample_time_s(0.016);  // within 10 %
  EXPECT_EQ(found(fly(), &d), "");
  d.sample_time_s(0.03);
  EXPECT_EQ(found(fly(), &d), "error: sample_time_s is 0.03 by the source's description, 0.015 by the design\n");
}

TEST(WiringCheck, AnotherUnitThatIsDeclaredIsConvertedBeforeItIsJudged) {
  const EngineDescription celsius = described(2, "T", "degC");
  const auto record = fly([](auto, auto& s) { s.sensor()[2] -= 273.15; });
  EXPECT_EQ(found(record, &celsius),
            "warning: sensor 2 is T in degC by the source's description, T in K by the design; the monitor converts\n");
  // 1 kPa is 0.145 psi: the noise of 1.41 kPa is 0.205 psi, and as much as the design has
  const EngineDescription psi = described(1, "P", "psi");
  const auto in_psi = fly([](auto, auto& s) { s.sensor()[1] /= 6.894757293168; });
  EXPECT_EQ(
      found(in_psi, &psi),
      "warning: sensor 1 is P in psi by the source's description, P in kPa by the design; the monitor converts\n");
}

}  // namespace
