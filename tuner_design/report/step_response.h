// SPDX-License-Identifier: Apache-2.0
#pragma once
// How the filter answers when health changes at once by h (theory.md, section 4), engine dynamics included, no noise:
//   engine   x[k+1] = A x + L h             y[k] = C x[k] + M h
//   filter   xhat[k+1] = Acl xhat[k] + K y[k+1],   Acl = (I - K Cxq) Axq,   hhat = [0, W] xhat
// As one linear map of s = [x; xhat; h]:
//   Phi = [A 0 L;  K C A  Acl  K (C L + M);  0 0 I]
// whose powers give any time without the samples between. All p steps at once, of one sigma each. Scaled units.

#include <Eigen/Core>
#include <vector>

#include "monitor/design/design.h"

namespace ehm::tuner_design::report {

struct StepResponse {
  std::vector<double> time_s;             ///< ascending, from 0, the moment of the step
  std::vector<Eigen::MatrixXd> estimate;  ///< at each time p x p, percent: column j answers a step of parameter j
};

/// `model` is discrete and scaled. Lasts five of the slowest time constants in about `points` points.
StepResponse step_response(const design::SubsetDesign& filter, const linear_model::LinearModel& model, int points);

}  // namespace ehm::tuner_design::report
