// SPDX-License-Identifier: Apache-2.0
#pragma once
// An operator's option that a design cannot be flown with: the message names key, value and what is allowed. The design
// itself may be in order.

#include <stdexcept>

namespace ehm::design {

class OptionError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace ehm::design
