// SPDX-License-Identifier: Apache-2.0
#pragma once
// The two studies of the unscented filter after Endurthi's thesis, for people and for programs.

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "tuner_design/endurthi/pendulum_study.h"
#include "tuner_design/endurthi/ukf_turbofan.h"

namespace ehm::tuner_design {

void print_pendulum_study(const std::vector<endurthi::PendulumFilter>& study, std::ostream& out);
nlohmann::ordered_json pendulum_study_as_json(const std::vector<endurthi::PendulumFilter>& study);

void print_ukf_turbofan(const std::vector<endurthi::TurbofanPoint>& study, std::ostream& out);
nlohmann::ordered_json ukf_turbofan_as_json(const std::vector<endurthi::TurbofanPoint>& study);

}  // namespace ehm::tuner_design
