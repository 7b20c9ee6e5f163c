// SPDX-License-Identifier: Apache-2.0
// What a real monitor records of real flights is complete, and gives the same estimates to the bit offline and
// replayed.

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/recording/part_files.h"
#include "deploy/runtime/recording/recording_rows.h"
#include "tests/integration/pair/engine_samples.h"
#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using recording::Row;
using recording::RowKind;
using testing::AllOf;
using testing::HasSubstr;

std::vector<Row> read_rows(const std::string& file) {
  recording::RecordingRows rows(file);
  std::vector<Row> all;
  for (Row row; rows.next(row);) all.push_back(row);
  return all;
}

std::vector<Row> rows_of(const std::vector<Row>& rows, std::int64_t engine, RowKind kind = RowKind::sample) {
  std::vector<Row> its;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(its),
               [&](const Row& r) { return r.a.unit == engine && r.kind() == kind; });
  return its;
}

template <class Values, class Wire>
bool same_bits(const Values& values, const Wire& wire, std::size_t count) {
  return std::memcmp(values.data(), wire.data(), count * sizeof(double)) == 0;
}

class RecordTest : public PairTest {
 protected:
  std::unique_ptr<Process> record(const std::string& name, std::vector<std::string> flags = {}) {
    listener_.status.clear();  // of a monitor before
    flags.insert(flags.end(), {"--record", folder_.path(name), "--monitor-status-period-s", "0.1"});
    return start_monitor(flags);
  }
  /// Runs a program to its end, which must be good; returns what it said. We listen meanwhile, to lose nothing.
  std::string run(const std::vector<std::string>& arguments) {
    Process process(arguments);
    EXPECT_TRUE(listener_.await([&] { return !process.running(); }, seconds(150)));
    EXPECT_EQ(process.wait(seconds(1)), 0) << process.log();
    return process.log();
  }
  std::string offline(const std::string& in, const std::string& out, const std::vector<std::string>& flags = {}) {
    std::vector<std::string> arguments{monitor_program(), "--monitor-design", design_file(),
                                       "--offline",       folder_.path(in),   "--out",
                                       folder_.path(out)};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return run(arguments);
  }
  /// A flight at rate max in which a sensor fails and comes back and a component wears at once.
  void fly(const std::string& duration_s) {
    const auto simulator = start_simulator({"--run-duration-s", duration_s, "--rate", "max"}, scenario_);
    ASSERT_TRUE(listener_.await([&] { return !simulator->running(); }, seconds(40)));
    ASSERT_EQ(simulator->wait(seconds(1)), 0);
  }
  bool await_received(std::uint32_t engine, std::uint64_t samples) {
    return listener_.await([&] {
      return std::any_of(listener_.status.begin(), listener_.status.end(), [&](const MonitorStatus& s) {
        return s.engine_id() == engine && s.samples_received() == samples;
      });
    });
  }
  void stop(Process& monitor) {
    monitor.signal(SIGTERM);
    ASSERT_EQ(monitor.wait(seconds(10)), 0);
  }

  TemporaryFolder folder_;
  std::string scenario_ = folder_.file("scenario.toml",
                                       "[[sensor_fault]]\nsensor = \"T30\"\nkind = \"dropout\"\ntime_s = 10\n"
                                       "duration_s = 4\n[[health_change]]\ntime_s = 25\n"
                                       "parameter = \"hpc_efficiency\"\nchange = -0.02\n");
};

