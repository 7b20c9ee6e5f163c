// SPDX-License-Identifier: Apache-2.0
/* Preloaded into a service under test: moves its wall clock by the seconds that stand in the file EHM_CLOCK_STEP,
   8 bytes, a double. The monotonic clock is left alone. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

static const double none = 0.0;

static const volatile double* step(void) {
  static const volatile double* mapped = NULL;
  if (mapped) return mapped;
  const char* file = getenv("EHM_CLOCK_STEP");
  const int descriptor = file ? open(file, O_RDONLY) : -1;
  void* memory = descriptor < 0 ? MAP_FAILED : mmap(NULL, sizeof none, PROT_READ, MAP_SHARED, descriptor, 0);
  if (descriptor >= 0) close(descriptor);
  mapped = memory == MAP_FAILED ? &none : (const volatile double*)memory;
  return mapped;
}

int clock_gettime(clockid_t clock, struct timespec* t) {
  static int (*real)(clockid_t, struct timespec*) = NULL;
  if (!real) *(void**)&real = dlsym(RTLD_NEXT, "clock_gettime");
  const int result = real(clock, t);
  if (result == 0 && clock == CLOCK_REALTIME) t->tv_sec += (time_t)*step();
  return result;
}
