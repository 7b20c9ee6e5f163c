// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/design/tuner_baselines.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {
namespace {

/// Small letters, "eff" written out.
std::string common_name(const std::string& name) {
  std::string result;
  for (const char c : name) result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::string brief = "_eff";
  if (result.size() > brief.size() && result.ends_with(brief)) result += "iciency";
  return result;
}

}  // namespace

Eigen::MatrixXd subset_tuners(const linear_model::LinearModel& model, const std::vector<std::string>& names) {
  const auto p = as_index(model.health.size());
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(as_index(names.size()), p);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::find_if(model.health.begin(), model.health.end(),
                                    [&](const linear_model::Channel& channel) { return channel.name == names[i]; });
    if (found == model.health.end()) {
      throw std::invalid_argument("subset of tuners: the model has no health parameter " + names[i]);
    }
    V(as_index(i), found - model.health.begin()) = 1.0;
  }
  return V;
}

std::vector<std::string> published_subset(const linear_model::LinearModel& model) {
  std::vector<std::string> names;
  for (const char* wanted :
       {"fan_flow", "lpc_efficiency", "hpc_efficiency", "hpc_flow", "hpt_efficiency", "hpt_flow", "lpt_flow"}) {
    const auto found = std::find_if(model.health.begin(), model.health.end(),
                                    [&](const auto& channel) { return common_name(channel.name) == wanted; });
    if (found == model.health.end()) return {};
    names.push_back(found->name);
  }
  return names;
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

}  // namespace ehm::tuner_design
