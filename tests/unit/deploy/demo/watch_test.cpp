// SPDX-License-Identifier: Apache-2.0
// What ehm_watch shows and judges, with and without truth, on terminals of several widths.

#include "deploy/demo/watch_output.h"

#include <gmock/gmock.h>
#include <stdlib.h>
#include <unistd.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "deploy/demo/terminal_width.h"
#include "deploy/demo/watch_csv.h"
#include "idl/wire_values.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint64_t source = 7, stranger = 8;
constexpr std::int64_t stamp_ns = 1'000'000'000'000;

class WatchTest : public testing::TestWithParam<int> {
 protected:
  WatchTest() {
    EngineDescription d;
    d.role(static_cast<std::uint32_t>(idl::DescriptionRole::monitor));
    d.sample_time_s(0.015);
    const auto channel = [](ChannelDescription& to, const char* name, const char* unit) {
      to.name() = name;
      to.unit() = unit;
    };
    d.sensor_count(3);
    channel(d.sensors()[0], "N1", "rpm"), channel(d.sensors()[1], "T30", "K"), channel(d.sensors()[2], "P30", "kPa");
    d.health_count(2);
    channel(d.health()[0], "hpc_efficiency", "fraction");
    channel(d.health()[1], "a_health_parameter_with_a_name_of_sixty_three_characters_in_all", "percent");
    d.auxiliary_count(2);
    channel(d.auxiliary()[0], "Fn", "N"), channel(d.auxiliary()[1], "T40", "K");
    data_.hear(d, 99);
    status_.source_id(1);
    status_.latency_p50_us(120), status_.latency_p99_us(340), status_.latency_max_us(900);
    status_.rate_hz(66.7);
    status_.samples_lost(40), status_.samples_withheld(30);  // before we listened
    data_.hear(status_);
  }
  void estimate(std::uint64_t sequence) {
    const std::int64_t time_ns = stamp_ns + 15'000'000 * static_cast<std::int64_t>(sequence);
    EngineHealth h;
    h.sequence_number(sequence);
    h.source_time_ns(time_ns);
    h.publish_time_ns(1);  // a clock of its own: no latency can come of it
    h.source_id(1);
    h.sensors_used(0b101);
    h.flags(idl::estimate_flag::degraded | idl::estimate_flag::shifted);
    h.health_count(2);
    h.health()[0] = -0.0193, h.health()[1] = 1.25;
    h.sigma_total()[0] = 0.0021, h.sigma_total()[1] = 0.5;
    EngineAuxiliary z;
    z.sequence_number(sequence);
    z.source_time_ns(time_ns);
    z.auxiliary_count(2);
    z.auxiliary()[0] = 126203.4, z.auxiliary()[1] = 1312.62;
    z.sigma_total()[0] = 120.0, z.sigma_total()[1] = 3.51;
    data_.hear(z);
    data_.hear(h);
  }
  void truth(std::uint64_t sequence, std::uint64_t participant, double hpc_efficiency) {
    EngineTruth t;
    t.sequence_number(sequence);
    t.source_time_ns(stamp_ns + 15'000'000 * static_cast<std::int64_t>(sequence));
    t.health()[0] = hpc_efficiency, t.health()[1] = 1.0;
    t.auxiliary()[0] = 126100.0, t.auxiliary()[1] = 1310.0;
    data_.hear(t, participant);
  }
  void describe_source() {
    EngineDescription d;
    d.role(static_cast<std::uint32_t>(idl::DescriptionRole::source));
    data_.hear(d, source);
  }
  void event(const std::string& message) {
    HealthEvent e;
    e.source_time_ns(stamp_ns);
    e.raised(1);
    e.message() = message.c_str();
    data_.hear(e);
  }
  void status(idl::StatusLevel level, std::uint64_t received, std::uint64_t lost, std::uint64_t withheld) {
    status_.level(static_cast<std::uint32_t>(level));
    status_.samples_received(received);
    status_.samples_lost(40 + lost);
    status_.samples_withheld(30 + withheld);
    data_.hear(status_);
  }
  /// Code points of the longest line, without what steers the terminal.
  static int widest(const std::string& text) {
    int widest = 0;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      int width = 0;
      for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\033') {
          i += 2;  // "[K", "[H", "[J"
          continue;
        }
        if ((static_cast<unsigned char>(line[i]) & 0xC0u) != 0x80u) ++width;
      }
      widest = std::max(widest, width);
    }
    return widest;
  }

  demo::WatchData data_;
  MonitorStatus status_;
};

