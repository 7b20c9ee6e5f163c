// SPDX-License-Identifier: Apache-2.0
#pragma once
// The design that the targets fly: small, kept in the corpus of the design parser, read once.

#include <memory>

#include "monitor/design/design_file.h"

namespace ehm::fuzz {

inline std::shared_ptr<const design::Design> small_design() {
  static const auto design =
      std::make_shared<const design::Design>(design::read_design(EHM_FUZZ_CORPUS "/design/small.json"));
  return design;
}

}  // namespace ehm::fuzz
