// SPDX-License-Identifier: Apache-2.0
#pragma once
// The configuration keys [life]: an engine that has flown so many cycles, with its maintenance; its wear is added to
// what [[wear]] tables say.

#include <cstdint>

#include "deploy/runtime/config/schema.h"
#include "engine_sim/scenario/scenario.h"

namespace ehm::engine_sim {

class LifeKeys {
 public:
  /// Declares the keys; this must outlive the schema's use.
  void declare(config::Schema& schema);
  /// After the load. @throws config::ConfigError if maintenance lies behind the present cycle, or there is none.
  void finish(Scenario& scenario) const;

 private:
  std::int64_t cycles_ = -1, washed_at_ = 0, replaced_at_ = 0, seed_ = 0;
};

}  // namespace ehm::engine_sim
