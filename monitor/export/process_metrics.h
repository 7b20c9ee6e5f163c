// SPDX-License-Identifier: Apache-2.0
#pragma once
// Memory, descriptors and processor time of this process, under the names that Prometheus' client libraries share
// (process_resident_memory_bytes and so on). From /proc and getrusage; a metric that cannot be read is left out.

#include <prometheus/metric_family.h>

#include <vector>

namespace ehm::monitor {

std::vector<prometheus::MetricFamily> process_metrics();

}  // namespace ehm::monitor
