// SPDX-License-Identifier: Apache-2.0
#pragma once
// What is known of one engine from its flights: what its build was found to be in the first of them, which its wear is
// counted from, and what the latest has taught, which the next one starts from.
//
// As a file: JSON, schema "ehm-baseline/1", numbers in shortest exact form, names of what is known, and the SHA-256 of
// the content. Anyone may read it; nobody should edit it.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "monitor/estimation/learned.h"

namespace ehm::monitor {

inline constexpr const char* baseline_schema = "ehm-baseline/1";

struct Baseline {
  std::uint32_t engine_id = 0;
  std::string engine_type;
  std::vector<std::string> names;      ///< of the values, in order: health parameters, then causes of mismatch
  std::uint32_t flights = 0;           ///< that have been summed up
  std::uint32_t flights_of_first = 0;  ///< those that `first` has seen: it is complete once that stays behind
  std::int64_t landing_ns = 0;         ///< of the latest, the source's clock
  estimation::Learned first, latest;
};

std::string to_text(const Baseline& baseline);

/// `file` is only named in messages. What it returns is finite, of one length, with covariances that are such.
/// @throws files::FileError (file, key, value, allowed) if the text is not complete JSON, of another schema, damaged
///         (hash), or a value is out of its range.
Baseline parse_baseline(std::string_view text, const std::string& file);

/// Counts a flight: what it has learned is the latest, and the first too while fewer than `first_flights` are counted.
void count_flight(Baseline& baseline, const estimation::Learned& learned, std::int64_t landing_ns,
                  std::uint32_t first_flights);

}  // namespace ehm::monitor
