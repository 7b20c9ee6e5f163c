// SPDX-License-Identifier: Apache-2.0
#pragma once
// What `tuner_design check` finds in a model or a design file: what it is, its dimensions, what its sensors see, how
// well the problem is conditioned, and its content hash.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/import/import_model.h"
#include "tuner_design/theory/observability.h"

namespace ehm::tuner_design {

struct CheckedFile {
  std::string kind;    ///< "linear model" or "design"
  std::string schema;  ///< or format, of a model that is not ours
  std::string hash;    ///< SHA-256 of the content
  linear_model::LinearModel model;
  std::vector<std::string> assumed;  ///< what the file does not state
  std::vector<std::string> blind;    ///< sensors that see nothing of health
  Observability observability;
  Eigen::VectorXd pair_singular_values;     ///< of (Axq, Cxq), noise-scaled; empty if nothing of health is seen
  Eigen::VectorXd slow_bias_detectability;  ///< by sensor; empty for a model
};

/// `path`: a design or whatever import_model reads.
/// @throws files::FileError if the file is neither, or has a defect.
CheckedFile check_file(const std::string& path, const ImportOptions& options);

/// @throws files::FileError, naming `path`, if no design can be made of what the sensors see.
void require_observable(const CheckedFile& file, const std::string& path);

nlohmann::ordered_json check_as_json(const CheckedFile& file);

/// A line each.
void print_assumed(const std::vector<std::string>& assumed, std::ostream& out);
void print_blind(const std::vector<std::string>& blind, std::ostream& out);

void print_check(const CheckedFile& file, std::ostream& out);

}  // namespace ehm::tuner_design
