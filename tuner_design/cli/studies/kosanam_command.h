// SPDX-License-Identifier: Apache-2.0
#pragma once
// `study kosanam-5.1`, `-5.2`, `-5.3` and `kosanam-ga`: the tables of Kosanam's thesis, on the MAPSS model unless
// another is named.

#include <optional>
#include <string>

#include "tuner_design/cli/command.h"
#include "tuner_design/import/import_model.h"
#include "tuner_design/kosanam/gain_search.h"
#include "tuner_design/kosanam/robust_tables.h"

namespace ehm::tuner_design {

struct KosanamArguments {
  std::optional<int> flights, runs;
  double equal_wear_percent = 0.0;
  RobustTablesOptions robust;
  GainSearchOptions search;
};

bool is_kosanam_study(const std::string& study);
void add_kosanam_options(CLI::App& command, KosanamArguments& arguments);

struct KosanamGiven {
  std::string study, model_file, csv;
  ImportedModel model;  ///< not used by kosanam-ga
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// @throws files::FileError if the model is not one that the study can fly, or a file cannot be written.
void kosanam_study(KosanamArguments arguments, const KosanamGiven& given, const OutputOptions& output,
                   const Console& console);

}  // namespace ehm::tuner_design
