// SPDX-License-Identifier: Apache-2.0
#pragma once
// The files of one recording name: flight.h5, then flight.0002.h5, flight.0003.h5 ... A number that exists is never
// written again, so that a restarted service goes on with the next one.

#include <cstdint>
#include <string>
#include <vector>

namespace ehm::recording {

/// Name of part `number`, from 1.
std::string part_name(const std::string& file, std::int64_t number);

/// Name of the part after `path`, which may be any part.
std::string following_part(const std::string& path);

/// Numbers of the parts that exist, ascending. None if the folder cannot be read.
std::vector<std::int64_t> existing_parts(const std::string& file);

/// The number after the highest that exists.
std::int64_t next_part(const std::string& file);

}  // namespace ehm::recording
