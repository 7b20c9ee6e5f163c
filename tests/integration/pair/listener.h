// SPDX-License-Identifier: Apache-2.0
#pragma once
// A subscriber of every topic of one domain, for tests: keeps what it heard and waits for conditions, never for time.

#include <chrono>
#include <deque>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "idl/dds/endpoint.h"
#include "idl/wire_values.h"

namespace ehm::test {

class Listener {
 public:
  explicit Listener(idl::Participant& participant);

  /// Takes what arrives until the condition holds; false when the limit passes first.
  bool await(const std::function<bool()>& condition, std::chrono::seconds limit = std::chrono::seconds(20));

  std::vector<EngineSensors> sensors;
  std::vector<EngineHealth> health;
  std::vector<EngineAuxiliary> auxiliary;
  std::vector<EngineResiduals> residuals;
  std::map<std::uint64_t, EngineTruth> truth;  ///< by sequence number
  std::vector<EngineDescription> descriptions;
  std::vector<MonitorStatus> status;
  std::vector<HealthEvent> events;

  int sources() const { return sensors_.matched(); }  ///< writers of EngineSensors that are known at present
  int monitors() const { return health_.matched(); }

  bool has_event(idl::EventKind kind, bool raised) const { return find_event(kind, raised) != nullptr; }
  const HealthEvent* find_event(idl::EventKind kind, bool raised) const;

 private:
  void take_all();
  idl::Reader<EngineSensors> sensors_;
  idl::Reader<EngineHealth> health_;
  idl::Reader<EngineAuxiliary> auxiliary_;
  idl::Reader<EngineResiduals> residuals_;
  idl::Reader<EngineTruth> truth_;
  idl::Reader<EngineDescription> descriptions_;
  idl::Reader<MonitorStatus> status_;
  idl::Reader<HealthEvent> events_;
  eprosima::fastdds::dds::WaitSet wait_set_;
};

}  // namespace ehm::test
