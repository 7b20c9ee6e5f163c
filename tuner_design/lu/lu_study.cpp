// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/lu/lu_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "deploy/runtime/long_work/parallel_for.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

using Cases = std::vector<LuCase>;

LuCase of(LuFlight flight, std::string what = {}) {
  LuCase out;
  out.flight = flight;
  out.what = std::move(what);
  return out;
}

std::string fault_name(int fault) {
  return fault == 0 ? "gradual" : "fault " + std::to_string(fault);
}

std::string noise_name(NoiseDistribution noise) {
  return noise == NoiseDistribution::gaussian           ? "Gaussian"
         : noise == NoiseDistribution::rayleigh_shifted ? "Rayleigh of mean 0"
                                                        : "Rayleigh as it comes";
}

/// Every filter of `filters` on both faults.
Cases faults(const LuOptions& options, NoiseDistribution noise, const std::vector<LuFilter>& filters) {
  Cases cases;
  for (const int fault : {1, 2})
    for (const LuFilter filter : filters)
      cases.push_back(of({.filter = filter, .fault = fault, .noise = noise, .particles = options.particles},
                         fault_name(fault) + ", " + noise_name(noise)));
  return cases;
}

void append(Cases& cases, Cases more) {
  cases.insert(cases.end(), more.begin(), more.end());
}

const std::vector<LuFilter> all_filters{LuFilter::extended, LuFilter::unscented, LuFilter::particle,
                                        LuFilter::extended_particle, LuFilter::boxed_particle};

Cases of_noises(const LuOptions& options, const std::vector<NoiseDistribution>& noises) {
  Cases cases;
  for (const NoiseDistribution noise : noises) append(cases, faults(options, noise, all_filters));
  for (const int fault : {1, 2})
    cases.push_back(of(
        {.filter = LuFilter::extended_particle, .fault = fault, .particles = options.particles, .ratio_weights = true},
        fault_name(fault) + ", Gaussian, weights by the ratio"));
  return cases;
}

Cases gradual(const LuOptions& options) {
  Cases cases;
  for (const NoiseDistribution noise :
       {NoiseDistribution::gaussian, NoiseDistribution::rayleigh_shifted, NoiseDistribution::rayleigh})
    for (const LuFilter filter : all_filters)
      cases.push_back(
          of({.filter = filter, .fault = 0, .noise = noise, .particles = options.particles}, noise_name(noise)));
  return cases;
}

Cases cost(const LuOptions& options) {
  Cases cases = faults(options, NoiseDistribution::gaussian, all_filters);
  for (const int fault : {1, 2})
    cases.push_back(
        of({.filter = LuFilter::boxed_particle, .fault = fault, .particles = options.particles, .own_jacobian = true},
           fault_name(fault) + ", each its own Jacobian"));
  return cases;
}

Cases missing(const LuOptions& options) {
  Cases cases;
  for (std::size_t sensor = 0; sensor < lu_sensor_count; ++sensor)
    for (const LuFilter filter : {LuFilter::extended, LuFilter::extended_particle, LuFilter::boxed_particle})
      cases.push_back(of({.filter = filter, .particles = options.particles, .missing_sensor = sensor},
                         std::string("without ") + lu_sensor_names[sensor]));
  return cases;
}

Cases particles() {
  Cases cases;
  for (const int fault : {1, 2})
    for (const Eigen::Index count : {30, 50, 100})
      cases.push_back(of({.filter = LuFilter::boxed_particle, .fault = fault, .particles = count},
                         fault_name(fault) + ", N = " + std::to_string(count)));
  return cases;
}

Cases cases_of(const LuOptions& options) {
  switch (options.table) {
    case 4:
      return of_noises(options, {NoiseDistribution::gaussian});
    case 5:
      return of_noises(options, {NoiseDistribution::rayleigh_shifted, NoiseDistribution::rayleigh});
    case 6:
      return gradual(options);
    case 7:
      return cost(options);
    case 8:
      return missing(options);
    default:
      return particles();
  }
}

void sum_up(const std::vector<LuScore>& scores, LuCase& out) {
  std::vector<double> sme;
  for (const LuScore& score : scores) {
    if (score.diverged) {
      ++out.diverged;
      continue;
    }
    out.mean_rms += score.mean.cwiseAbs2();
    out.sigma_rms += score.sigma.cwiseAbs2();
    sme.push_back(score.sme);
  }
  out.seconds = std::numeric_limits<double>::infinity();
  for (const LuScore& score : scores) out.seconds = std::min(out.seconds, score.filter_s_per_s);
  out.first_estimates = scores.front().estimates;
  if (sme.empty()) return;
  const auto count = static_cast<double>(sme.size());
  out.mean_rms = (out.mean_rms / count).cwiseSqrt();
  out.sigma_rms = (out.sigma_rms / count).cwiseSqrt();
  for (const double value : sme) out.sme += value / count;
  for (const double value : sme) out.sme_spread += (value - out.sme) * (value - out.sme) / count;
  out.sme_spread = std::sqrt(out.sme_spread);
}

}  // namespace

LuStudy run_lu_study(const LuOptions& options, const std::function<void(double)>& progress) {
  const LuEngine engine = lu_engine(*options.engine);
  LuStudy study{options, engine.trim.operation.fuel_flow_kg_s, cases_of(options)};
  const std::size_t count = study.cases.size() * options.runs;
  std::vector<LuScore> scores(count);
  // a cost is that of a core which nobody shares
  const unsigned threads = options.table == 7 ? 1 : options.threads;
  long_work::parallel_for(
      count, threads,
      [&](std::size_t i) {
        LuFlight flight = study.cases[i / options.runs].flight;
        flight.seed = options.seed;
        flight.run = i % options.runs;
        scores[i] = fly_lu(engine, flight);
        if (flight.run != 0) scores[i].estimates.clear();
      },
      [&](std::size_t done) { progress(static_cast<double>(done) / static_cast<double>(count)); });
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const auto first = scores.begin() + static_cast<std::ptrdiff_t>(i * options.runs);
    sum_up({first, first + static_cast<std::ptrdiff_t>(options.runs)}, study.cases[i]);
  }
  return study;
}

}  // namespace ehm::tuner_design
