#pragma once
// Gain and fleet error of the full-order Gauss-Markov filter (monitor/estimation/gauss_markov_filter.h):
//
//   A = [A L; 0 rho I],  C = [C M],  Q = blkdiag(Q, (1 - rho^2) Ph);   P from the Riccati equation, K = P C^T (..)^-1
//
// It is a filter on the p "tuners" q = h, V = W = I, whose integrators leak; so its error over a fleet of constant h is
// that of kalman_error.h, with this A. Rows and columns: [x; h], n + p; scaled units.
// Its response: what the sensors do not see, null(H_rho) with H_rho = C (rho I - A)^-1 L + M, forgets with rho, which
// the sensors neither cause nor cure; the slowest time constant is that of all the rest, of Acl on the complement of
// [ (rho I - A)^-1 L; I ] null(H_rho).

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
