// SPDX-License-Identifier: Apache-2.0
#pragma once
// A user's mistake in a configuration, as one message: origin (file and line, variable or flag), key, value, allowed
// range. Programs end with exit_usage.

#include <stdexcept>

namespace ehm::config {

class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace ehm::config
