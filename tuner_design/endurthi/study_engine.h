// SPDX-License-Identifier: Apache-2.0
#pragma once
// The engine of the studies after Endurthi's thesis, in place of its MAPSS: any engine of ours with the thesis' sensors,
// controls and health parameters.
//   states    N1, N2, metal temperature of the LPT's blades and discs: the lump behind the LPT with a third of its heat
//             capacity, which follows in some 10 s; the other two lumps take no heat
//   sensors   P50 T50 Nf T24 T30 P13 P21 P24 Ps30 Nc Tm_lpt, sigma = trim/100 .. trim/200, /70 for the metal
//   controls  fuel flow, stator vanes off their schedule (in place of the rear bypass door), core nozzle area
//   health    flow and efficiency of fan, LPC, HPC, HPT, and efficiency of the LPT: the thesis' numbers 1 to 8 and 10. Its
//             number 4 is unobservable through a defect of MAPSS; here it is number 9, LPT flow, for nothing is
//             measured between the turbines: four parameters and three equations. It is left out and does not wear.
// In our engine core and bypass leave the fan in one state: P13 and P21 are one quantity with two noises.
// The bleed valves behind the LPC stay shut: they are none of the three controls.
// Points: near idle at sea level; part power at Mach 0.8 and 35 000 ft. Both run by the engine's own control at a fan
// speed. Units: those of channel_table.h. Errors: those of the engine.

#include <memory>
#include <string>
#include <vector>

#include "engine_sim/control/scheduled_point.h"
#include "engine_sim/engines/engine_definition.h"
#include "tuner_design/linearise/engine_channels.h"

namespace ehm::tuner_design::endurthi {

struct StudyEngine {
  explicit StudyEngine(const engine_sim::EngineDefinition& base);

  EngineLayout layout;  ///< with all three metal temperatures
  engine_sim::Turbofan turbofan;

  const engine_sim::ControlData& control() const { return layout.engine->control; }
};

/// The engine at one operating point.
struct StudyPoint {
  std::string name;
  std::shared_ptr<const StudyEngine> engine;
  engine_sim::FlightCondition flight;
  double n1_rpm;  ///< demanded
  engine_sim::SteadyPoint trim;
  Plant plant;                  ///< states N1, N2, metal of the LPT
  Eigen::VectorXd noise_sigma;  ///< m, of one sample

  Eigen::Index sensors() const { return plant.outputs() - plant.states; }
  Eigen::VectorXd sensor_trim() const { return plant.f0.tail(sensors()); }
  Eigen::VectorXd control_trim() const { return plant.v0.segment(plant.first_control(), plant.controls); }
  /// Of the plant's health parameters.
  std::vector<std::string> health_names() const;
  engine_sim::HealthVector health_of(const Eigen::VectorXd& h) const;
  /// The same with its trim where the control holds an engine with this health at the demanded fan speed. The noise
  /// stays that of the new engine.
  StudyPoint worn(const Eigen::VectorXd& h) const;
};

/// The two points, the thesis' first and second. @throws engine_sim::SolveError if the engine does not run there
std::vector<StudyPoint> study_points(const engine_sim::EngineDefinition& base);

}  // namespace ehm::tuner_design::endurthi