TEST_F(RecordTest, EverySampleAndEstimateIsThereAndOfflineAndReplayAreIdenticalToTheBit) {
  auto monitor = record("online.h5");
  fly("45");
  ASSERT_TRUE(await_received(1, 3000));
  stop(*monitor);

  const auto online = read_rows(folder_.path("online.h5"));
  const auto samples = rows_of(online, 1);
  ASSERT_EQ(samples.size(), 3000u);
  // A busy machine may let this listener miss some at rate max; what it heard must be what is recorded.
  EXPECT_GE(listener_.health.size(), 1000u);
  for (const EngineHealth& health : listener_.health) {
    const Row& row = samples.at(health.sequence_number());
    ASSERT_EQ(row.a.sequence, static_cast<std::int64_t>(health.sequence_number()));
    ASSERT_TRUE(same_bits(row.t, health.health(), health.health_count())) << row.a.sequence;
    ASSERT_TRUE(same_bits(row.t_sigma, health.sigma_total(), health.health_count())) << row.a.sequence;
    ASSERT_TRUE(same_bits(row.t_sigma_filter, health.sigma_filter(), health.health_count())) << row.a.sequence;
    ASSERT_EQ(row.a.flags, static_cast<std::int64_t>(health.flags())) << row.a.sequence;
    ASSERT_EQ(row.a.sensors_used, static_cast<std::int64_t>(health.sensors_used())) << row.a.sequence;
  }
  for (const EngineAuxiliary& auxiliary : listener_.auxiliary) {
    const Row& row = samples.at(auxiliary.sequence_number());
    ASSERT_TRUE(same_bits(row.x_v, auxiliary.auxiliary(), auxiliary.auxiliary_count())) << row.a.sequence;
    ASSERT_TRUE(same_bits(row.x_v_sigma, auxiliary.sigma_total(), auxiliary.auxiliary_count())) << row.a.sequence;
  }
  for (const EngineSensors& sensors : listener_.sensors)
    ASSERT_TRUE(same_bits(samples.at(sensors.sequence_number()).x_s, sensors.sensor(), sensors.sensor_count()));
  const auto degraded = std::count_if(samples.begin(), samples.end(),
                                      [](const Row& row) { return (row.a.flags & idl::estimate_flag::degraded) != 0; });
  EXPECT_GT(degraded, 100);  // the fault was there

  EXPECT_THAT(offline("online.h5", "offline.h5"),
              HasSubstr("estimates of the input: 3000 identical to the bit, 0 different"));
  const auto offline_samples = rows_of(read_rows(folder_.path("offline.h5")), 1);
  ASSERT_EQ(offline_samples.size(), 3000u);

  // Every estimator of the table side by side; of scheduled the design has no schedule, and tuner is the published one.
  EXPECT_THAT(offline("online.h5", "all.h5", {"--all-estimators", "--estimator-particles", "5"}),
              AllOf(HasSubstr("estimates of the input: 3000 identical to the bit, 0 different"),
                    HasSubstr("scheduled does not fly")));
  const auto all = read_rows(folder_.path("all.h5"));
  constexpr int shadows = 14;
  for (int i = 0; i <= shadows; ++i)
    EXPECT_EQ(rows_of(all, 1, static_cast<RowKind>(static_cast<int>(RowKind::shadow) + i)).size(),
              i < shadows ? 3000u : 0u)
        << i;

  listener_.status.clear();
  monitor = record("replayed.h5");
  const std::string said = run({simulator_program(), "--replay", folder_.path("online.h5"), "--rate", "max",
                                "--dds-domain", std::to_string(domain_), "--run-wait-for-monitors", "2"});
  EXPECT_THAT(said, HasSubstr("3000 samples of 1 engine(s) published, 0 refused"));
  ASSERT_TRUE(await_received(1, 3000));
  stop(*monitor);
  const auto replayed = rows_of(read_rows(folder_.path("replayed.h5")), 1);
  ASSERT_EQ(replayed.size(), 3000u);
  for (std::size_t k = 0; k < replayed.size(); ++k) {
    for (const Row* other : {&replayed[k], &offline_samples[k]}) {
      ASSERT_EQ(other->a.source_time_ns, samples[k].a.source_time_ns);
      ASSERT_TRUE(same_bits(other->t, samples[k].t, other->t.size())) << k;
      ASSERT_TRUE(same_bits(other->t_sigma, samples[k].t_sigma, other->t.size())) << k;
      ASSERT_TRUE(same_bits(other->innovation, samples[k].innovation, other->innovation.size())) << k;
      ASSERT_EQ(other->a.flags, samples[k].a.flags) << k;
    }
  }
}

