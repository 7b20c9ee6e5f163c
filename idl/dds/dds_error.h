// SPDX-License-Identifier: Apache-2.0
#pragma once
// What everything in idl/dds throws: the message names the file, profile, topic or entity that could not be had.

#include <stdexcept>

namespace ehm::idl {

class DdsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace ehm::idl
