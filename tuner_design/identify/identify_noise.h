// SPDX-License-Identifier: Apache-2.0
#pragma once
// The noise of the sensors, R, and of the engine's own motion, Q, from a recording of its flight at one point.
//
//   x[k+1] = A x + B u + L h + w      h[k+1] = h + g      y[k] = C x + D u + M h + v
//
// R = cov(v) diagonal, one variance a sensor; Q = cov(w), one variance a state (noise_spectra.h says which);
// Qh = cov(g) diagonal, the walk of health, percent^2 a sample: once with one variance for all parameters, which is
// what `design --qh` takes, and once with one each. All are found at once by whittle_fit.h from what the model does not
// explain of the steady parts of the record. No filter is flown, and walks of more parameters than there are sensors
// can be told: m sensors have m (m + 1) / 2 covariances.
//
// A variance is told if its standard error is at most half of it; then its 95 % interval is that of a chi-square with
// nu = 2 (variance / standard error)^2 degrees of freedom. Else only the upper end is stated (upper_end, 1.645 sigma).
// What cannot be told apart shows there: its standard error is large, and its correlation with another's is near -1.
// Units: percent of trim and percent of health, squared, per sample (scaling.h).
//
// Where the walks differ at one per cent, R and Q are of the fit with one walk each, else of that with a common one.
//
// @throws std::invalid_argument if fewer than 2000 samples are steady (says what the others are), if a sensor reads one
//         value throughout, or if no sensor sees health.

#include <array>
#include <optional>

#include "engine_sim/linear_model/scaling.h"
#include "tuner_design/identify/noise_checks.h"
#include "tuner_design/identify/steady_segments.h"

namespace ehm::tuner_design {

struct IdentifiedVariance {
  double value = 0.0, standard_error = 0.0;
  double low = 0.0, high = 0.0;  ///< 95 %; not told: 0 and the upper end
  bool told = false;
};

struct IdentifiedWalk {
  IdentifiedVariance variance;
  bool seen = false;         ///< by any sensor that is used
  int alike = -1;            ///< the health parameter with which it is most easily confused
  double correlation = 0.0;  ///< of the errors of the two variances
};

struct IdentifiedNoise {
  linear_model::LinearModel model;  ///< discrete, channel units
  linear_model::Scaling scaling;
  SteadySelection selection;
  Eigen::Index mended = 0;                                 ///< samples (short_holes.h)
  std::vector<std::optional<IdentifiedVariance>> sensors;  ///< R; empty where a sensor is not used
  std::vector<NoiseTerm> motion_terms;
  std::vector<IdentifiedVariance> motion;  ///< Q of each; of channel -1 a factor on the model's Q
  IdentifiedVariance walk;                 ///< Qh, one for all health parameters
  std::vector<IdentifiedWalk> walks;       ///< Qh of each
  double condition = 0.0;                  ///< of the information on the walks, each scaled to itself: 1 is perfect
  bool walks_differ = false;               ///< at one per cent
  std::vector<NoiseCheck> checks;          ///< correlations and colours that stand out, by sensor of the model
  std::array<double, 2> range_rad = {};    ///< slow below the first, fast above the second, per sample
  std::array<PowerRatio, 3> fit;           ///< slow, about the engine's time constants, fast; by used sensor
  double lowest_rad = 0.0;                 ///< the slowest motion that was looked at, per sample
};

/// `model` as it is in a file, with the record's channels.
IdentifiedNoise identify_noise(RecordedSamples record, const linear_model::LinearModel& model,
                               const monitor::ValidityOptions& validity);

/// `model`, as it was given to identify_noise, with what was told in the place of its own noise. Of what is not
/// told it keeps its own, or takes the upper end where that is less.
linear_model::LinearModel with_identified_noise(const linear_model::LinearModel& model, const IdentifiedNoise& noise);

}  // namespace ehm::tuner_design
