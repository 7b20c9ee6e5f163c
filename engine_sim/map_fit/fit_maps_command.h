// SPDX-License-Identifier: Apache-2.0
#pragma once
// The command line of fit_maps: settings and map tables -> fitted maps as C++ source and header.
// Exit codes: deploy/runtime/service/exit_code.h.

#include <iosfwd>

namespace ehm::engine_sim {

int run_fit_maps(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace ehm::engine_sim
