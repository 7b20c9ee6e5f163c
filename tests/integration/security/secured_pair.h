// SPDX-License-Identifier: Apache-2.0
#pragma once
// The pair on a secured domain of the test's own, and a viewer beside it that hears what the monitor publishes.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "idl/dds/endpoint.h"
#include "idl/wire_values.h"
#include "tests/integration/pair/process.h"

namespace ehm::test {

using std::chrono::seconds;

/// What a viewer may read.
class Viewer {
 public:
  explicit Viewer(const idl::ParticipantOptions& options);
  /// Takes what arrives until the condition holds; false when the limit passes first.
  bool await(const std::function<bool()>& condition, seconds limit = seconds(20));
  /// Message of the first security event with `part` in it; nothing if there is none.
  std::string security_event(const std::string& part) const;
  /// Estimates of one engine.
  std::size_t estimates(std::uint32_t engine_id) const;
  /// Writers of estimates whose keys have been exchanged.
  int matched() const { return health_.matched(); }

  std::vector<EngineHealth> health;
  std::vector<MonitorStatus> status;
  std::vector<HealthEvent> events;

 private:
  idl::Participant participant_;
  idl::Reader<EngineHealth> health_;
  idl::Reader<MonitorStatus> status_;
  idl::Reader<HealthEvent> events_;
};

class SecuredPair : public testing::Test {
 protected:
  SecuredPair();
  /// Certificates and permissions of a role, made by make_security.sh before the tests.
  static std::string identity(const std::string& role);
  static std::string identity_of_another_authority(const std::string& role);
  /// Runs make_security.sh on the tests' own authority; fails the test if it fails.
  static void make_identity(const std::vector<std::string>& arguments);
  /// A participant with that identity; without one if it is empty.
  idl::ParticipantOptions options(const std::string& name, const std::string& identity) const;
  std::unique_ptr<Process> start_monitor(const std::string& name = "monitor",
                                         const std::vector<std::string>& flags = {}) const;
  /// Flies at once; engine and source id as given.
  std::unique_ptr<Process> start_simulator(const std::vector<std::string>& flags = {}) const;
  /// Monitor, simulator and viewer, until estimates flow.
  void start_all();
  /// Estimates go on: so many more arrive.
  bool goes_on(std::size_t more = 30);

  std::uint32_t domain_;
  std::unique_ptr<Process> monitor_, simulator_;
  std::unique_ptr<Viewer> viewer_;
};

}  // namespace ehm::test