TEST_P(WatchTest, NothingIsWiderThanTheTerminalAndNoNumberIsCut) {
  describe_source();
  for (const bool with_truth : {false, true}) {
    if (with_truth) truth(4, source, -0.02);
    estimate(4);
    event("T30: a bias of 12.5 K, which is 6.1 of its standard deviations; the design without it flies from now on");
    event("\u00e4\u00f6\u00fc " + std::string(200, 'x'));
    for (const auto show : {demo::table, demo::line, demo::summary}) {
      const std::string text = show(data_, GetParam());
      EXPECT_LE(widest(text), GetParam()) << text;
      for (const char* number : {"-1.930", "0.210", "126203", "120", "1312.62", "3.51", "N", "K"})
        EXPECT_THAT(text, HasSubstr(number));
      if (!with_truth) continue;
      for (const char* number : {"-2.000", "126100", "1310.00"}) EXPECT_THAT(text, HasSubstr(number));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Columns, WatchTest, testing::Values(60, 80, 120));

using Watch = WatchTest;

TEST_F(Watch, WithoutTruthEstimatesStandAlone) {
  estimate(4);
  const std::string text = demo::summary(data_, 80);
  EXPECT_THAT(text, HasSubstr("hpc_efficiency"));
  EXPECT_THAT(text, HasSubstr("+-0.210 %"));
  EXPECT_THAT(text, HasSubstr("degraded shifted"));
  EXPECT_THAT(text, HasSubstr("sensors in use: N1 P30; left out: T30"));
  EXPECT_THAT(text, HasSubstr("accuracy was not judged"));
  EXPECT_THAT(text, Not(HasSubstr("sigmas")));
  const auto json = nlohmann::json::parse(demo::json(data_));
  EXPECT_EQ(json["accuracy_judged"], false);
  EXPECT_FALSE(json["health"][0].contains("truth"));
  EXPECT_FALSE(json.contains("samples_published"));
  EXPECT_EQ(json["sensors_left_out"], nlohmann::json::array({"T30"}));
  EXPECT_EQ(json["flags"], nlohmann::json::array({"degraded", "shifted"}));
}

TEST_F(Watch, WithTruthTheErrorStandsBesideIt) {
  describe_source();
  truth(4, source, -0.0235);
  estimate(4);
  EXPECT_THAT(demo::summary(data_, 80), HasSubstr("2.0\n"));  // (0.0235 - 0.0193) / 0.0021
  EXPECT_THAT(demo::summary(data_, 80), Not(HasSubstr("not judged")));
  const auto json = nlohmann::json::parse(demo::json(data_));
  EXPECT_EQ(json["accuracy_judged"], true);
  EXPECT_EQ(json["health"][0]["truth"], -0.0235);
  EXPECT_EQ(json["samples_published"], 5);
  EXPECT_EQ(demo::verdict(data_, 3.0), "");
  EXPECT_EQ(demo::verdict(data_, 1.9), "hpc_efficiency is 2.0 published sigmas off");
}

TEST_F(Watch, LatencyIsTheMonitorsOwn) {
  estimate(4);
  EXPECT_THAT(demo::line(data_, 200), HasSubstr("latency p50 120 us, p99 340 us, max 900 us"));
  EXPECT_EQ(nlohmann::json::parse(demo::json(data_))["latency_us"]["max"], 900.0);
}

TEST_F(Watch, TheVerdictWithoutTruthRestsOnLevelWithheldAndLostSamples) {
  EXPECT_EQ(demo::verdict(data_, 3.0), "no estimate was heard together with its description");
  estimate(4);
  status(idl::StatusLevel::ok, 5, 0, 0);
  EXPECT_EQ(demo::verdict(data_, 3.0), "");  // what was before us is not judged
  status(idl::StatusLevel::warn, 6, 2, 0);
  EXPECT_EQ(demo::verdict(data_, 3.0), "2 samples were lost");
  status(idl::StatusLevel::error, 9, 2, 3);
  EXPECT_EQ(demo::verdict(data_, 3.0),
            "the monitor said ERROR; 3 samples were withheld from estimation; 2 samples were lost");
}

TEST_F(Watch, AMonitorThatStartsAnewCountsFromZero) {
  status(idl::StatusLevel::ok, 1000, 0, 0);
  status_ = MonitorStatus();
  status_.source_id(1);
  status_.samples_received(10);
  status_.samples_lost(3);
  data_.hear(status_);
  EXPECT_EQ(data_.lost(), 3u);
}

TEST_F(Watch, AForgerOfTruthChangesNothingAndIsToldOnceThereIsEnoughOfIt) {
  describe_source();
  for (std::uint64_t k = 0; k < 20; ++k) {
    truth(k, source, -0.02);
    truth(k, stranger, 0.5);
    estimate(k);
    if (k == 5) {
      EXPECT_EQ(demo::ignored_truth(data_, 1), "");
    }
  }
  EXPECT_EQ(demo::verdict(data_, 3.0), "");
  EXPECT_EQ(demo::ignored_truth(data_, 1), "EngineTruth of engine 1 from another participant is ignored");
  EXPECT_THAT(demo::summary(data_, 80), HasSubstr("20 EngineTruth of others ignored"));
  EXPECT_EQ(nlohmann::json::parse(demo::json(data_))["truth_ignored"], 20);
}

TEST_F(Watch, TruthWithoutADescribedSourceJudgesNothing) {
  for (std::uint64_t k = 0; k < 20; ++k) truth(k, stranger, 0.5), estimate(k);
  EXPECT_EQ(demo::verdict(data_, 3.0), "");
  EXPECT_FALSE(demo::accuracy_judged(data_));
  EXPECT_THAT(demo::ignored_truth(data_, 1), HasSubstr("no participant describes the engine as its source"));
}

TEST_F(Watch, AnEstimateThatIsNoNumberFails) {
  estimate(4);
  EngineAuxiliary z;
  z.auxiliary_count(1);
  z.auxiliary()[0] = std::numeric_limits<double>::quiet_NaN();
  z.sigma_total()[0] = 1.0;
  data_.hear(z);
  EXPECT_EQ(demo::verdict(data_, 3.0), "Fn is no number with a sigma");
}

TEST_F(Watch, ASourceWithoutAClockIsTimedByItsSamples) {
  EngineHealth h;
  for (const std::uint64_t sequence : {100u, 300u}) {
    h.sequence_number(sequence);
    data_.hear(h);
  }
  EXPECT_DOUBLE_EQ(data_.flight_time_s(), 200 * 0.015);
}

TEST_F(Watch, CsvLeavesTheTruthEmptyWhereThereIsNone) {
  const test::TemporaryFolder folder;
  {
    demo::WatchCsv csv(folder.path("watch.csv"));
    estimate(4);
    csv.write(data_);
  }
  const std::string text = folder.content("watch.csv");
  EXPECT_THAT(text, HasSubstr("time_s,hpc_efficiency_truth,hpc_efficiency_estimate,hpc_efficiency_sigma,"));
  EXPECT_THAT(text, HasSubstr("\n0.000,,-0.0193,0.0021,,1.25,0.5,"));
}

TEST(TerminalWidth, IsColumnsOrEightyWhereThereIsNoTerminal) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  ::setenv("COLUMNS", "132", 1);
  EXPECT_EQ(demo::terminal_width(pipe_ends[1]), 132);
  for (const char* nonsense : {"", "wide", "-5", "0", "80x", "99999999999999"}) {
    ::setenv("COLUMNS", nonsense, 1);
    EXPECT_EQ(demo::terminal_width(pipe_ends[1]), 80) << nonsense;
  }
  ::unsetenv("COLUMNS");
  EXPECT_EQ(demo::terminal_width(pipe_ends[1]), 80);
  close(pipe_ends[0]), close(pipe_ends[1]);
}

}  // namespace
