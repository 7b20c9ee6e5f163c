// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/make_estimator.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "monitor/design/make_constrained.h"
#include "monitor/design/make_error_model.h"
#include "monitor/design/make_filter.h"
#include "monitor/design/make_full_order.h"
#include "monitor/design/make_nonlinear.h"
#include "monitor/design/make_on_board.h"
#include "monitor/design/make_scheduled.h"
#include "monitor/design/make_snapshot.h"
#include "monitor/design/option_error.h"

namespace ehm::design {
namespace {

using estimation::Estimator;
using monitor::EstimatorOptions;

template <NonlinearKind kind>
std::unique_ptr<Estimator> nonlinear(const Design& design, const EstimatorOptions& options,
                                     const estimation::PointDistance&) {
  return make_nonlinear_estimator(kind, design, options);
}

template <SnapshotKind kind>
std::unique_ptr<Estimator> snapshot(const Design& design, const EstimatorOptions& options,
                                    const estimation::PointDistance& distance) {
  return make_snapshot_estimator(kind, design, options, distance);
}

const EstimatorKind* kind_of(std::string_view name) noexcept;

/// The one of estimator.constrained_of.
const EstimatorKind& constrained_kind(const EstimatorOptions& options);

constexpr std::array kinds{
    EstimatorKind{tuner_name, "steady-state Kalman filter on the tuners q = V* h", EstimatorBasis::design,
                  [](const Design& design, const EstimatorOptions&,
                     const estimation::PointDistance& distance) -> std::unique_ptr<Estimator> {
                    return std::make_unique<estimation::TunerEstimator>(make_tuner_model(design), distance);
                  }},
    EstimatorKind{"gauss_markov",
                  "steady-state Kalman filter on all health parameters, which fade in estimator.memory_s",
                  EstimatorBasis::design,
                  [](const Design& design, const EstimatorOptions& options,
                     const estimation::PointDistance& distance) -> std::unique_ptr<Estimator> {
                    return std::make_unique<estimation::GaussMarkovEstimator>(
                        make_gauss_markov_model(design, options.memory_s), distance);
                  }},
    EstimatorKind{"time_varying", "Kalman filter on all health parameters, constant: exact, and deaf to later changes",
                  EstimatorBasis::design,
                  [](const Design& design, const EstimatorOptions&,
                     const estimation::PointDistance& distance) -> std::unique_ptr<Estimator> {
                    return std::make_unique<estimation::TimeVaryingEstimator>(make_time_varying_model(design),
                                                                              distance);
                  }},
    EstimatorKind{"map", "maximum a posteriori of one sample alone: the best linear estimate without memory",
                  EstimatorBasis::design, snapshot<SnapshotKind::map>},
    EstimatorKind{"wls", "weighted least squares of one sample alone, of least norm: for comparison only",
                  EstimatorBasis::design, snapshot<SnapshotKind::wls>},
    EstimatorKind{"rls", "recursive least squares over samples, which are forgotten in estimator.memory_s",
                  EstimatorBasis::design, snapshot<SnapshotKind::rls>},
    EstimatorKind{on_board_name,
                  "the nonlinear engine itself as model, from taxi to taxi, with what its build may differ by",
                  EstimatorBasis::engine,
                  [](const Design& design, const EstimatorOptions& options, const estimation::PointDistance&) {
                    return make_on_board_estimator(design, options);
                  }},
    EstimatorKind{scheduled_name, "point models over the envelope, from a design with a schedule",
                  EstimatorBasis::schedule,
                  [](const Design& design, const EstimatorOptions& options, const estimation::PointDistance&) {
                    return make_scheduled_estimator(design, options);
                  }},
    EstimatorKind{"ekf", "extended Kalman filter on the engine itself, health as states", EstimatorBasis::engine,
                  nonlinear<NonlinearKind::extended>},
    EstimatorKind{"iekf", "the same, iterated within a sample", EstimatorBasis::engine,
                  nonlinear<NonlinearKind::iterated>},
    EstimatorKind{"clipped_ekf", "the same, health held within bounds", EstimatorBasis::engine,
                  nonlinear<NonlinearKind::clipped>},
    EstimatorKind{"ukf", "unscented Kalman filter on the engine itself", EstimatorBasis::engine,
                  nonlinear<NonlinearKind::unscented>},
    EstimatorKind{"particle", "bootstrap particle filter on the engine itself: for comparison only",
                  EstimatorBasis::engine, nonlinear<NonlinearKind::particle>},
    EstimatorKind{"ekpf", "extended Kalman particle filter on the engine itself", EstimatorBasis::engine,
                  nonlinear<NonlinearKind::extended_particle>},
    EstimatorKind{"cekpf", "the same, health held within bounds", EstimatorBasis::engine,
                  nonlinear<NonlinearKind::boxed_particle>},
    EstimatorKind{
        constrained_name, "estimator.constrained_of, whose health no longer improves by itself once it has settled",
        EstimatorBasis::design,
        [](const Design& design, const EstimatorOptions& options, const estimation::PointDistance& distance) {
          return make_constrained_estimator(constrained_kind(options).make(design, options, distance), design, options);
        }}};
static_assert(kinds.size() <= 1 + max_shadows, "all of them can fly beside each other");

const EstimatorKind* kind_of(std::string_view name) noexcept {
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const EstimatorKind& k) { return name == k.name; });
  return kind == kinds.end() ? nullptr : &*kind;
}

