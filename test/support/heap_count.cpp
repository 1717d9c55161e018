#include "heap_count.hpp"

#include <cerrno>
#include <cstddef>

namespace {

thread_local long allocations = 0;
thread_local long live_bytes = 0;

}  // namespace

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define LSTM_PLANNER_COUNTS_HEAP

#include <malloc.h>

extern "C" {
// The C library's own, by the names it keeps for those that replace the public ones.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);
}

namespace {

void* count(void* block) {
  if (block != nullptr) {
    ++allocations;
    live_bytes += static_cast<long>(malloc_usable_size(block));
  }
  return block;
}

void discount(void* block) {
  if (block != nullptr) live_bytes -= static_cast<long>(malloc_usable_size(block));
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) { return count(__libc_malloc(size)); }
void* calloc(std::size_t number, std::size_t size) { return count(__libc_calloc(number, size)); }
void* memalign(std::size_t alignment, std::size_t size) { return count(__libc_memalign(alignment, size)); }
void* aligned_alloc(std::size_t alignment, std::size_t size) { return count(__libc_memalign(alignment, size)); }

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  *block = count(__libc_memalign(alignment, size));
  return *block == nullptr ? ENOMEM : 0;
}

void* realloc(void* block, std::size_t size) {
  discount(block);
  return count(__libc_realloc(block, size));
}

void free(void* block) {
  discount(block);
  __libc_free(block);
}

}  // extern "C"

#endif

namespace lstm_planner {

HeapCount heapCount() { return {allocations, live_bytes}; }

bool heapIsCounted() {
#ifdef LSTM_PLANNER_COUNTS_HEAP
  return true;
#else
  return false;
#endif
}

}  // namespace lstm_planner
