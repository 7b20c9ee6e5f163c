// SPDX-License-Identifier: Apache-2.0
#pragma once
// The topics of the shadow estimators: EngineHealth/NAME and EngineAuxiliary/NAME for each, with the same types, keys
// and delivery as the published ones. Real-time safe: as RankedWriter. Must be destroyed before the Participant.

#include <string>

#include "idl/topics.h"
#include "monitor/redundancy/ranked_writer.h"

namespace ehm::monitor {

struct ShadowWriters {
  ShadowWriters(idl::Participant& participant, const std::string& estimator)
      : health(participant, estimator), auxiliary(participant, estimator) {}

  RankedWriter<EngineHealth> health;
  RankedWriter<EngineAuxiliary> auxiliary;
};

}  // namespace ehm::monitor
