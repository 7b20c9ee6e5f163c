// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/mismatch_keys.h"

#include <algorithm>

namespace ehm::engine_sim {
namespace {

/// No engine differs by more; with it every engine that ships still runs.
constexpr double most_sigmas = 10.0, most_soak = 0.9;

std::string key_of(const MismatchCause& cause) {
  return "mismatch." + std::string(cause.name);
}

}  // namespace

void MismatchKeys::declare(config::Schema& schema) {
  schema.flag("mismatch.build", draw_.build, "whether the engine's build is drawn within its tolerance");
  schema.flag("mismatch.soak", draw_.soak, "whether its heat soak differs from the file's");
  schema.flag("mismatch.inputs", draw_.inputs, "whether air data and fuel meter have errors");
  schema.integer("mismatch.seed", seed_, 0, 9007199254740992, "", "which engine of the fleet is drawn");
  for (std::size_t i = 0; i < mismatch_count; ++i) {
    const MismatchCause& cause = mismatch_causes()[i];
    const double most = cause.group == MismatchGroup::metal ? most_soak : most_sigmas * cause.sigma;
    schema.real(key_of(cause), stated_[i], -most, most, std::string(cause.unit),
                std::string(cause.description) + ": its deviation, instead of a drawn one");
  }
}

Mismatch MismatchKeys::value(const std::vector<std::string>& given) const {
  Mismatch mismatch = drawn_mismatch(draw_, static_cast<std::uint64_t>(seed_));
  for (std::size_t i = 0; i < mismatch_count; ++i)
    if (std::find(given.begin(), given.end(), key_of(mismatch_causes()[i])) != given.end()) mismatch[i] = stated_[i];
  return mismatch;
}

}  // namespace ehm::engine_sim
