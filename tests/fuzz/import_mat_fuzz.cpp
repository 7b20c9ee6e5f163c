// SPDX-License-Identifier: Apache-2.0
// A MATLAB file from somebody else: refused with a FileError, or a sound model.

#include "deploy/runtime/files/file_error.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"
#include "tuner_design/import/mat_file.h"

/// libmatio 1.5.23 itself loses some memory over damaged files.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libmatio\n";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ehm::fuzz::MemoryFile file(data, size);
  try {
    ehm::tuner_design::read_mat_file(file.path());
  } catch (const ehm::files::FileError& e) {
    EHM_REQUIRE(e.what()[0] != '\0');
  }
  return 0;
}
