// SPDX-License-Identifier: Apache-2.0
#pragma once
// What tuner_design envelope says of a schedule.

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "monitor/design/design.h"
#include "tuner_design/envelope/envelope.h"

namespace ehm::tuner_design {

void print_envelope(const EnvelopeResult& result, const design::Design& design, std::ostream& out);
nlohmann::ordered_json envelope_as_json(const EnvelopeResult& result, const design::Design& design);

}  // namespace ehm::tuner_design
