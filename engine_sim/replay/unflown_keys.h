// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a scenario says and a replay does not do: the recording's engines, wear, noise and faults are already in its
// values. Errors: none.

#include <string>
#include <vector>

namespace ehm::engine_sim {

/// Of the configuration keys that somebody has set (config::Schema::given), those that a replay does not use, as "'a',
/// 'b'"; empty: it uses all.
std::string unflown_keys(const std::vector<std::string>& given);

}  // namespace ehm::engine_sim
