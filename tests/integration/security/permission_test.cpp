// SPDX-License-Identifier: Apache-2.0
// Who has an identity may do what its role allows, and nothing else. This program's own DDS does not ask for permission
// (hostile_stack.cpp), so what is refused here is refused by the services.

#include <gmock/gmock.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/integration/security/secured_pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class PermissionTest : public SecuredPair {};

EngineSensors sensors_of(std::uint32_t engine_id) {
  EngineSensors sample;
  sample.engine_id(engine_id);
  sample.schema(idl::schema_version);
  sample.source_id(66);
  sample.sensor_count(7);
  sample.actuator_count(5);
  return sample;
}

MonitorCommand reset_all() {
  MonitorCommand command;
  command.schema(idl::schema_version);
  command.kind(static_cast<std::uint32_t>(idl::MonitorCommandKind::reset));
  return command;
}

TEST_F(PermissionTest, AnHonestStackSaysAtOnceWhatIsNotAllowed) {
  Process source({EHM_ENGINE_SIM, "--dds-domain", std::to_string(domain_), "--dds-security", identity("viewer")});
  EXPECT_EQ(source.wait(seconds(20)), 1);
  EXPECT_THAT(source.log(), testing::HasSubstr("no DDS writer on topic 'EngineSensors': the permissions in"));
}

TEST_F(PermissionTest, NobodyRunsOnWithoutTheFilesThatWereAskedFor) {
  const std::string domain = std::to_string(domain_);
  Process source({EHM_ENGINE_SIM, "--dds-domain", domain, "--dds-security", "/nowhere"});
  EXPECT_EQ(source.wait(seconds(20)), 2);
  EXPECT_THAT(source.log(), testing::HasSubstr("security file /nowhere/identity_ca.pem: no such file"));
  // The key of one identity beside the certificate of another.
  const std::string mixed = testing::TempDir() + "ehm-mixed-" + std::to_string(getpid());
  std::filesystem::copy(identity("monitor"), mixed);
  std::filesystem::copy_file(identity("viewer") + "/key.pem", mixed + "/key.pem",
                             std::filesystem::copy_options::overwrite_existing);
  Process monitor({EHM_MONITOR, "--dds-domain", domain, "--dds-security", mixed, "--monitor-design", EHM_DESIGN_FILE});
  EXPECT_EQ(monitor.wait(seconds(20)), 2);
  EXPECT_THAT(monitor.log(), testing::HasSubstr(mixed + "/key.pem: is not the key of cert.pem beside it"));

  // Each other file, spoilt: found by --check-config, by name.
  const auto refused = [&](const std::string& file, const std::string& content, const std::string& why) {
    std::filesystem::remove_all(mixed);
    std::filesystem::copy(identity("monitor"), mixed);
    std::ofstream(mixed + file) << content;
    Process check({EHM_MONITOR, "--dds-security", mixed, "--monitor-design", EHM_DESIGN_FILE, "--check-config"});
    EXPECT_EQ(check.wait(seconds(20)), 2) << file;
    EXPECT_THAT(check.log(), testing::HasSubstr(mixed + file + ": " + why));
  };
  refused("/cert.pem", "no certificate", "is not an X.509 certificate in PEM");
  refused("/identity_ca.pem", "", "is empty");
  refused("/permissions_ca.pem", "no certificate", "is not an X.509 certificate in PEM");
  refused("/key.pem", "no key", "is not a private key in PEM");
  refused("/governance.p7s", "no document", "is not a signed document (S/MIME)");
  refused("/identity_crl.pem", "no list", "is not a list of revoked certificates in PEM");
  std::string permissions;
  std::getline(std::ifstream(identity("monitor") + "/permissions.p7s"), permissions, '\0');
  ASSERT_NE(permissions.find("EngineHealth"), std::string::npos);
  permissions.replace(permissions.find("EngineHealth"), 12, "EngineWealth");
  refused("/permissions.p7s", permissions, "was not signed by permissions_ca.pem beside it, or was changed since");
  Process unsecured({EHM_MONITOR, "--monitor-design", EHM_DESIGN_FILE, "--dds-security-required", "true"});
  EXPECT_EQ(unsecured.wait(seconds(20)), 2);
  EXPECT_THAT(unsecured.log(), testing::HasSubstr("'dds.security_required' is true, but 'dds.security' names no"));
  std::filesystem::remove_all(mixed);
}

