#include "engine_sim/control/fuel_governor.h"

#include <algorithm>

namespace ehm::engine {

FuelGovernor::FuelGovernor(const GovernorOptions& options, double n1_rpm, double fuel_flow_kg_s)
    : options_(options), n1_scale_rpm_(n1_rpm), fuel_scale_kg_s_(fuel_flow_kg_s), fuel_flow_kg_s_(fuel_flow_kg_s) {}

double FuelGovernor::update(double n1_demand_rpm, double n1_rpm, double dt_s) {
  const double error = (n1_demand_rpm - n1_rpm) / n1_scale_rpm_;
  const double wanted =
      fuel_scale_kg_s_ * (options_.proportional * (error - last_error_) + options_.integral_per_s * error * dt_s);
  last_error_ = error;
  const double slew = options_.slew_per_s * fuel_scale_kg_s_ * dt_s;
  fuel_flow_kg_s_ =
      std::clamp(fuel_flow_kg_s_ + std::clamp(wanted, -slew, slew), options_.fuel_min_of_trim * fuel_scale_kg_s_,
                 options_.fuel_max_of_trim * fuel_scale_kg_s_);
  return fuel_flow_kg_s_;
}

}  // namespace ehm::engine
