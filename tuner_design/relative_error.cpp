#include "tuner_design/relative_error.h"

#include "tuner_design/bayes_limit.h"

namespace ehm::bench {
namespace {

/// weight / limit, weight / prior where the limit vanishes, 0 where both do.
double relative_weight(double weight, double limit, double prior) {
  constexpr double vanishes = 1e-9;  // of the prior
  if (limit > vanishes * prior) return weight / limit;
  return prior > 0.0 ? weight / prior : 0.0;
}

}  // namespace

RelativeError relative_error(const estimation::LinearModel& model, const estimation::SteadyGain& steady,
                             double health_weight, double auxiliary_weight) {
  const Eigen::MatrixXd root = model.health_sigma.asDiagonal();
  const Eigen::MatrixXd U = bayes_limit_factor(steady.H, root * root);
  const double z_weight =
      relative_weight(auxiliary_weight, (steady.Hz * U).squaredNorm(), (steady.Hz * root).squaredNorm());
  return {relative_weight(health_weight, U.squaredNorm(), root.squaredNorm()),
          Eigen::VectorXd::Constant(steady.Hz.rows(), z_weight)};
}

}  // namespace ehm::bench
