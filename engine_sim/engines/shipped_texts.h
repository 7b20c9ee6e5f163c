// SPDX-License-Identifier: Apache-2.0
#pragma once
// The shipped engine files as they were when the program was built (CMakeLists.txt writes the source).

#include <string>

namespace ehm::engine_sim {

extern const std::string high_bypass_text;

}  // namespace ehm::engine_sim
