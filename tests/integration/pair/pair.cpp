// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/pair/pair.h"

#include <unistd.h>

#include <fstream>

namespace ehm::test {

namespace {

/// Tests run one at a time; the process number keeps a domain apart from what another run may have left.
std::uint32_t own_domain() {
  return 100 + static_cast<std::uint32_t>(getpid()) % 100;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

idl::ParticipantOptions PairTest::options(std::uint32_t domain) {
  idl::ParticipantOptions o;
  o.domain = domain;
  o.name = "test";
  return o;
}

PairTest::PairTest() : domain_(own_domain()), participant_(options(domain_)), listener_(participant_) {}

std::string PairTest::monitor_program() {
  return EHM_MONITOR;
}
std::string PairTest::simulator_program() {
  return EHM_ENGINE_SIM;
}
std::string PairTest::design_file() {
  return EHM_DESIGN_FILE;
}

std::unique_ptr<Process> PairTest::start_monitor(const std::vector<std::string>& flags) {
  std::vector<std::string> arguments{monitor_program(), "--dds-domain", std::to_string(domain_), "--monitor-design",
                                     design_file()};
  append(arguments, flags);
  return std::make_unique<Process>(arguments);
}

std::unique_ptr<Process> PairTest::start_simulator(const std::vector<std::string>& flags, const std::string& scenario) {
  std::vector<std::string> arguments{simulator_program(),
                                     "--config",
                                     scenario.empty() ? EHM_SOURCE_DIR "/deploy/demo/engine_sim.toml" : scenario,
                                     "--dds-domain",
                                     std::to_string(domain_),
                                     "--run-wait-for-monitors",
                                     "2"};  // the monitor and the listener
  append(arguments, flags);
  return std::make_unique<Process>(arguments);
}

std::string PairTest::file(const std::string& name, const std::string& text) const {
  const std::string path = testing::TempDir() + "ehm-" + std::to_string(getpid()) + "-" + name;
  std::ofstream(path) << text;
  return path;
}

}  // namespace ehm::test
