#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
#endif

namespace lstm_planner {

/// While it lives, this thread's processor takes denormal numbers for zero and makes none. Where a state fades they
/// would otherwise appear, and each product with them takes as long as hundreds of others.
class DenormalsAreZero {
 public:
#if defined(__SSE2__)
  DenormalsAreZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | kFlushToZero | kDenormalsAreZero); }
  ~DenormalsAreZero() { _mm_setcsr(before_); }
#elif defined(__aarch64__)
  DenormalsAreZero() {
    __asm__ volatile("mrs %0, fpcr" : "=r"(before_));
    __asm__ volatile("msr fpcr, %0" : : "r"(before_ | kFlushToZero));
  }
  ~DenormalsAreZero() { __asm__ volatile("msr fpcr, %0" : : "r"(before_)); }
#else
  DenormalsAreZero() = default;
  ~DenormalsAreZero() {}
#endif
  DenormalsAreZero(const DenormalsAreZero&) = delete;
  DenormalsAreZero& operator=(const DenormalsAreZero&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned kFlushToZero = 0x8000;
  static constexpr unsigned kDenormalsAreZero = 0x0040;
  unsigned before_;
#elif defined(__aarch64__)
  static constexpr std::uint64_t kFlushToZero = 1u << 24;
  std::uint64_t before_;
#endif
};

}  // namespace lstm_planner
