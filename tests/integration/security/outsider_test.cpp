// SPDX-License-Identifier: Apache-2.0
// Nobody joins a secured domain without an identity of its authority, and the service says who tried.

#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "idl/dds/security_files.h"
#include "tests/integration/security/secured_pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;

/// Everything that an outsider would want: to feed, to command, to listen.
struct Outsider {
  explicit Outsider(const idl::ParticipantOptions& options)
      : participant(options), sensors(participant), commands(participant), health(participant), status(participant) {}
  void try_everything() {
    EngineSensors sample;
    sample.engine_id(2);
    sample.schema(idl::schema_version);
    sample.source_id(66);
    sensors.write(sample);
    MonitorCommand reset;
    reset.schema(idl::schema_version);
    reset.kind(static_cast<std::uint32_t>(idl::MonitorCommandKind::reset));
    commands.write(reset);
  }
  bool heard_nothing() {
    EngineHealth h;
    MonitorStatus s;
    return !health.take(h) && !status.take(s);
  }
  idl::Participant participant;
  idl::Writer<EngineSensors> sensors;
  idl::Writer<MonitorCommand> commands;
  idl::Reader<EngineHealth> health;
  idl::Reader<MonitorStatus> status;
};

class OutsiderTest : public SecuredPair {
 protected:
  void expect_kept_out(const idl::ParticipantOptions& who) {
    Outsider outsider(who);
    expect_kept_out(outsider, who.name);
  }
  /// It says what it wants while the monitor has time to notice; then nothing of it was heard, and it heard nothing.
  void expect_kept_out(Outsider& outsider, const std::string& name) {
    EXPECT_TRUE(viewer_->await([&] {
      outsider.try_everything();
      return !viewer_->security_event("'" + name + "'").empty();
    })) << monitor_->log();
    EXPECT_THAT(monitor_->log(), testing::HasSubstr("security: participant '" + name + "'"));
    EXPECT_TRUE(goes_on());
    EXPECT_EQ(outsider.sensors.matched() + outsider.commands.matched(), 0);
    EXPECT_EQ(outsider.health.matched() + outsider.status.matched(), 0);
    EXPECT_TRUE(outsider.heard_nothing());
    EXPECT_EQ(viewer_->estimates(2), 0u);
    EXPECT_EQ(viewer_->status.back().unknown_engine_samples(), 0u);
    EXPECT_EQ(viewer_->status.back().filter_restarts(), 0u) << "the reset was obeyed";
  }
};

TEST_F(OutsiderTest, TheAuthorisedPairWorksAndNobodyIsReported) {
  start_all();
  EXPECT_TRUE(goes_on(200));
  EXPECT_EQ(viewer_->security_event(""), "");
  EXPECT_EQ(monitor_->log().find("security:"), std::string::npos);
  EXPECT_EQ(viewer_->status.back().samples_lost(), 0u);
  monitor_->signal(SIGTERM);
  EXPECT_EQ(monitor_->wait(seconds(10)), 0);
}

TEST_F(OutsiderTest, WithoutAnyIdentity) {
  start_all();
  expect_kept_out(options("stranger", ""));
}

TEST_F(OutsiderTest, WithAnIdentityOfAnotherAuthority) {
  start_all();
  expect_kept_out(options("impostor", identity_of_another_authority("sensor_source")));
}

