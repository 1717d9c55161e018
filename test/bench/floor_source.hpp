// Included once by each floor_*.cpp, which are compiled for different instruction sets. Nothing in here, nor in what it
// includes, may have external linkage other than the table at the end: another file's calls could be bound to code that
// the machine cannot run.

#include "floor_kernels.hpp"

#pragma GCC diagnostic ignored "-Wpsabi"

#if !defined(FLOOR_KERNELS)
#error "FLOOR_KERNELS names the table that this file defines"
#endif

/// Keeps the compiler from knowing what a register holds, and therefore from taking steps of a chain together.
#if defined(__AVX512F__)
#define FLOOR_OPAQUE(value) __asm__ volatile("" : "+v"(value))
#elif defined(__x86_64__)
#define FLOOR_OPAQUE(value) __asm__ volatile("" : "+x"(value))
#elif defined(__aarch64__)
#define FLOOR_OPAQUE(value) __asm__ volatile("" : "+w"(value))
#else
#define FLOOR_OPAQUE(value) __asm__ volatile("" : "+m"(value))
#endif

#if defined(__clang__) && defined(__AVX512F__)
#define FLOOR_BROADCAST(value) __builtin_shufflevector(value, value, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0)
#elif defined(__clang__) && defined(__AVX__)
#define FLOOR_BROADCAST(value) __builtin_shufflevector(value, value, 0, 0, 0, 0, 0, 0, 0, 0)
#elif defined(__clang__)
#define FLOOR_BROADCAST(value) __builtin_shufflevector(value, value, 0, 0, 0, 0)
#else
#define FLOOR_BROADCAST(value) __builtin_shuffle(value, IntegerLanes{})
#endif

namespace lstm_planner {
namespace {

#if defined(__AVX512F__)
constexpr int kLanes = 16;
constexpr int kRegisters = 32;
#elif defined(__AVX__)
constexpr int kLanes = 8;
constexpr int kRegisters = 16;
#else
constexpr int kLanes = 4;
#if defined(__aarch64__)
constexpr int kRegisters = 32;
#else
constexpr int kRegisters = 16;
#endif
#endif

typedef float Lanes __attribute__((vector_size(kLanes * sizeof(float))));
typedef int IntegerLanes __attribute__((vector_size(kLanes * sizeof(int))));
typedef float FourLanes __attribute__((vector_size(4 * sizeof(float))));

/// Every result is the next operand, through the multiplication.
float multiplyAddChain(long count, float seed) {
  Lanes value = Lanes{} + seed;
  const Lanes factor = value * 0.5f;
  for (long i = 0; i < count; ++i) {
    value = value * factor + factor;
    FLOOR_OPAQUE(value);
  }
  return value[0];
}

float multiplicationChain(long count, float seed) {
  Lanes value = Lanes{} + seed;
  const Lanes factor = value;
  for (long i = 0; i < count; ++i) {
    value = value * factor;
    FLOOR_OPAQUE(value);
  }
  return value[0];
}

float additionChain(long count, float seed) {
  Lanes value = Lanes{} + seed;
  const Lanes term = value * 0.5f;
  for (long i = 0; i < count; ++i) {
    value = value + term;
    FLOOR_OPAQUE(value);
  }
  return value[0];
}

/// Four lanes: wider divisions take longer, and a layer of few cells needs none.
float divisionChain(long count, float seed) {
  FourLanes value = FourLanes{} + seed;
  const FourLanes dividend = value * 1.5f;
  for (long i = 0; i < count; ++i) {
    value = dividend / value;
    FLOOR_OPAQUE(value);
  }
  return value[0];
}

/// One lane into all of them.
float broadcastChain(long count, float seed) {
  Lanes value = Lanes{} + seed;
  for (long i = 0; i < count; ++i) {
    value = FLOOR_BROADCAST(value);
    FLOOR_OPAQUE(value);
  }
  return value[0];
}

/// `count` multiply-adds of a whole register, of which none waits for another.
float multiplyAdds(long count, float seed) {
  constexpr int kChains = 12;
  Lanes sums[kChains];
  for (int chain = 0; chain < kChains; ++chain) sums[chain] = Lanes{} + seed * static_cast<float>(chain);
  const Lanes factor = Lanes{} + seed * 0.5f;
  for (long i = 0; i < count; i += kChains) {
    for (int chain = 0; chain < kChains; ++chain) sums[chain] = sums[chain] * factor + factor;
  }
  Lanes sum = sums[0];
  for (int chain = 1; chain < kChains; ++chain) sum += sums[chain];
  return sum[0];
}

/// Reads a buffer `passes` times into registers, with or without asking for what comes next.
template <bool kPrefetch>
float readBuffer(const float* buffer, long bytes, long passes) {
  constexpr long kUnrolled = 8;
  constexpr long kAhead = 2048 / sizeof(Lanes);
  constexpr long kLine = 64;
  constexpr long kLines = kUnrolled * static_cast<long>(sizeof(Lanes)) / kLine;
  const Lanes* const begin = reinterpret_cast<const Lanes*>(buffer);
  const Lanes* const end = begin + bytes / static_cast<long>(sizeof(Lanes));
  for (long pass = 0; pass < passes; ++pass) {
    for (const Lanes* block = begin; block != end; block += kUnrolled) {
      if (kPrefetch) {
        const char* const next = reinterpret_cast<const char*>(block + kAhead);
        for (long line = 0; line < kLines; ++line) __builtin_prefetch(next + kLine * line);
      }
      for (long i = 0; i < kUnrolled; ++i) {
        Lanes value = block[i];
        FLOOR_OPAQUE(value);
      }
    }
  }
  return buffer[0];
}

}  // namespace

extern const FloorKernels FLOOR_KERNELS;
const FloorKernels FLOOR_KERNELS = {
    kLanes,        kRegisters,     multiplyAddChain, multiplicationChain, additionChain,
    divisionChain, broadcastChain, multiplyAdds,     readBuffer<false>,   readBuffer<true>};

}  // namespace lstm_planner
