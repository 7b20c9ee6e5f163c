// SPDX-License-Identifier: Apache-2.0
// Prints every health estimate of the default domain, or of the domain given: a subscriber of your own in 40 lines.
#include <idl/dds/endpoint.h>
#include <idl/wire_values.h>

#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/core/condition/WaitSet.hpp>

int main(int argc, char** argv) {
  using namespace ehm;
  idl::ParticipantOptions options;
  options.domain = argc > 1 ? static_cast<std::uint32_t>(std::atoi(argv[1])) : 0;
  idl::Participant participant(options);
  idl::Reader<EngineDescription> descriptions(participant);
  idl::Reader<EngineHealth> estimates(participant);
  eprosima::fastdds::dds::WaitSet wait_set;
  wait_set.attach_condition(estimates.condition());

  EngineDescription description, heard;
  EngineHealth health;
  for (;;) {
    eprosima::fastdds::dds::ConditionSeq triggered;
    wait_set.wait(triggered, eprosima::fastrtps::Duration_t(1.0L));
    while (descriptions.take(heard))
      if (heard.role() == static_cast<std::uint32_t>(idl::DescriptionRole::monitor)) description = heard;
    while (estimates.take(health)) {
      if (description.health_count() == 0) continue;  // names and units are on their way
      std::printf("engine %u sample %llu:", health.engine_id(),
                  static_cast<unsigned long long>(health.sequence_number()));
      for (std::uint32_t i = 0; i < health.health_count(); ++i)
        std::printf(" %s %.4f +- %.4f", description.health()[i].name().c_str(), health.health()[i],
                    health.sigma_total()[i]);
      std::printf("\n");
      std::fflush(stdout);
    }
  }
}
