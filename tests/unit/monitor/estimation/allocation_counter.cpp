// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/monitor/estimation/allocation_counter.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations{0}, bytes{0};

void count(std::size_t size) {
  ++allocations;
  bytes += static_cast<long>(size);
}
}  // namespace

// The names are those that the linker's --wrap option gives to the caller's and to the real function.
extern "C" {
void* __real_malloc(std::size_t size);
void* __real_realloc(void* memory, std::size_t size);
void* __wrap_malloc(std::size_t size);
void* __wrap_realloc(void* memory, std::size_t size);
void* __wrap_malloc(std::size_t size) {
  count(size);
  return __real_malloc(size);
}
void* __wrap_realloc(void* memory, std::size_t size) {
  count(size);
  return __real_realloc(memory, size);
}
}

void* operator new(std::size_t size) {
  if (void* memory = std::malloc(size)) return memory;  // counted there
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  count(size);
  const auto a = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(a, (size + a - 1) / a * a)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace ehm::test {

long allocation_count() {
  return allocations;
}
long allocated_bytes() {
  return bytes;
}

}  // namespace ehm::test
