// SPDX-License-Identifier: Apache-2.0
#pragma once
// Every estimator of the monitor, side by side on the same samples of the same engines, in every case of the papers:
//   constant       an engine of the fleet at the design's point, nothing else
//   missing        the same without its fourth sensor
//   noise x 3      the same, the sensors three times as noisy as everybody thinks
//   rapid fault    at 20 s one health parameter steps by -2 %, by turns down the list
//   gradual wear   from 10 s on every parameter wears by 1 % a minute
//   slam           at 25 s the fan is to turn 8 % slower, at 30 s as before, and is judged from 8 s after that
//   fifty flights  thirty samples of each, one in 0.105 s, state and covariance carried on; the engine wears by the law
//                  of the studies (wear/wear_law.h), 12 cycles a flight, and who knows of flights is told of 0.05 %
//                  a flight
//   whole flight   taxi to taxi, two hours, samples of 0.1 s, for a fifth of the engines: of those that fly an engine,
//                  but the particle filters, which would take hours
// The truth is the engine file, without a mismatch of build or instruments, with heat soak: what the filters of the
// papers take for granted (`study flight` asks the other question). Judged over the last 2 s of 40, at a step from 10 s
// after, at the end of each of fifty flights after the tenth, in a whole flight every 20 s from take-off to landing; an
// estimate that does not hold, or whose model does not hold there (distance above 1), is in no figure but `held`.
//   SSEE      sum over health of squared errors, percent^2, mean; claims: the same of sigma^2
//   coverage  share of health estimates whose truth lies within 1.96 sigma: of all parameters, and of the
//             one that is covered least
//   bias      root mean square over the parameters of the mean error over the fleet, percent
//   answer    median time after the step until half of it is seen, in the parameter that stepped; s
//   step      what a sample costs, us, of one core that others may use too; it stands in the page (--html) alone
// Errors: @throws std::invalid_argument if design and engine do not belong together; an estimator that the design has
// not what it needs for is left out and named; a flight that ends is counted.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine_sim/engines/engine_definition.h"
#include "monitor/data/options.h"
#include "monitor/design/design.h"

namespace ehm::tuner_design {

inline constexpr std::array<const char*, 8> family_case_names{
    "constant", "missing", "noise x 3", "rapid fault", "gradual wear", "slam", "fifty flights", "whole flight"};
enum class FamilyCase { constant, missing, noise, rapid, gradual, slam, batches, flight };

struct FamilyOptions {
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
  monitor::EstimatorOptions estimator;
  std::vector<std::string> estimators;  ///< those alone, of the table; empty: all
  std::size_t engines = 20;
  std::vector<FamilyCase> cases{FamilyCase::constant, FamilyCase::missing, FamilyCase::noise,   FamilyCase::rapid,
                                FamilyCase::gradual,  FamilyCase::slam,    FamilyCase::batches, FamilyCase::flight};
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// One estimator in one case, over the fleet.
struct FamilyScore {
  double held = 0.0;  ///< share of the samples judged
  double ssee = 0.0, claims = 0.0, coverage = 0.0, bias = 0.0;
  double least_coverage = 0.0;  ///< of the parameter that is covered least
  std::optional<double> answer_s;
  double step_us = 0.0;  ///< least of the engines' medians: of the clock, no part of what is printed
};

struct FamilyCaseResult {
  FamilyCase what;
  std::size_t flown = 0, failed = 0;
  std::vector<std::optional<FamilyScore>> scores;  ///< by estimator; none: it has no part in this case, or no answer
};

struct FamilyStudy {
  FamilyOptions options;
  std::string design_name;
  std::vector<std::string> estimators, left_out;
  double limit = 0.0;  ///< SSEE that no linear estimator passes, constant health, so many samples; percent^2
  std::vector<FamilyCaseResult> cases;
};

FamilyStudy run_family_study(
    const design::Design& design, const FamilyOptions& options,
    const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design