TEST_F(RecordTest, BadSamplesResetsSilenceAndASecondSourceAreRepeatedOffline) {
  auto monitor = record("online.h5");
  EngineSamples samples(design_file(), 5);
  idl::Writer<EngineSensors> writer(participant_);
  idl::Writer<MonitorCommand> commands(participant_);
  ASSERT_TRUE(listener_.await([&] { return writer.matched() == 2 && commands.matched() == 1; }));
  std::uint64_t sent = 0;
  const auto send = [&](const EngineSensors& sample) {
    writer.write(sample);
    ++sent;
  };
  for (int k = 0; k < 100; ++k) send(samples.next());
  EngineSensors bad = samples.next();
  bad.sensor()[2] = std::numeric_limits<double>::quiet_NaN();
  send(bad);
  send(bad);  // a duplicate
  const EngineSensors late = samples.next();
  send(samples.next());
  send(late);
  bad = samples.next();
  bad.sensor_count(99);
  send(bad);
  bad = samples.next();
  bad.source_id(10);  // a second source, while the first is there
  send(bad);
  for (int k = 0; k < 20; ++k) send(samples.next());
  ASSERT_TRUE(await_received(5, sent));

  MonitorCommand reset;
  reset.engine_id(5);
  reset.schema(idl::schema_version);
  reset.kind(static_cast<std::uint32_t>(idl::MonitorCommandKind::reset));
  commands.write(reset);
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::filter_restart, true); }));
  EngineSensors last;
  for (int k = 0; k < 50; ++k) send(last = samples.next());
  ASSERT_TRUE(await_received(5, sent));
  // Silence after these, not an earlier one: a slow machine pauses for as long while it awaits the reset.
  const auto silent = [&](const HealthEvent& e) {
    return e.kind() == static_cast<std::uint32_t>(idl::EventKind::input_lost) && e.raised() == 1 &&
           e.sequence_number() == last.sequence_number();
  };
  ASSERT_TRUE(listener_.await([&] { return std::any_of(listener_.events.begin(), listener_.events.end(), silent); }));
  samples.set_source(10);  // takes over, now that the first is silent
  for (int k = 0; k < 50; ++k) send(samples.next());
  ASSERT_TRUE(await_received(5, sent));
  stop(*monitor);

  const auto rows = read_rows(folder_.path("online.h5"));
  const auto recorded = rows_of(rows, 5);
  ASSERT_EQ(recorded.size(), sent);
  EXPECT_EQ(rows_of(rows, 5, RowKind::reset).size(), 1u);
  EXPECT_GE(rows_of(rows, 5, RowKind::input_lost).size(), 1u);
  const auto dropped = std::count_if(recorded.begin(), recorded.end(), [](const Row& r) { return r.a.accepted == 0; });
  EXPECT_EQ(dropped, 4);                       // duplicate, overtaken, malformed, foreign
  EXPECT_EQ(recorded[104].a.sensor_count, 0);  // 99 sensors describe none (idl/dds/tidy.h)
  EXPECT_EQ(recorded.back().a.source_id, 10);
  EXPECT_EQ(recorded.back().a.accepted, 1);
  EXPECT_THAT(offline("online.h5", "offline.h5"), HasSubstr(" identical to the bit, 0 different"));
  const auto again = rows_of(read_rows(folder_.path("offline.h5")), 5);
  ASSERT_EQ(again.size(), recorded.size());
  for (std::size_t k = 0; k < again.size(); ++k) ASSERT_EQ(again[k].a.accepted, recorded[k].a.accepted) << k;
}

TEST_F(RecordTest, AKilledMonitorLeavesAReadableRecordingAndTheNextGoesOnBesideIt) {
  auto monitor = record("killed.h5");
  fly("45");
  ASSERT_TRUE(await_received(1, 3000));
  // Whole chunks of 64 rows reach the file within half a second.
  const auto rows_readable = [&] {
    try {
      return read_rows(folder_.path("killed.h5")).size();
    } catch (const std::exception&) {
      return std::size_t{0};  // it is just being created
    }
  };
  ASSERT_TRUE(listener_.await([&] { return rows_readable() >= 3000u / 64 * 64; }));
  monitor->signal(SIGKILL);
  ASSERT_EQ(monitor->wait(seconds(5)), 128 + SIGKILL);
  EXPECT_THAT(offline("killed.h5", "offline.h5"), HasSubstr(" identical to the bit, 0 different"));
  EXPECT_THAT(run({"/usr/bin/python3", EHM_SOURCE_DIR "/tests/integration/recording/read_recording.py",
                   folder_.path("killed.h5")}),
              HasSubstr("T30"));

  monitor = record("killed.h5");
  ASSERT_TRUE(listener_.await([&] { return std::filesystem::exists(folder_.path("killed.0002.h5")); }));
  fly("1.5");
  stop(*monitor);
  EXPECT_EQ(rows_of(read_rows(folder_.path("killed.0002.h5")), 1).size(), 100u);
  EXPECT_THAT(run({"/usr/bin/python3", EHM_SOURCE_DIR "/tests/integration/recording/read_recording.py",
                   folder_.path("killed.0002.h5")}),
              HasSubstr("engines: [1]"));
}

