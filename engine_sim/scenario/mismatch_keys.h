// SPDX-License-Identifier: Apache-2.0
#pragma once
// The configuration keys [mismatch]: how the engine that flies, and what is reported of its surroundings, differ from
// the engine file and the truth. Groups of causes are drawn for one engine of a fleet by a seed; a cause that is given
// by name has that value instead.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "deploy/runtime/config/schema.h"
#include "engine_sim/mismatch/mismatch.h"

namespace ehm::engine_sim {

class MismatchKeys {
 public:
  /// Declares the keys; this must outlive the schema's use.
  void declare(config::Schema& schema);
  /// After the load.
  Mismatch value(const std::vector<std::string>& given) const;

 private:
  MismatchDraw draw_;
  std::int64_t seed_ = 1;
  Mismatch stated_{};
};

}  // namespace ehm::engine_sim
