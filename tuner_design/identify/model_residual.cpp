// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/identify/model_residual.h"

#include "deploy/runtime/numbers/decompositions.h"

namespace ehm::tuner_design {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd differenced_residual(const RecordedSamples& record, const Span& span, const linear_model::LinearModel& scaled,
                              const std::vector<int>& sensors, const VectorXd& sensor_scale) {
  const VectorXd trim_u = linear_model::trims(scaled.controls), trim_y = linear_model::trims(scaled.sensors);
  const auto u = [&](Index k) -> VectorXd { return record.controls.col(span.begin + k) - trim_u; };
  // xu = (I - A)^-1 B u
  const MatrixXd I = MatrixXd::Identity(scaled.A.rows(), scaled.A.cols());
  VectorXd xu = (I - scaled.A).partialPivLu().solve(scaled.B * u(0));
  MatrixXd e(trim_y.size(), span.length);
  for (Index k = 0; k < span.length; ++k) {
    const VectorXd y = record.sensors(sensors, span.begin + k);
    // e = y - C xu - D u
    e.col(k) = y.cwiseQuotient(sensor_scale) - trim_y - scaled.C * xu - scaled.D * u(k);
    // xu = A xu + B u
    xu = scaled.A * xu + scaled.B * u(k);
  }
  MatrixXd d = e.rightCols(span.length - 1) - e.leftCols(span.length - 1);
  d.colwise() -= d.rowwise().mean().eval();
  return d;
}

}  // namespace ehm::tuner_design