TEST_F(RecordTest, AFullDiskPausesTheRecordingAndNotTheMonitor) {
  // A limit on the size of files stands for the full disk; 200 blocks of 1024 bytes.
  Process monitor({"/bin/bash", "-c",
                   "ulimit -S -f 200; exec '" + monitor_program() + "' --monitor-design '" + design_file() +
                       "' --dds-domain " + std::to_string(domain_) + " --monitor-status-period-s 0.1 --record '" +
                       folder_.path("full.h5") + "'"});
  fly("60");
  ASSERT_TRUE(listener_.await([&] {
    return listener_.status.back().records_lost() > 0 && listener_.has_event(idl::EventKind::recording, true);
  }));
  EXPECT_TRUE(listener_.await([&] { return listener_.status.back().samples_processed() == 4000u; }));  // it went on
  EXPECT_THAT(monitor.log(), HasSubstr("recording has stopped, the monitor goes on"));

  // Somebody makes room.
  rlimit room{RLIM_INFINITY, RLIM_INFINITY};
  ASSERT_EQ(prlimit(monitor.pid(), RLIMIT_FSIZE, &room, nullptr), 0);
  const std::string next = folder_.path("full.0002.h5");
  const auto goes_on = [&] { return monitor.log().find("recording goes on in " + next) != std::string::npos; };
  ASSERT_TRUE(listener_.await(goes_on, seconds(30))) << monitor.log();
  fly("1.5");
  ASSERT_TRUE(listener_.await([&] { return listener_.status.back().samples_processed() == 4100u; }));
  monitor.signal(SIGTERM);
  EXPECT_EQ(monitor.wait(seconds(30)), 0);  // HDF5 alone would crash on the file that it could not close
  EXPECT_EQ(rows_of(read_rows(next), 1).size(), 100u);
}

TEST_F(RecordTest, AFolderThatCannotBeWrittenPreventsNoFlight) {
  const auto monitor = record("nowhere/flight.h5", {"--checkpoint-directory", "/proc/nowhere"});
  fly("3");
  EXPECT_TRUE(listener_.await([&] { return listener_.status.back().samples_processed() == 200u; })) << monitor->log();
  EXPECT_TRUE(listener_.has_event(idl::EventKind::recording, true));
  EXPECT_TRUE(listener_.has_event(idl::EventKind::checkpoint, true));
  EXPECT_GE(listener_.status.back().records_lost(), 200u);
  stop(*monitor);
}

TEST_F(RecordTest, OnlyItsOwnPartsAreRemovedAndNeverTheFirst) {
  const std::string others = folder_.file("flight.0050.h5", "somebody's");
  const auto monitor = record("flight.h5", {"--record-max-mb", "1", "--record-max-files", "2"});
  fly("300");
  const auto parts = [&] { return recording::existing_parts(folder_.path("flight.h5")); };
  ASSERT_TRUE(listener_.await([&] { return parts().back() >= 54; })) << monitor->log();
  stop(*monitor);
  EXPECT_EQ(folder_.content("flight.0050.h5"), "somebody's");
  const std::vector<std::int64_t> left = parts();  // somebody's, the start of the flight, its end
  ASSERT_EQ(left.size(), 3u);
  EXPECT_EQ(left[0], 50);
  EXPECT_EQ(left[1], 51);
  EXPECT_GE(left[2], 54);
}

