// SPDX-License-Identifier: Apache-2.0
#pragma once
// The full-order Gauss-Markov filter as the bench compares it: its gain is that which flies
// (monitor/design/gauss_markov_design.h), and its error over a fleet of constant h that of kalman_error.h, with its A.
// Scaled units.

#include "monitor/design/design.h"
#include "monitor/estimation/gauss_markov_filter.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::tuner_design {

/// rho whose health moves as much a sample as the tuners' model lets it: (1 - rho^2) tr Ph = p qh. The filters are then
/// equally fast. @throws std::invalid_argument if qh_percent2 is not above 0 and below tr Ph / p.
double gauss_markov_rho(const linear_model::LinearModel& model, double qh_percent2);

/// `model` is discrete and scaled, with all its sensors; 0 < rho < 1. All fields are filled, V = W = I; the variances
/// hold the linearisation error where the model knows it.
/// @throws std::invalid_argument if rho is out of range; std::runtime_error if a solver fails.
design::SubsetDesign gauss_markov_design(const linear_model::LinearModel& model, const estimation::SteadyGain& steady,
                                         double rho);

/// What flies.
estimation::GaussMarkovGain gauss_markov_gain(const design::SubsetDesign& design, double rho);

}  // namespace ehm::tuner_design
