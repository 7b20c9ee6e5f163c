// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/faults/fault_case.h"

namespace ehm::tuner_design {

const std::vector<FaultRow>& fault_table() {
  static const std::vector<FaultRow> table{
      {"bias +5 sigma", Broken::bias, 5.0, true, 8.0, 1, 5.0},
      {"bias -5 sigma", Broken::bias, -5.0, true, 8.0, 1, 5.0},
      {"bias +10 sigma", Broken::bias, 10.0, true, 8.0, 1, 5.0},
      {"bias -10 sigma", Broken::bias, -10.0, true, 8.0, 1, 5.0},
      {"stuck", Broken::stuck, 0.0, true, 8.0, 1, 10.0},
      {"drift 10 sigma/min", Broken::drift, 10.0, false, 70.0, 1, 20.0},
      {"noise x 4", Broken::noise, 4.0, true, 8.0, 1, 10.0},
      {"dropout", Broken::dropout, 0.0, true, 8.0, 1, 50.0},
      {"component -2 %", Broken::component, -0.02, true, 10.0, 1, 5.0},
      {"nothing", Broken::nothing, 0.0, false, 10.0, 14, 0.0},
  };
  return table;
}

std::vector<FaultCase> round_of_cases(std::size_t sensors, std::size_t health) {
  std::vector<FaultCase> cases;
  for (const FaultRow& row : fault_table()) {
    const std::size_t channels = row.broken == Broken::nothing ? 1 : row.broken == Broken::component ? health : sensors;
    for (std::size_t channel = 0; channel < channels; ++channel)
      for (std::size_t i = 0; i < row.repeated; ++i) cases.push_back({&row, channel});
  }
  return cases;
}

}  // namespace ehm::tuner_design
