// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/make_full_order.h"

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/scaling.h"
#include "monitor/design/gauss_markov_design.h"
#include "monitor/design/make_error_model.h"
#include "monitor/design/scaled_design.h"
#include "monitor/estimation/linear/solver_error.h"

namespace ehm::design {
namespace {

/// The filter's own sigmas, from (I - K C) P.
void add_own_sigmas(estimation::GaussMarkovSet& set, const SubsetDesign& subset, const linear_model::LinearModel& model,
                    const linear_model::Scaling& scaling) {
  const Eigen::Index size = subset.A.rows(), p = model.L.cols();
  const Eigen::MatrixXd updated = (Eigen::MatrixXd::Identity(size, size) - subset.K * subset.C) * subset.P;
  Eigen::MatrixXd output(model.F.rows(), size);
  output << model.F, model.N;
  set.health_sigma_filter = scaling.health.cwiseProduct(updated.diagonal().tail(p).cwiseMax(0.0).cwiseSqrt());
  set.auxiliary_sigma_filter =
      scaling.auxiliary.cwiseProduct((output * updated * output.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt());
}

estimation::GaussMarkovSet make_set(const Design& design, const linear_model::LinearModel& model,
                                    const std::vector<int>& sensors, double rho) {
  const SubsetDesign subset = gauss_markov_filter(model, sensors, rho);
  estimation::GaussMarkovSet set;
  for (const int sensor : sensors) set.sensors.set(as_size(sensor));
  estimation::GaussMarkovGain gain{rho, subset.K, {}};
  gain.innovation_variance =
      (subset.C * subset.P * subset.C.transpose()).diagonal() + model.sensor_noise_sigma.cwiseAbs2();
  set.gain = std::make_shared<const estimation::GaussMarkovGain>(gain);
  set.error = make_error_model(design, subset);
  add_own_sigmas(set, subset, model, design.scaling);
  return set;
}

}  // namespace

std::shared_ptr<const estimation::GaussMarkovModel> make_gauss_markov_model(const Design& design, double memory_s) {
  const linear_model::LinearModel model = discrete_scaled(design);
  const double rho = rho_of(memory_s, model.sample_time_s);
  auto made = std::make_shared<estimation::GaussMarkovModel>();
  made->model = std::make_shared<const estimation::FullOrderModel>(estimation::full_order_model(model));
  made->units = units_of(design);
  const std::vector<int>& all = design.full.sensors;
  made->sets.resize(1 + model.sensors.size());
  made->sets.front() = make_set(design, model, all, rho);
  for (const int missing : all) {
    std::vector<int> left;
    for (const int sensor : all)
      if (sensor != missing) left.push_back(sensor);
    if (left.empty()) continue;
    try {
      made->sets[as_size(1 + missing)] = make_set(design, model, left, rho);
    } catch (const estimation::SolverError&) {  // these sensors alone have no filter: no answer without that one
    }
  }
  return made;
}

std::shared_ptr<const estimation::TimeVaryingModel> make_time_varying_model(const Design& design) {
  const linear_model::LinearModel model = discrete_scaled(design);
  auto made = std::make_shared<estimation::TimeVaryingModel>();
  made->model = std::make_shared<const estimation::FullOrderModel>(estimation::full_order_model(model));
  made->units = units_of(design);
  made->settling_samples = design.full.settling_samples(model.sample_time_s);
  return made;
}

}  // namespace ehm::design
