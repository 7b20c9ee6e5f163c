// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/report_data.h"

#include "monitor/design/closed_loop.h"
#include "monitor/design/make_error_model.h"
#include "tuner_design/theory/prepared_point.h"

namespace ehm::tuner_design::report {
namespace {

/// `error` is (T M - target) of k unknowns with unit variance, the first p of them health.
ErrorParts parts_of(const Eigen::MatrixXd& error, Eigen::Index p, const Eigen::MatrixXd& noise,
                    const Eigen::MatrixXd& total) {
  ErrorParts parts;
  parts.unseen = error.leftCols(p).rowwise().squaredNorm();
  parts.linearisation = error.rightCols(error.cols() - p).rowwise().squaredNorm();
  parts.noise = noise.diagonal();
  parts.total = total.diagonal();
  return parts;
}

}  // namespace

ReportData report_data(design::Design design, Studies studies) {
  ReportData data;
  data.design = std::move(design);
  data.studies = std::move(studies);
  PreparedPoint point = prepare(data.design.model);
  data.model = std::move(point.model);
  data.steady = std::move(point.steady);
  const design::SubsetDesign& full = data.design.full;
  const estimation::ErrorModel error = design::make_error_model(data.design, full);
  const Eigen::Index p = data.model.L.cols();
  // M = (I - Acl)^-1 K Gy: error_propagation.h, settled
  const Eigen::MatrixXd settled = design::settled(error.closed_loop, error.drive);
  const Eigen::MatrixXd health = error.health_output * settled, auxiliary = error.auxiliary_output * settled;
  data.settled = health.leftCols(p);
  data.health = parts_of(health - error.health_truth, p, full.health_noise_covariance, full.health_total_covariance);
  data.auxiliary =
      parts_of(auxiliary - error.auxiliary_truth, p, full.auxiliary_noise_covariance, full.auxiliary_total_covariance);
  data.health.prior = data.model.health_sigma.cwiseAbs2();
  data.auxiliary.prior = (data.steady.Hz * data.model.health_sigma.asDiagonal()).rowwise().squaredNorm();
  data.health.limit = data.design.bayes_limit.health;
  data.auxiliary.limit = data.design.bayes_limit.auxiliary;
  return data;
}

}  // namespace ehm::tuner_design::report
