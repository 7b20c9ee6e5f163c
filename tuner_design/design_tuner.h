#pragma once
// From a linear model to a finished design, by the closed form (THEORY section 5): the bias of the filter is least when
// range(W) = range(Ph H^T), that is V = T H Ph with any invertible T, for health and every linear auxiliary output at
// once. T is chosen so that V has orthonormal rows. With at least as many sensors as health parameters nothing has to
// be reduced: V = I. Only the row space of V matters (Simon & Garg, NASA/TM-2010-216077, section on uniqueness).
// One design for all sensors, and one without each single sensor. A design without a sensor, and every design of a
// model that knows its linearisation error, drops the weakest combinations of health parameters, one by one, while a
// published sigma would exceed the fleet's own: an estimate must not be worse than none. Weak is what stands out least
// from what a long average still gets wrong: N = Lambda_y + R / 256 (some 4 s of samples) with the sensors' part of the
// linearisation error, N = R where that is unknown.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "monitor/design/design.h"

namespace ehm::bench {

/// Orthonormal basis, t x p, of the row space of V (t x p, full row rank), with the sign of a QR decomposition whose
/// triangle has a positive diagonal: the same rows on every machine.
Eigen::MatrixXd row_space(const Eigen::MatrixXd& V);

/// Tuners for the sensors with steady gain H (|S| x p), t x p with orthonormal rows: V = I for t = p, else the row
/// space of U_t^T N^-1/2 H Ph with U_t the t strongest left singular vectors of N^-1/2 H Ph^1/2, which for t = |S| is
/// that of H Ph. `noise` is N, |S| x |S|.
/// @throws std::invalid_argument if t is not within 1 and min(|S|, p).
/// @throws std::runtime_error if N is not positive definite.
Eigen::MatrixXd closed_form_tuners(const Eigen::MatrixXd& H, const Eigen::MatrixXd& noise,
                                   const Eigen::VectorXd& health_sigma, Eigen::Index t);

/// Names of the health parameters whose total sigma exceeds the fleet's own.
std::vector<std::string> worse_than_prior(const design::SubsetDesign& design, const estimation::LinearModel& model,
                                          const estimation::Scaling& scaling);

/// `model` has passed design::check_model.
/// @throws std::invalid_argument if qh_percent2 is not above zero.
/// @throws std::runtime_error if the full sensor set is not observable, or a solver fails; says which matrix and why.
design::Design design_tuner(const estimation::LinearModel& model, const design::DesignOptions& options);

}  // namespace ehm::bench
