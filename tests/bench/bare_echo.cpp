// SPDX-License-Identifier: Apache-2.0
// bare_echo DOMAIN: answers every EngineSensors by an EngineHealth of the same sequence number and does nothing else.
// What a round trip over DDS costs without a monitor: same types, same QoS, same way of waiting (echo_bench.cpp).

#include <cstdlib>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <iostream>

#include "deploy/runtime/service/stop_signal.h"
#include "idl/dds/endpoint.h"

int main(int argc, char** argv) {
  using namespace ehm;
  if (argc != 2) {
    std::cerr << "usage: bare_echo DOMAIN\n";
    return 2;
  }
  const service::StopSignal stop;
  idl::ParticipantOptions options;
  options.domain = static_cast<std::uint32_t>(std::atoi(argv[1]));
  options.name = "bare echo";
  idl::Participant participant(options);
  idl::Reader<EngineSensors> sensors(participant);
  idl::Writer<EngineHealth> health(participant);
  eprosima::fastdds::dds::WaitSet wait_set;
  eprosima::fastdds::dds::ConditionSeq triggered;
  wait_set.attach_condition(sensors.condition());
  EngineSensors sample;
  EngineHealth answer;
  while (!stop.requested()) {
    wait_set.wait(triggered, eprosima::fastrtps::Duration_t(0.015L));
    while (sensors.take(sample)) {
      answer.engine_id(sample.engine_id());
      answer.sequence_number(sample.sequence_number());
      health.write(answer);
    }
  }
}
