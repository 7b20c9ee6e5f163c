#include "tuner_design/baselines/tuner_baselines.h"

#include <Eigen/SVD>
#include <algorithm>
#include <stdexcept>

namespace ehm::bench {

Eigen::MatrixXd subset_tuners(const estimation::LinearModel& model, const std::vector<std::string>& names) {
  const auto p = static_cast<Eigen::Index>(model.health.size());
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(names.size()), p);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::find_if(model.health.begin(), model.health.end(),
                                    [&](const estimation::Channel& channel) { return channel.name == names[i]; });
    if (found == model.health.end()) {
      throw std::invalid_argument("subset of tuners: the model has no health parameter " + names[i]);
    }
    V(static_cast<Eigen::Index>(i), found - model.health.begin()) = 1.0;
  }
  return V;
}

Eigen::MatrixXd svd_tuners(const Eigen::MatrixXd& H, const Eigen::MatrixXd& Hz, Eigen::Index t) {
  if (t < 1 || t > H.cols()) {
    throw std::invalid_argument("SVD tuners: " + std::to_string(t) + " tuners; allowed 1 to " +
                                std::to_string(H.cols()));
  }
  Eigen::MatrixXd stacked(H.rows() + Hz.rows(), H.cols());
  stacked << H, Hz;
  return Eigen::JacobiSVD<Eigen::MatrixXd>(stacked, Eigen::ComputeFullV).matrixV().leftCols(t).transpose();
}

}  // namespace ehm::bench
