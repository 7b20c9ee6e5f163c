// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/search/blind_tuner.h"

#include "deploy/runtime/numbers/decompositions.h"
#include "tuner_design/search/row_space.h"

namespace ehm::tuner_design {
namespace {

/// S of all points.
Eigen::MatrixXd sensitivities(const SearchProblem& problem) {
  Eigen::MatrixXd S(0, problem.points.front().problem.H.cols());
  for (const SearchPoint& point : problem.points) {
    const PointProblem& p = point.problem;
    S.conservativeResize(S.rows() + p.H.rows(), Eigen::NoChange);
    S.bottomRows(p.H.rows()) = p.sensor_variance.cwiseSqrt().cwiseInverse().asDiagonal() * p.H;
  }
  return S;
}

}  // namespace

std::optional<Eigen::MatrixXd> without_blind_tuner(const SearchProblem& problem, const Eigen::MatrixXd& V) {
  constexpr double blind = 1e-3;
  const Eigen::Index t = V.rows();
  const Eigen::MatrixXd S = sensitivities(problem);
  const Eigen::JacobiSVD<Eigen::MatrixXd> seen(S * V.transpose(), Eigen::ComputeFullV);
  const double best = Eigen::JacobiSVD<Eigen::MatrixXd>(S).singularValues()(t - 1);
  if (seen.singularValues()(t - 1) >= blind * best) return std::nullopt;
  Eigen::MatrixXd result(t, V.cols());
  result.topRows(t - 1) = seen.matrixV().leftCols(t - 1).transpose() * V;
  const Eigen::MatrixXd others = result.topRows(t - 1);
  const Eigen::JacobiSVD<Eigen::MatrixXd> rest(S - S * others.transpose() * others, Eigen::ComputeFullV);
  result.row(t - 1) = rest.matrixV().col(0).transpose();
  return row_space(result);
}

}  // namespace ehm::tuner_design
