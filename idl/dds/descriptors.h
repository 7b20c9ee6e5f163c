// SPDX-License-Identifier: Apache-2.0
#pragma once
// A participant opens some thirty sockets and pipes, and Fast DDS 2.9.1 says nothing where it gets none: the process
// would be ready, and deaf. So it is looked beforehand whether there are enough.
//
// @throws DdsError if this process may not open `least_descriptors` more, even after its soft limit is raised.

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>

#include "idl/dds/dds_error.h"

namespace ehm::idl {

inline constexpr rlim_t least_descriptors = 64;

inline void require_descriptors() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  // Looking into /proc takes a descriptor itself; where there is none left, all that are allowed are in use.
  std::error_code none_left;
  const std::filesystem::directory_iterator open("/proc/self/fd", none_left);
  const auto used = none_left ? limit.rlim_cur : static_cast<rlim_t>(std::distance(begin(open), end(open)));
  const rlim_t needed = used + least_descriptors;
  if (limit.rlim_cur >= needed) return;
  limit.rlim_cur = std::min(limit.rlim_max, needed);
  if (limit.rlim_cur >= needed && setrlimit(RLIMIT_NOFILE, &limit) == 0) return;
  throw DdsError("this process may have " + std::to_string(limit.rlim_max) +
                 " file descriptors (ulimit -n, LimitNOFILE), " + std::to_string(used) +
                 " are in use, and a DDS participant needs " + std::to_string(least_descriptors) + " more: allow " +
                 std::to_string(needed) + " at least");
}

}  // namespace ehm::idl
