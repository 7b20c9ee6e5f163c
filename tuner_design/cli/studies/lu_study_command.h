// SPDX-License-Identifier: Apache-2.0
#pragma once
// `tuner_design study lu-4` to `lu-9`: the tables of Lu, Huang & Lv on an engine of ours (tuner_design/lu/lu_study.h).

#include "tuner_design/cli/command.h"
#include "tuner_design/lu/lu_study.h"

namespace ehm::tuner_design {

inline constexpr std::array<const char*, 6> lu_study_names{"lu-4", "lu-5", "lu-6", "lu-7", "lu-8", "lu-9"};

void add_lu_study_options(CLI::App& command, LuOptions& options);

/// `options` with the engine, seed and threads of the command; `csv`: file of the first run's estimates, or empty.
void lu_study(const std::string& name, LuOptions options, const std::string& csv, const OutputOptions& output,
              const Console& console);

}  // namespace ehm::tuner_design
