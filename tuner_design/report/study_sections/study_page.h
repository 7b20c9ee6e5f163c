// SPDX-License-Identifier: Apache-2.0
#pragma once
// One study as a page of its own, with what made it.

#include <cstdint>
#include <string>

#include "tuner_design/report/page/page.h"

namespace ehm::tuner_design::report {

struct StudyOrigin {
  std::string command;  ///< that gives the same numbers again
  std::string version;  ///< of the program
  std::uint64_t seed = 1;
};

Page study_page(Section section, const StudyOrigin& origin);

}  // namespace ehm::tuner_design::report
