// SPDX-License-Identifier: Apache-2.0
#pragma once
// The pair under test, engine_sim and monitor, on a domain of the test's own, with a listener beside it.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/integration/pair/listener.h"
#include "tests/integration/pair/process.h"

namespace ehm::test {

using std::chrono::seconds;

class PairTest : public testing::Test {
 protected:
  PairTest();

  /// Starts the monitor with the cruise design; more flags as given.
  std::unique_ptr<Process> start_monitor(const std::vector<std::string>& flags = {});
  /// Starts the simulator on the demo's scenario file, or another; it waits for the monitor and for our listener.
  std::unique_ptr<Process> start_simulator(const std::vector<std::string>& flags = {},
                                           const std::string& scenario = "");
  static std::string monitor_program();
  static std::string simulator_program();
  static std::string design_file();
  /// Writes a file that is gone with the test.
  std::string file(const std::string& name, const std::string& text) const;
  static idl::ParticipantOptions options(std::uint32_t domain);

  std::uint32_t domain_;
  idl::Participant participant_;
  Listener listener_;
};

}  // namespace ehm::test
