// SPDX-License-Identifier: Apache-2.0
// Partition and ownership: who hears whom, and what is said when QoS excludes.

#include <csignal>

#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class QosTest : public PairTest {};

TEST_F(QosTest, PartitionsDivideAFleet) {
  const auto monitor = start_monitor({"--dds-partition", "fleet/a"});
  idl::ParticipantOptions a = options(domain_), b = options(domain_);
  a.partition = "fleet/a";
  b.partition = "fleet/b";
  idl::Participant in_a(a), in_b(b);
  idl::Writer<EngineSensors> writer_a(in_a), writer_b(in_b);
  ASSERT_TRUE(listener_.await([&] { return writer_a.matched() == 1; }));
  EXPECT_EQ(writer_b.matched(), 0);  // discovered in the same breath, and not matched
}

TEST_F(QosTest, ExclusiveOwnershipMustBeAskedForAndIsReported) {
  const auto monitor = start_monitor({"--dds-ownership", "exclusive", "--dds-ownership-strength", "2"});
  idl::ParticipantOptions redundant = options(domain_);
  redundant.redundancy.exclusive = true;
  idl::Participant asks(redundant);
  idl::Reader<EngineHealth> reader(asks);
  ASSERT_TRUE(listener_.await([&] { return reader.matched() == 2; }));  // a writer for each rank
  // The listener of this fixture asks for shared ownership; the monitor says that it cannot be served.
  ASSERT_TRUE(listener_.await([&] {
    return monitor->log().find("exclude each other by QoS ownership") != std::string::npos;
  })) << monitor->log();
}

TEST_F(QosTest, APlainReaderHearsTheDefaultProfile) {
  const auto monitor = start_monitor();
  const auto simulator = start_simulator();
  EXPECT_TRUE(listener_.await([&] { return listener_.health.size() > 10; }));
  EXPECT_EQ(monitor->log().find("exclude"), std::string::npos);
}

}  // namespace
