// SPDX-License-Identifier: Apache-2.0
// What is kept of an engine from flight to flight: a baseline, or a line of its history, is refused with a FileError,
// or plain data that a filter may start from, and that is read again as it is written.

#include <string>

#include "deploy/runtime/files/file_error.h"
#include "monitor/history/baseline.h"
#include "monitor/history/flight_entry.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/sealed_json.h"

using namespace ehm;

namespace {

template <class Read>
void try_to(Read&& read) {
  try {
    read();
  } catch (const files::FileError& e) {
    EHM_REQUIRE(e.what()[0] != '\0');
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try_to([&] {
    const monitor::Baseline baseline = monitor::parse_baseline(fuzz::sealed(data, size), "fuzz.json");
    EHM_REQUIRE(baseline.latest.value.allFinite() && baseline.latest.covariance.allFinite());
    EHM_REQUIRE(baseline.latest.value.size() == static_cast<Eigen::Index>(baseline.names.size()));
    monitor::parse_baseline(to_text(baseline), "again.json");
  });
  try_to([&] {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const monitor::HistoryEntry entry = monitor::parse_line(text, "fuzz.jsonl:1");
    EHM_REQUIRE(entry.flight.has_value() != entry.maintenance.has_value());
    monitor::parse_line(entry.flight ? to_line(*entry.flight) : to_line(*entry.maintenance), "again.jsonl:1");
  });
  return 0;
}
