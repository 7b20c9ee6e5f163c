// SPDX-License-Identifier: Apache-2.0
#pragma once
// JSON for people and diff tools: an object's keys on lines of their own, a row of numbers on one line. Numbers are
// in the shortest form that reads back to the same double.

#include <nlohmann/json.hpp>
#include <string>

namespace ehm::files {

std::string readable_text(const nlohmann::json& json);

}  // namespace ehm::files