TEST_F(OutsiderTest, WhoIsRevokedInFlightIsDroppedAtAReload) {
  const std::string name = "thief-" + std::to_string(getpid());
  make_identity({"--role", "sensor_source", "--name", name});
  monitor_ = start_monitor();
  simulator_ = start_simulator({"--dds-security", identity(name)});
  viewer_ = std::make_unique<Viewer>(options("viewer", identity("viewer")));
  ASSERT_TRUE(viewer_->await([&] { return viewer_->health.size() > 50; })) << monitor_->log();
  make_identity({"--revoke", name});
  EXPECT_TRUE(goes_on());  // nobody has looked yet
  monitor_->signal(SIGHUP);
  ASSERT_TRUE(viewer_->await([&] { return !viewer_->security_event("joining DDS anew with the new ones").empty(); }))
      << monitor_->log();
  EXPECT_TRUE(viewer_->await([&] { return !viewer_->security_event("has joined DDS anew").empty(); }));
  // The thief tries again and again; the monitor hears nothing of it.
  ASSERT_TRUE(viewer_->await([&] {
    return viewer_->status.back().level() == static_cast<std::uint32_t>(idl::StatusLevel::stale);
  })) << monitor_->log();
  viewer_->health.clear();
  EXPECT_TRUE(viewer_->await([&] {
    return !viewer_->security_event(name).empty() || !viewer_->security_event("engine_sim").empty();
  })) << monitor_->log();
  EXPECT_TRUE(viewer_->health.empty());
}

TEST_F(OutsiderTest, WithAnExpiredCertificate) {
  const std::string name = "short-" + std::to_string(getpid());
  make_identity({"--role", "sensor_source", "--name", name, "--valid-for", "4s"});
  // Valid when it joins, which is when its own DDS looks; expired when the monitor comes and looks.
  Outsider outsider(options("expired", identity(name)));
  const auto valid = [&] {
    try {
      idl::examine_identity(identity(name));
      return true;
    } catch (const idl::DdsError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr("the certificate has expired"));
      return false;
    }
  };
  while (valid()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  start_all();
  expect_kept_out(outsider, "expired");
  EXPECT_THROW(idl::Participant(options("late", identity(name))), idl::DdsError);
}

/// Who joins while somebody's handshake hangs. An impostor stands for it: each breaks the other's handshake off, which
/// looks the same.
class HangingHandshakeTest : public SecuredPair {
 protected:
  HangingHandshakeTest() { be_mute(); }
  void be_mute() {
    mute_.reset();
    mute_ = std::make_unique<idl::Participant>(options("mute", foreign_identity_));
  }
  idl::ParticipantOptions joining() {
    idl::ParticipantOptions o = options("joining", identity("viewer"));
    o.on_stranger = [this](const std::string& text) {
      if (text.find("joining anew") == std::string::npos) return;  // on the middleware's threads
      said_.push_back(text);
      if (leaves_) mute_.reset();
    };
    return o;
  }
  bool leaves_ = false;
  const std::string foreign_identity_ = identity_of_another_authority("viewer");
  std::unique_ptr<idl::Participant> mute_;
  std::vector<std::string> said_;
};

TEST_F(HangingHandshakeTest, IsEndedByJoiningAnewWithinFiveSeconds) {
  leaves_ = true;
  // Which of the two breaks off first is chance: where it is we, the impostor is turned away, and nothing hangs.
  for (int i = 0; i < 10 && said_.empty(); ++i) {
    if (i > 0) be_mute();
    const auto start = std::chrono::steady_clock::now();
    idl::Participant joins(joining());
    EXPECT_LT(std::chrono::steady_clock::now() - start, seconds(5));
  }
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_THAT(said_[0], testing::AllOf(testing::HasSubstr("participant 'mute' at UDPv4:["),
                                       testing::HasSubstr("has not proven who it is: joining anew")));
}

TEST_F(HangingHandshakeTest, OfAStrangerWhoStaysKeepsNobodyOut) {
  monitor_ = start_monitor();
  idl::Participant joins(joining());
  EXPECT_LE(said_.size(), 2u);  // the third time it stays
  idl::Reader<EngineHealth> reader(joins);
  for (int i = 0; i < 200 && reader.matched() == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(reader.matched(), 1);
}

TEST_F(OutsiderTest, WithARevokedCertificate) {
  const std::string name = "stolen-" + std::to_string(getpid());
  make_identity({"--role", "sensor_source", "--name", name});
  make_identity({"--revoke", name});
  start_all();
  // The thief's copy has no revocation list, so it joins in good faith.
  const std::string list = identity(name) + "/identity_crl.pem";
  ASSERT_EQ(unlink(list.c_str()), 0);
  expect_kept_out(options("thief", identity(name)));
}

}  // namespace
