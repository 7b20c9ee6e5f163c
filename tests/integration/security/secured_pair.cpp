// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/security/secured_pair.h"

#include <unistd.h>

#include <algorithm>
#include <fastdds/dds/core/condition/WaitSet.hpp>

namespace ehm::test {

namespace {

template <class T>
void take(idl::Reader<T>& reader, std::vector<T>& into) {
  T sample;
  while (reader.take(sample)) into.push_back(sample);
}

}  // namespace

Viewer::Viewer(const idl::ParticipantOptions& options)
    : participant_(options), health_(participant_), status_(participant_), events_(participant_) {}

bool Viewer::await(const std::function<bool()>& condition, seconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  eprosima::fastdds::dds::WaitSet wait_set;
  eprosima::fastdds::dds::ConditionSeq triggered;
  wait_set.attach_condition(health_.condition());
  wait_set.attach_condition(events_.condition());
  for (;;) {
    take(health_, health);
    take(status_, status);
    take(events_, events);
    if (condition()) return true;
    if (std::chrono::steady_clock::now() >= deadline) return false;
    wait_set.wait(triggered, eprosima::fastrtps::Duration_t(0.02L));
  }
}

std::string Viewer::security_event(const std::string& part) const {
  for (const auto& e : events)
    if (e.kind() == static_cast<std::uint32_t>(idl::EventKind::security) && e.engine_id() == 0 &&
        std::string(e.message().c_str()).find(part) != std::string::npos)
      return e.message().c_str();
  return {};
}

std::size_t Viewer::estimates(std::uint32_t engine_id) const {
  return static_cast<std::size_t>(
      std::count_if(health.begin(), health.end(), [&](const auto& h) { return h.engine_id() == engine_id; }));
}

SecuredPair::SecuredPair() : domain_(100 + static_cast<std::uint32_t>(getpid()) % 100) {}

std::string SecuredPair::identity(const std::string& role) {
  return EHM_SECURITY_DIR "/own/" + role;
}
std::string SecuredPair::identity_of_another_authority(const std::string& role) {
  return EHM_SECURITY_DIR "/other/" + role;
}

void SecuredPair::make_identity(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{EHM_SOURCE_DIR "/deploy/security/make_security.sh", "--out",
                                   EHM_SECURITY_DIR "/own"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  Process script(command);
  ASSERT_EQ(script.wait(seconds(20)), 0) << script.log();
}

idl::ParticipantOptions SecuredPair::options(const std::string& name, const std::string& identity) const {
  idl::ParticipantOptions o;
  o.domain = domain_;
  o.name = name;
  o.security = identity;
  return o;
}

std::unique_ptr<Process> SecuredPair::start_monitor(const std::string& name,
                                                    const std::vector<std::string>& flags) const {
  std::vector<std::string> arguments{
      EHM_MONITOR,    "--dds-domain",     std::to_string(domain_), "--dds-security",
      identity(name), "--monitor-design", EHM_DESIGN_FILE,         "--monitor-status-period-s",
      "0.2"};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  return std::make_unique<Process>(arguments);
}

std::unique_ptr<Process> SecuredPair::start_simulator(const std::vector<std::string>& flags) const {
  std::vector<std::string> arguments{EHM_ENGINE_SIM,
                                     "--dds-domain",
                                     std::to_string(domain_),
                                     "--dds-security",
                                     identity("sensor_source"),
                                     "--run-wait-for-monitors",
                                     "1"};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  return std::make_unique<Process>(arguments);
}

void SecuredPair::start_all() {
  viewer_ = std::make_unique<Viewer>(options("viewer", identity("viewer")));
  monitor_ = start_monitor();
  simulator_ = start_simulator();
  ASSERT_TRUE(viewer_->await([&] { return viewer_->estimates(1) > 10; })) << monitor_->log();
}

bool SecuredPair::goes_on(std::size_t more) {
  const std::size_t before = viewer_->estimates(1);
  return viewer_->await([&] { return viewer_->estimates(1) >= before + more; }) && (!monitor_ || monitor_->running()) &&
         simulator_->running();
}

}  // namespace ehm::test
