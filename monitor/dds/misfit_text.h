// SPDX-License-Identifier: Apache-2.0
#pragma once
// What does not fit between a channel as its source describes it and the design's, as text.

#include <string>

#include "monitor/checks/source_fit.h"

namespace ehm::monitor {

/// "sensor 3 is T30 in degC by KIND, T24 in K by the design: ...". `what`: sensor or actuator; `by`: who says so.
std::string misfit_text(const std::string& what, std::size_t i, const ChannelWords& said, const std::string& by,
                        const std::vector<linear_model::Channel>& channels, Misfit misfit);

}  // namespace ehm::monitor
