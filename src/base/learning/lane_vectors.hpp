#pragma once

// Vectors for the kernels of lane_kernels_source.hpp, as wide as the instruction set has them. All of it has internal
// linkage, unlike what a header usually holds: a linker that finds a function twice keeps one of them, perhaps one that
// this machine cannot run. For the same reason no template of the standard library may be used.

#include "lstm_planner/base/learning/lane_kernels.hpp"

// Vectors are handed over between inlined functions only, so that how they are passed does not matter.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif
#define LSTM_PLANNER_INLINE __attribute__((always_inline, unused)) inline

namespace lstm_planner {
namespace {

#if defined(__AVX512F__)
constexpr int kWidth = 16;
#elif defined(__AVX2__)
constexpr int kWidth = 8;
#else
constexpr int kWidth = 4;
#endif

typedef float Vector __attribute__((vector_size(kWidth * sizeof(float))));
typedef int IntegerVector __attribute__((vector_size(kWidth * sizeof(int))));

/// Vectors that go through the same operations side by side: a processor looks only so far ahead, and would wait for
/// one vector's result before it starts with the next.
template <int kCount>
struct Vectors {
  Vector of[kCount];
};
using Group = Vectors<kLaneGroup / kWidth>;

#define LSTM_PLANNER_EACH for (int i = 0; i < kCount; ++i)

template <class V>
constexpr int kCountOf = static_cast<int>(sizeof(V) / sizeof(Vector));

/// One vector after the other: a compiler keeps in memory what is copied as a whole.
template <class V>
LSTM_PLANNER_INLINE V load(const float* values) {
  V vectors;
  for (int i = 0; i < kCountOf<V>; ++i) __builtin_memcpy(&vectors.of[i], values + i * kWidth, sizeof(Vector));
  return vectors;
}
template <class V>
LSTM_PLANNER_INLINE void store(const V& vectors, float* values) {
  for (int i = 0; i < kCountOf<V>; ++i) __builtin_memcpy(values + i * kWidth, &vectors.of[i], sizeof(Vector));
}

#define LSTM_PLANNER_OPERATOR(sign)                                                                \
  template <int kCount>                                                                            \
  LSTM_PLANNER_INLINE Vectors<kCount> operator sign(Vectors<kCount> a, const Vectors<kCount>& b) { \
    LSTM_PLANNER_EACH a.of[i] = a.of[i] sign b.of[i];                                              \
    return a;                                                                                      \
  }                                                                                                \
  template <int kCount>                                                                            \
  LSTM_PLANNER_INLINE Vectors<kCount> operator sign(Vectors<kCount> a, float b) {                  \
    LSTM_PLANNER_EACH a.of[i] = a.of[i] sign b;                                                    \
    return a;                                                                                      \
  }                                                                                                \
  template <int kCount>                                                                            \
  LSTM_PLANNER_INLINE Vectors<kCount> operator sign(float a, Vectors<kCount> b) {                  \
    LSTM_PLANNER_EACH b.of[i] = a sign b.of[i];                                                    \
    return b;                                                                                      \
  }
LSTM_PLANNER_OPERATOR(+)
LSTM_PLANNER_OPERATOR(-)
LSTM_PLANNER_OPERATOR(*)
LSTM_PLANNER_OPERATOR(/)
#undef LSTM_PLANNER_OPERATOR

LSTM_PLANNER_INLINE float sumOf(const Group& group) {
  float lanes[kLaneGroup];
  store(group, lanes);
  float sum = 0.0f;
  for (const float lane : lanes) sum += lane;
  return sum;
}

template <int kCount>
LSTM_PLANNER_INLINE Vectors<kCount> limited(Vectors<kCount> x, float limit) {
  const Vector upper = Vector{} + limit;
  const Vector lower = -upper;
  LSTM_PLANNER_EACH x.of[i] = x.of[i] > lower ? x.of[i] : lower;
  LSTM_PLANNER_EACH x.of[i] = x.of[i] < upper ? x.of[i] : upper;
  return x;
}

template <int kCount>
LSTM_PLANNER_INLINE Vectors<kCount> powerOfTwo(Vectors<kCount> exponent) {
  LSTM_PLANNER_EACH {
    const IntegerVector bits = (__builtin_convertvector(exponent.of[i], IntegerVector) + 127) << 23;
    __builtin_memcpy(&exponent.of[i], &bits, sizeof(bits));
  }
  return exponent;
}

/// exp(x) for |x| <= 87: 2^n times the series of exp on +-ln(2)/2, whose first term left out is 1.2e-7 of the sum.
template <class V>
LSTM_PLANNER_INLINE V exponential(const V& x) {
  constexpr float kLog2e = 1.44269504f;
  constexpr float kLn2High = 0.693359375f;
  constexpr float kLn2Low = -2.12194440e-4f;
  constexpr float kRound = 12582912.0f;  // 1.5 * 2^23: adding it leaves no room for fractions
  const V rounded = (x * kLog2e + kRound) - kRound;
  const V rest = (x - rounded * kLn2High) - rounded * kLn2Low;
  V series = rest * (1.0f / 720.0f) + (1.0f / 120.0f);
  series = series * rest + (1.0f / 24.0f);
  series = series * rest + (1.0f / 6.0f);
  series = series * rest + 0.5f;
  series = series * rest + 1.0f;
  series = series * rest + 1.0f;
  return series * powerOfTwo(rounded);
}

template <class V>
LSTM_PLANNER_INLINE V sigmoid(const V& x) {
  return 1.0f / (1.0f + exponential(-1.0f * limited(x, 30.0f)));
}

template <class V>
LSTM_PLANNER_INLINE V hyperbolicTangent(const V& x) {
  return 2.0f * sigmoid(2.0f * x) - 1.0f;
}

}  // namespace
}  // namespace lstm_planner
