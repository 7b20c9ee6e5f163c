// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/make_nonlinear.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "monitor/design/make_on_board.h"
#include "monitor/nonlinear/extended_filter.h"
#include "monitor/nonlinear/extended_particle_filter.h"
#include "monitor/nonlinear/nonlinear_estimator.h"
#include "monitor/nonlinear/particle_filter.h"
#include "monitor/nonlinear/unscented_filter.h"

namespace ehm::design {
namespace {

using namespace nonlinear;
using monitor::EstimatorOptions;

/// A gain of the start is not to be trusted, whether it comes of a tangent or of sigma points: what the dynamics of the
/// spools tell is linearised once and never again. Twice that of the on-board estimator, which has more unknowns to
/// share it; chosen on 24 engines at cruise (coverage after 30 s .80 at 6, .92 at 12, while the error hardly changes).
constexpr double early_gain_percent = 12.0;

NonlinearTraits traits_of(NonlinearKind kind) {
  switch (kind) {
    case NonlinearKind::extended:
    case NonlinearKind::iterated:
    case NonlinearKind::clipped:
      return {Reference::by_filter, early_gain_percent};
    default:
      return {Reference::by_estimator, early_gain_percent};
  }
}

/// So many sigmas of the fleet to either side; speeds are free.
StateBox fleet_box(const onboard::OnBoardModel& model, double sigmas) {
  constexpr double free = std::numeric_limits<double>::infinity();
  const auto& health = model.definition().channels.health;
  StateBox box;
  box.greatest.setConstant(onboard::speed_count + as_index(health.size()), free);
  for (std::size_t i = 0; i < health.size(); ++i)
    box.greatest(onboard::speed_count + as_index(i)) = 100.0 * sigmas * health[i].sigma;
  box.least = -box.greatest;
  return box;
}

template <std::size_t N>
std::size_t place_in(const std::array<std::string_view, N>& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) throw std::invalid_argument("'" + name + "' is no choice of a nonlinear filter");
  return as_size(at - names.begin());
}

UnscentedOptions unscented_options(const EstimatorOptions& options) {
  UnscentedOptions out;
  out.points.set = static_cast<SigmaSet>(place_in(sigma_set_names, options.sigma_points));
  out.form = static_cast<UnscentedForm>(place_in(unscented_form_names, options.unscented_form));
  return out;
}

ExtendedParticleOptions particle_options(const EstimatorOptions& options) {
  ExtendedParticleOptions out;
  out.cloud.particles = options.particles;
  out.weights = static_cast<ParticleWeights>(place_in(particle_weights_names, options.particle_weights));
  out.jacobian = static_cast<ParticleJacobian>(place_in(particle_jacobian_names, options.particle_jacobian));
  return out;
}

}  // namespace

std::unique_ptr<NonlinearFilter> make_nonlinear_filter(NonlinearKind kind, const onboard::OnBoardModel& model,
                                                       const EstimatorOptions& options) {
  const FilterNoise noise = engine_noise(model);
  ExtendedOptions extended;
  ExtendedParticleOptions particles = particle_options(options);
  switch (kind) {
    case NonlinearKind::extended:
      return std::make_unique<ExtendedFilter>(noise, extended);
    case NonlinearKind::iterated:
      extended.iterations = static_cast<int>(options.iterations);
      return std::make_unique<ExtendedFilter>(noise, extended);
    case NonlinearKind::clipped:
      extended.box = fleet_box(model, options.box_sigma);
      return std::make_unique<ExtendedFilter>(noise, extended);
    case NonlinearKind::unscented:
      return std::make_unique<UnscentedFilter>(noise, unscented_options(options));
    case NonlinearKind::particle:
      return std::make_unique<ParticleFilter>(noise, particles.cloud);
    case NonlinearKind::boxed_particle:
      particles.box = fleet_box(model, options.box_sigma);
      [[fallthrough]];
    case NonlinearKind::extended_particle:
      return std::make_unique<ExtendedParticleFilter>(noise, particles);
  }
  return nullptr;
}

std::unique_ptr<estimation::Estimator> make_nonlinear_estimator(NonlinearKind kind,
                                                                std::shared_ptr<const onboard::OnBoardModel> model,
                                                                const EstimatorOptions& options) {
  auto filter = make_nonlinear_filter(kind, *model, options);
  const NonlinearTraits traits = traits_of(kind);
  return std::make_unique<NonlinearEstimator>(std::move(model), std::move(filter), traits);
}

std::unique_ptr<estimation::Estimator> make_nonlinear_estimator(NonlinearKind kind, const Design& design,
                                                                const EstimatorOptions& options) {
  EstimatorOptions without = options;
  without.mismatch = "none";
  return make_nonlinear_estimator(kind, make_on_board_model(design, without), options);
}

}  // namespace ehm::design
