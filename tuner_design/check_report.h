#pragma once
// What `tuner_design check` finds in a model or a design file: what it is, its dimensions, what its sensors see, how
// well the problem is conditioned, and its content hash.

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/observability.h"

namespace ehm::bench {

struct CheckedFile {
  std::string kind;  ///< "linear model" or "design"
  std::string schema;
  std::string hash;  ///< SHA-256 of the content
  estimation::LinearModel model;
  Observability observability;
  Eigen::VectorXd pair_singular_values;  ///< of (Axq, Cxq), noise-scaled; empty if health is not observable
};

/// @throws design::FileError if the file is neither, or has a defect.
CheckedFile check_file(const std::string& path);

nlohmann::ordered_json check_as_json(const CheckedFile& file);

void print_check(const CheckedFile& file, std::ostream& out);

}  // namespace ehm::bench