/// A table of the flight's samples as somebody else would write it, in his units, and the map that reads it.
class CsvTest : public RecordTest {
 protected:
  std::string csv(const std::vector<Row>& samples, const recording::Channels& channels) {
    std::string text = "engine,time_s,altitude_m,mach,delta_isa_k";
    for (const auto& channel : channels.actuators) text += "," + channel.name;
    for (const auto& channel : channels.sensors) text += "," + channel.name;
    for (const Row& row : samples) {
      text += "\n1," + files::shortest(1e-9 * static_cast<double>(row.a.source_time_ns - samples[0].a.source_time_ns));
      for (std::size_t i = 0; i < 3 + channels.actuators.size(); ++i) text += "," + files::shortest(row.w[i]);
      for (std::size_t i = 0; i < channels.sensors.size(); ++i)
        text += "," + (row.a.sensor_valid >> i & 1 ? files::shortest(row.x_s[i]) : std::string("nan"));
    }
    return folder_.file("flight.csv", text + "\n");
  }
  std::string map(const recording::Channels& channels) {
    std::string text = "[file]\nseparator = \"comma\"\nheader = true\nengine_id_column = 1\ntime_column = \"time_s\"\n";
    const auto add = [&](const std::string& table, const std::string& name) {
      text += "[[" + table + "]]\nname = \"" + name + "\"\ncolumn = \"" + name + "\"\n";
    };
    for (const char* name : {"altitude_m", "mach", "delta_isa_k"}) add("flight", name);
    for (const auto& channel : channels.actuators) add("actuator", channel.name);
    for (const auto& channel : channels.sensors) add("sensor", channel.name);
    return folder_.file("map.toml", text);
  }
};

TEST_F(CsvTest, ACsvFileGivesTheEstimatesOfTheFlightThatItHolds) {
  auto monitor = record("online.h5");
  fly("15");
  ASSERT_TRUE(await_received(1, 1000));
  stop(*monitor);
  const auto channels = recording::RecordingRows(folder_.path("online.h5")).info().channels;
  const auto samples = rows_of(read_rows(folder_.path("online.h5")), 1);
  csv(samples, channels);
  const std::string map_file = map(channels);
  EXPECT_THAT(offline("flight.csv", "offline.h5", {"--column-map", map_file}),
              HasSubstr("1000 samples, 1000 with estimates"));
  const auto again = rows_of(read_rows(folder_.path("offline.h5")), 1);
  ASSERT_EQ(again.size(), samples.size());
  for (std::size_t k = 0; k < again.size(); ++k) {
    ASSERT_TRUE(same_bits(again[k].t, samples[k].t, again[k].t.size())) << k;
    ASSERT_TRUE(same_bits(again[k].t_sigma, samples[k].t_sigma, again[k].t.size())) << k;
  }

  listener_.status.clear();
  monitor = record("replayed.h5");
  const std::string said =
      run({simulator_program(), "--replay", folder_.path("flight.csv"), "--column-map", map_file, "--rate", "max",
           "--dds-domain", std::to_string(domain_), "--run-wait-for-monitors", "2"});
  EXPECT_THAT(said, HasSubstr("1000 samples of 1 engine(s) published"));
  ASSERT_TRUE(await_received(1, 1000));
  stop(*monitor);
  const auto replayed = rows_of(read_rows(folder_.path("replayed.h5")), 1);
  ASSERT_EQ(replayed.size(), samples.size());
  EXPECT_TRUE(same_bits(replayed.back().t, samples.back().t, samples.back().t.size()));
}

TEST_F(RecordTest, ThePublishedEstimatorIsStatedAndFliesAgainOffline) {
  auto monitor = record("online.h5", {"--estimator-published", "time_varying"});
  fly("6");
  ASSERT_TRUE(await_received(1, 400));
  stop(*monitor);
  EXPECT_EQ(recording::RecordingRows(folder_.path("online.h5")).info().published, "time_varying");
  EXPECT_THAT(offline("online.h5", "offline.h5"),
              AllOf(HasSubstr("time_varying flies, as"), HasSubstr("400 identical to the bit, 0 different")));
  EXPECT_EQ(recording::RecordingRows(folder_.path("offline.h5")).info().published, "time_varying");
  EXPECT_THAT(offline("online.h5", "other.h5", {"--estimator-published", "tuner"}),
              AllOf(HasSubstr("was recorded with estimator.published = time_varying, tuner flies as configured"),
                    HasSubstr("0 identical to the bit, 400 different")));
  Process twice({monitor_program(), "--monitor-design", design_file(), "--offline", folder_.path("online.h5"), "--out",
                 folder_.path("twice.h5"), "--estimator-shadow", "time_varying"});
  EXPECT_EQ(twice.wait(seconds(20)), 2);
  EXPECT_THAT(twice.log(), HasSubstr("'estimator.shadow': 'time_varying' is published already, since "));
}

}  // namespace