const EstimatorKind& constrained_kind(const EstimatorOptions& options) {
  const EstimatorKind* kind = kind_of(options.constrained_of);
  if (!kind || kind->name == std::string_view(constrained_name))
    throw OptionError("'estimator.constrained_of' is '" + options.constrained_of + "'; allowed: one of the others, " +
                      known_names());
  return *kind;
}

std::vector<estimation::ErrorModel> make_error_models(const Design& design) {
  std::vector<estimation::ErrorModel> models{make_error_model(design, design.full)};
  for (const auto& subset : design.missing)
    models.push_back(subset ? make_error_model(design, *subset) : estimation::ErrorModel{});
  return models;
}

}  // namespace

std::span<const EstimatorKind> estimator_kinds() noexcept {
  return kinds;
}

std::string_view known_name(std::string_view name) noexcept {
  const EstimatorKind* kind = kind_of(name);
  return kind ? kind->name : std::string_view();
}

std::string known_names() {
  std::string names;
  for (const EstimatorKind& kind : kinds) names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

bool publishes_on_board(const EstimatorOptions& options) noexcept {
  return options.published == on_board_name ||
         (options.published == constrained_name && options.constrained_of == on_board_name);
}

std::vector<std::string_view> companion_names(const EstimatorOptions& options) {
  std::vector<std::string> all = shadow_names(options);
  all.insert(all.begin(), options.published);
  std::vector<std::string_view> companions;
  for (const std::string& name : all) {
    if (!kind_of(name)) throw std::invalid_argument("'" + name + "' is no estimator; allowed: " + known_names());
    if (name != tuner_name) companions.push_back(known_name(name));
  }
  return companions;
}

std::vector<std::string> shadow_names(const EstimatorOptions& options) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; !options.shadow.empty() && begin <= options.shadow.size();) {
    const std::size_t end = std::min(options.shadow.find(',', begin), options.shadow.size());
    const std::string name = options.shadow.substr(begin, end - begin);
    begin = end + 1;
    if (!kind_of(name)) throw std::invalid_argument("'" + name + "' is no estimator; allowed: " + known_names());
    if (name == options.published) throw std::invalid_argument("'" + name + "' is published already");
    if (std::find(names.begin(), names.end(), name) != names.end())
      throw std::invalid_argument("'" + name + "' stands twice; allowed is once");
    names.push_back(name);
  }
  if (names.size() > max_shadows)
    throw std::invalid_argument(std::to_string(names.size()) + " estimators; allowed: at most " +
                                std::to_string(max_shadows));
  return names;
}

std::unique_ptr<Estimator> make_estimator(const std::string& name, const Design& design,
                                          const EstimatorOptions& options, const monitor::ValidityOptions& validity) {
  const EstimatorKind* kind = kind_of(name);
  if (!kind) throw std::invalid_argument("'" + name + "' is no estimator; allowed: " + known_names());
  return kind->make(design, options, {validity, design.model});
}

estimation::TunerEstimatorModel make_tuner_model(const Design& design) {
  const auto& model = design.model;
  return {make_filter(design), std::make_shared<const std::vector<estimation::ErrorModel>>(make_error_models(design)),
          linear_model::trims(model.sensors), linear_model::trims(model.controls)};
}

}  // namespace ehm::design
