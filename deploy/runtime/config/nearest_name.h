// SPDX-License-Identifier: Apache-2.0
#pragma once
// What somebody may have meant who wrote a name that does not exist: of a key, an option, a variable, a command.
//
// Distance (optimal string alignment): characters to insert, delete or replace, and neighbours to swap. A name is near
// within a third of what was written, dashes in front apart, and within 3 edits at most: farther is no typing error.

#include <cstddef>
#include <string>
#include <vector>

namespace ehm::config {

std::size_t edit_distance(const std::string& a, const std::string& b);

/// The nearest known name, the first of several; an empty text when none is near.
std::string nearest_name(const std::string& written, const std::vector<std::string>& known);

}  // namespace ehm::config
