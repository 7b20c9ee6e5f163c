// SPDX-License-Identifier: Apache-2.0
#pragma once
// Numbers of a command line that are finite and within a range, neither of which CLI11 asks of "nan".

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <limits>
#include <string>

#include "deploy/runtime/config/table_reader.h"
#include "deploy/runtime/files/csv_table.h"

namespace ehm::client {

inline CLI::Validator finite_number(double least = std::numeric_limits<double>::lowest(),
                                    double most = std::numeric_limits<double>::max()) {
  std::string allowed = "a finite number";
  if (least > std::numeric_limits<double>::lowest()) allowed += " from " + config::number_text(least);
  if (most < std::numeric_limits<double>::max()) allowed += " to " + config::number_text(most);
  return {[=](const std::string& text) -> std::string {
            const auto value = files::parse_number(text);
            return value && *value >= least && *value <= most ? "" : "'" + text + "', allowed is " + allowed;
          },
          ""};
}

}  // namespace ehm::client
