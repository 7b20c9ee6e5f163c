// SPDX-License-Identifier: Apache-2.0
#pragma once
// Counts every allocation of a test program: operator new, and malloc and realloc, which Eigen calls directly. The
// program must be linked with -Wl,--wrap=malloc -Wl,--wrap=realloc.

namespace ehm::test {

/// Allocations since the program started.
long allocation_count();
/// What they asked for, since then; what was freed again is in it.
long allocated_bytes();

}  // namespace ehm::test
