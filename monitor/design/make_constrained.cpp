// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/make_constrained.h"

#include <algorithm>
#include <string>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "monitor/design/option_error.h"

namespace ehm::design {
namespace {

using estimation::ConstraintWay;
using monitor::EstimatorOptions;

ConstraintWay way_of(const std::string& name) {
  if (name == "projection") return ConstraintWay::projection;
  if (name == "projection_identity") return ConstraintWay::projection_identity;
  if (name == "truncation") return ConstraintWay::truncation;
  throw OptionError("'estimator.constraint' is '" + name + "'; allowed: projection, projection_identity, truncation");
}

/// +1 for each of the names in the list, -1 for the others.
estimation::HealthVector directions_of(const std::string& list, const std::vector<linear_model::Channel>& health) {
  estimation::HealthVector direction = estimation::HealthVector::Constant(as_index(health.size()), -1.0);
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string name = list.substr(begin, end - begin);
    begin = end + 1;
    const auto named = std::find_if(health.begin(), health.end(), [&](const auto& h) { return h.name == name; });
    if (named == health.end())
      throw OptionError("'estimator.wear_raises' names '" + name + "', no health parameter of the design");
    direction(named - health.begin()) = 1.0;
  }
  return direction;
}

estimation::HealthVector directions(const EstimatorOptions& options, const std::vector<linear_model::Channel>& health) {
  if (!options.wear_raises.empty()) return directions_of(options.wear_raises, health);
  estimation::HealthVector direction(as_index(health.size()));
  for (std::size_t i = 0; i < health.size(); ++i) direction(as_index(i)) = estimation::wear_direction(health[i].name);
  return direction;
}

}  // namespace

std::unique_ptr<estimation::Estimator> make_constrained_estimator(std::unique_ptr<estimation::Estimator> inner,
                                                                  const Design& design,
                                                                  const EstimatorOptions& options) {
  const estimation::ConstrainedOptions constrained{way_of(options.constraint), options.constraint_feeds_back,
                                                   options.constraint_margin_sigma,
                                                   directions(options, design.model.health)};
  if (constrained.way != ConstraintWay::projection_identity && inner->health_covariance().size() == 0)
    throw OptionError("'estimator.constraint' is '" + options.constraint + "', but " + options.constrained_of +
                      " has no covariance of health; allowed: projection_identity");
  if (constrained.feeds_back && constrained.way == ConstraintWay::truncation)
    throw OptionError(
        "'estimator.constraint_feeds_back' is true; allowed with 'estimator.constraint' = truncation: false, since the "
        "same bound would be counted again at every sample");
  // as it is: whether it can hold what it is told
  if (constrained.feeds_back && !inner->correct_health(estimation::HealthVector(inner->estimate().health)))
    throw OptionError("'estimator.constraint_feeds_back' is true, but " + options.constrained_of +
                      " cannot go on from any health; allowed: false");
  inner->reset();
  return std::make_unique<estimation::ConstrainedEstimator>(std::move(inner), constrained);
}

}  // namespace ehm::design