// A role that was taken away: what was signed for the earlier key of this name is worthless beside the new one.
TEST_F(PermissionTest, ThoseOfAnEarlierKeyOfTheSameNameAreRefused) {
  const std::string name = "changed-" + std::to_string(getpid());
  const TemporaryFolder kept;
  const std::string permissions = kept.path("permissions.p7s");
  make_identity({"--role", "sensor_source", "--name", name});
  std::filesystem::copy_file(identity(name) + "/permissions.p7s", permissions);
  make_identity({"--role", "viewer", "--name", name, "--renew"});
  const std::string mixed = kept.path("mixed");
  std::filesystem::copy(identity(name), mixed);
  std::filesystem::copy_file(permissions, mixed + "/permissions.p7s",
                             std::filesystem::copy_options::overwrite_existing);
  Process source({EHM_ENGINE_SIM, "--dds-domain", std::to_string(domain_), "--dds-security", mixed});
  EXPECT_EQ(source.wait(seconds(20)), 1);
  EXPECT_THAT(source.log(), testing::HasSubstr("the security files in '" + mixed + "' are refused"));
}

TEST_F(PermissionTest, AViewerMayNotPublishSensors) {
  start_all();
  idl::Participant participant(options("viewer that lies", identity("viewer")));
  idl::Writer<EngineSensors> writer(participant);
  EXPECT_TRUE(viewer_->await([&] {
    writer.write(sensors_of(2));
    return !viewer_->security_event("EngineSensors topic not found in allow rule").empty();
  })) << monitor_->log();
  EXPECT_TRUE(goes_on());
  EXPECT_EQ(viewer_->status.back().unknown_engine_samples() + viewer_->status.back().samples_foreign(), 0u);
  EXPECT_EQ(viewer_->estimates(2), 0u);
  for (const auto& status : viewer_->status) EXPECT_EQ(status.engine_id(), 1u) << "an engine that only the liar flies";
}

TEST_F(PermissionTest, AViewerMayNotCommandAndAnOperatorMay) {
  start_all();
  const auto restarts = [&] { return viewer_->status.back().filter_restarts(); };
  {
    idl::Participant participant(options("viewer that commands", identity("viewer")));
    idl::Writer<MonitorCommand> writer(participant);
    idl::Writer<SimCommand> sim_writer(participant);
    EXPECT_TRUE(viewer_->await([&] {
      writer.write(reset_all());
      return !viewer_->security_event("MonitorCommand topic not found in allow rule").empty();
    })) << monitor_->log();
    EXPECT_TRUE(viewer_->await([&] {
      return simulator_->log().find("SimCommand topic not found in allow rule") != std::string::npos;
    })) << simulator_->log();
    EXPECT_TRUE(goes_on());
    EXPECT_EQ(restarts(), 0u);
  }
  idl::Participant participant(options("operator", identity("operator")));
  idl::Writer<MonitorCommand> writer(participant);
  EXPECT_TRUE(viewer_->await([&] { return writer.matched() == 1; }));
  // Matched here is not yet matched there, so the order is repeated until it is obeyed.
  EXPECT_TRUE(viewer_->await([&] {
    writer.write(reset_all());
    return restarts() > 0;
  })) << "the operator's reset must be obeyed, or this test could not have seen the viewer's";
}

TEST_F(PermissionTest, ASensorSourceMayNotPublishEstimates) {
  start_all();
  idl::Participant participant(options("source that estimates", identity("sensor_source")));
  idl::Writer<EngineHealth> writer(participant);
  EngineHealth estimate;
  estimate.engine_id(3);
  estimate.schema(idl::schema_version);
  // The viewer of this test refuses it in the same breath in which it learns of the writer.
  idl::Writer<EngineSensors> allowed(participant);
  EXPECT_TRUE(viewer_->await([&] { return allowed.matched() == 1; }));
  const std::size_t before = viewer_->estimates(1);
  EXPECT_TRUE(viewer_->await([&] {
    writer.write(estimate);
    return viewer_->estimates(1) >= before + 200;
  }));
  EXPECT_EQ(viewer_->estimates(3), 0u);
}

TEST_F(PermissionTest, AViewerCannotReadSensors) {
  start_all();
  idl::Participant participant(options("viewer that listens", identity("viewer")));
  idl::Reader<EngineSensors> reader(participant);
  EXPECT_TRUE(viewer_->await([&] {
    return simulator_->log().find("EngineSensors topic not found in allow rule") != std::string::npos;
  })) << simulator_->log();
  EXPECT_TRUE(goes_on());
  EngineSensors sample;
  EXPECT_FALSE(reader.take(sample));
}

}  // namespace
