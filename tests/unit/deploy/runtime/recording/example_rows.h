// SPDX-License-Identifier: Apache-2.0
#pragma once
// A small recording for tests.

#include "deploy/runtime/recording/writer.h"

namespace ehm::test {

inline recording::FileInfo example_info() {
  recording::FileInfo info;
  info.recording_id = 1234567890123456789;
  info.monitor_source_id = 101;
  info.sample_time_s = 0.015;
  info.created_by = "test";
  info.channels = {{{"fuel_flow", "kg/s"}},
                   {{"Nf", "rpm"}, {"T24", "K"}},
                   {{"thrust", "N"}},
                   {{"fan_efficiency", "fraction"}, {"fan_flow", "fraction"}, {"hpc_flow", "fraction"}}};
  return info;
}

/// Row k of engine 7; every recorded value tells where it belongs.
inline recording::Row example_row(std::int64_t k) {
  recording::Row row;
  const auto x = static_cast<double>(k);
  row.a.unit = 7;
  row.a.sequence = k;
  row.a.estimates = 1;
  row.w = {x + 0.1, x + 0.2, x + 0.3, x + 0.4};
  row.x_s = {x + 1.1, x + 1.2};
  row.innovation = {x + 2.1, x + 2.2};
  row.x_v = {x + 3.1};
  row.x_v_sigma = {x + 4.1};
  row.x_v_sigma_filter = {x + 5.1};
  row.t = {x + 6.1, x + 6.2, x + 6.3};
  row.t_sigma = {x + 7.1, x + 7.2, x + 7.3};
  row.t_sigma_filter = {x + 8.1, x + 8.2, x + 8.3};
  return row;
}

}  // namespace ehm::test
