// SPDX-License-Identifier: Apache-2.0
#pragma once
// A broken promise ends the program in every build, so that fuzzer and replay both see it.

#include <cstdio>
#include <cstdlib>

#define EHM_REQUIRE(condition)                                                     \
  do {                                                                             \
    if (!(condition)) {                                                            \
      std::fprintf(stderr, "%s:%d: broken: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                \
    }                                                                              \
  } while (false)
