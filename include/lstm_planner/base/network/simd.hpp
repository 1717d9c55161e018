#pragma once

// Vectors of 4, 8 or 16 floats and the functions of a network on them, for kernels that are compiled once for each
// instruction set (*_baseline.cpp, *_avx2.cpp, *_avx512.cpp).
//
// All of it has internal linkage, unlike what a header usually holds: were these functions shared between files, the
// linker might keep the copy that was compiled for AVX-512 and an older machine would stop at it. A file that includes
// this header must not include Eigen or templates of the standard library for the same reason.

#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

// Vectors are handed over between inlined functions only, so that how they are passed does not matter.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

#define LSTM_PLANNER_INLINE __attribute__((always_inline, unused)) inline

namespace lstm_planner::simd {
namespace {

template <int kLanes>
struct VectorOf;
template <>
struct VectorOf<4> {
  typedef float Floats __attribute__((vector_size(16)));
  typedef int Integers __attribute__((vector_size(16)));
};
template <>
struct VectorOf<8> {
  typedef float Floats __attribute__((vector_size(32)));
  typedef int Integers __attribute__((vector_size(32)));
};
template <>
struct VectorOf<16> {
  typedef float Floats __attribute__((vector_size(64)));
  typedef int Integers __attribute__((vector_size(64)));
};

template <int kLanes>
using Floats = typename VectorOf<kLanes>::Floats;

template <class V>
constexpr int kLanesOf = static_cast<int>(sizeof(V) / sizeof(float));

template <class V>
using IntegersOf = typename VectorOf<kLanesOf<V>>::Integers;

/// The widest vector of the instruction set that this file is compiled for.
#if defined(__AVX512F__)
constexpr int kWidest = 16;
#elif defined(__AVX__)
constexpr int kWidest = 8;
#else
constexpr int kWidest = 4;
#endif

template <class V>
LSTM_PLANNER_INLINE V load(const float* values) {
  V vector;
  __builtin_memcpy(&vector, values, sizeof(V));
  return vector;
}

template <class V>
LSTM_PLANNER_INLINE void store(float* values, V vector) {
  __builtin_memcpy(values, &vector, sizeof(V));
}

/// Stores only the first `count` lanes.
template <class V>
LSTM_PLANNER_INLINE void storeFirst(float* values, V vector, int count) {
  if (count >= kLanesOf<V>) {
    store(values, vector);
    return;
  }
  float lanes[kLanesOf<V>];
  store(lanes, vector);
  for (int lane = 0; lane < count; ++lane) values[lane] = lanes[lane];
}

/// a * b + c, in one instruction where there is one.
template <class V>
LSTM_PLANNER_INLINE V multiplyAdd(V a, V b, V c) {
  return a * b + c;
}

#if defined(__SSE2__)
LSTM_PLANNER_INLINE bool noneIsNan(Floats<4> v) { return _mm_movemask_ps(_mm_cmpunord_ps(v, v)) == 0; }
#endif
#if defined(__AVX__)
LSTM_PLANNER_INLINE bool noneIsNan(Floats<8> v) { return _mm256_movemask_ps(_mm256_cmp_ps(v, v, _CMP_UNORD_Q)) == 0; }
#endif
#if defined(__AVX512F__)
LSTM_PLANNER_INLINE bool noneIsNan(Floats<16> v) { return _mm512_cmp_ps_mask(v, v, _CMP_UNORD_Q) == 0; }
#endif
#if !defined(__SSE2__)
template <class V>
LSTM_PLANNER_INLINE bool noneIsNan(V v) {
  bool none = true;
  for (int lane = 0; lane < kLanesOf<V>; ++lane) none &= v[lane] == v[lane];
  return none;
}
#endif

/// The second argument where one is NaN.
template <class V>
LSTM_PLANNER_INLINE V minimum(V a, V b) {
  return a < b ? a : b;
}
template <class V>
LSTM_PLANNER_INLINE V maximum(V a, V b) {
  return a > b ? a : b;
}
// The same in one instruction; GCC makes two of a comparison with a constant.
#if defined(__SSE2__)
LSTM_PLANNER_INLINE Floats<4> minimum(Floats<4> a, Floats<4> b) { return _mm_min_ps(a, b); }
LSTM_PLANNER_INLINE Floats<4> maximum(Floats<4> a, Floats<4> b) { return _mm_max_ps(a, b); }
#endif
#if defined(__AVX__)
LSTM_PLANNER_INLINE Floats<8> minimum(Floats<8> a, Floats<8> b) { return _mm256_min_ps(a, b); }
LSTM_PLANNER_INLINE Floats<8> maximum(Floats<8> a, Floats<8> b) { return _mm256_max_ps(a, b); }
#endif
#if defined(__AVX512F__)
// With a mask of all lanes, as GCC warns about what it does itself inside the forms without one.
LSTM_PLANNER_INLINE Floats<16> minimum(Floats<16> a, Floats<16> b) { return _mm512_maskz_min_ps(0xffff, a, b); }
LSTM_PLANNER_INLINE Floats<16> maximum(Floats<16> a, Floats<16> b) { return _mm512_maskz_max_ps(0xffff, a, b); }
#endif

/// Vectors that go through the same functions side by side. Written one after the other, their chains of instructions
/// would be so long that the processor looks no further than the first ones, and waits.
template <class V, int n>
struct Group {
  V of[n];
};

#define LSTM_PLANNER_FOR_GROUP(expression)                                            \
  Group<V, n> result;                                                                 \
  _Pragma("GCC unroll 16") for (int i = 0; i < n; ++i) { result.of[i] = expression; } \
  return result

template <class V, int n>
LSTM_PLANNER_INLINE Group<V, n> operator*(const Group<V, n>& a, const Group<V, n>& b) {
  LSTM_PLANNER_FOR_GROUP(a.of[i] * b.of[i]);
}
template <class V, int n>
LSTM_PLANNER_INLINE Group<V, n> operator/(const Group<V, n>& a, const Group<V, n>& b) {
  LSTM_PLANNER_FOR_GROUP(a.of[i] / b.of[i]);
}
template <class V, int n>
LSTM_PLANNER_INLINE Group<V, n> multiplyAdd(const Group<V, n>& a, const Group<V, n>& b, const Group<V, n>& c) {
  LSTM_PLANNER_FOR_GROUP(multiplyAdd(a.of[i], b.of[i], c.of[i]));
}
template <class V, int n>
LSTM_PLANNER_INLINE Group<V, n> minimum(const Group<V, n>& a, const Group<V, n>& b) {
  LSTM_PLANNER_FOR_GROUP(minimum(a.of[i], b.of[i]));
}
template <class V, int n>
LSTM_PLANNER_INLINE Group<V, n> maximum(const Group<V, n>& a, const Group<V, n>& b) {
  LSTM_PLANNER_FOR_GROUP(maximum(a.of[i], b.of[i]));
}

template <class V>
struct Broadcast {
  static LSTM_PLANNER_INLINE V of(float value) {
    return value - V{};  // not V{} + value: -0 would become 0, and the compiler would have to add
  }
};
template <class V, int n>
struct Broadcast<Group<V, n>> {
  static LSTM_PLANNER_INLINE Group<V, n> of(float value) { LSTM_PLANNER_FOR_GROUP(Broadcast<V>::of(value)); }
};

#undef LSTM_PLANNER_FOR_GROUP

/// One number in all lanes.
template <class V>
LSTM_PLANNER_INLINE V broadcast(float value) {
  return Broadcast<V>::of(value);
}

template <class V>
LSTM_PLANNER_INLINE V clamp(V value, float limit) {
  return maximum(minimum(value, broadcast<V>(limit)), broadcast<V>(-limit));
}

/// 0 where the value is so small that products with it would soon be denormal, on which processors are slow.
template <class V>
LSTM_PLANNER_INLINE V flushTiny(V value) {
  constexpr float kTiny = 1e-15f;
  const auto is_tiny = (value < broadcast<V>(kTiny)) & (value > broadcast<V>(-kTiny));
  return is_tiny ? V{} : value;
}

/// A quotient that is not yet divided: a division takes as long as three products and keeps others waiting, and the
/// quotients of a product can share one.
template <class V>
struct Fraction {
  V numerator;
  V denominator;
};

template <class V>
LSTM_PLANNER_INLINE V value(Fraction<V> fraction) {
  return fraction.numerator / fraction.denominator;
}

/// Polynomials with tanh(x) = x P(x^2) / Q(x^2) within 2e-8 on [-9, 9] (a minimax fit); single precision adds the rest.
/// All coefficients are positive, so that nothing cancels. Beyond the limit x stands still, at a value where single
/// precision makes the fraction exactly 1, fused or not: a gate that is wide open must not lose a little in each step.
constexpr float kTanhLimit = 8.9802084f;
constexpr float kTanhP[] = {0.9999999063609005f, 0.13373195814186573f, 0.003486579645748473f, 2.0471793541624834e-05f,
                            1.3184173505153228e-08f};
constexpr float kTanhQ[] = {1.0f, 0.4670649267895692f, 0.02584197066824877f, 0.0003271381704823882f,
                            7.70264264224115e-07f};

/// Sums of neighbouring terms first: half as many steps one after the other as in Horner's scheme.
template <class V>
LSTM_PLANNER_INLINE V evenPolynomial(const float (&c)[5], V square, V fourth_power) {
  const V low = multiplyAdd(broadcast<V>(c[1]), square, broadcast<V>(c[0]));
  const V middle = multiplyAdd(broadcast<V>(c[3]), square, broadcast<V>(c[2]));
  const V high = multiplyAdd(broadcast<V>(c[4]), fourth_power, middle);
  return multiplyAdd(high, fourth_power, low);
}

template <class V>
struct TanhTerms {
  V limited_x;
  V p;
  V q;
};

/// Infinities give -1 and 1; so does NaN, which is to be found before.
template <class V>
LSTM_PLANNER_INLINE TanhTerms<V> tanhTerms(V x) {
  // A tiny summand, since powers of a tiny x would be too small for a float, which takes time even if they become 0.
  const V square = minimum(multiplyAdd(x, x, broadcast<V>(1e-12f)), broadcast<V>(kTanhLimit * kTanhLimit));
  const V fourth_power = square * square;
  return {clamp(x, kTanhLimit), evenPolynomial(kTanhP, square, fourth_power),
          evenPolynomial(kTanhQ, square, fourth_power)};
}

/// `factor` times tanh(x), at no cost in time: x waits for the polynomials.
template <class V>
LSTM_PLANNER_INLINE Fraction<V> tanhFraction(V x, float factor = 1.0f) {
  const TanhTerms<V> terms = tanhTerms(x);
  return {broadcast<V>(factor) * terms.limited_x * terms.p, terms.q};
}

/// Twice the sigmoid of 2 x: 1 + tanh(x). The factors are left to the caller, who may have them in the weights.
template <class V>
LSTM_PLANNER_INLINE Fraction<V> twiceSigmoidOfTwiceFraction(V x) {
  const TanhTerms<V> terms = tanhTerms(x);
  return {multiplyAdd(terms.limited_x, terms.p, terms.q), terms.q};
}

/// Within 4e-7.
template <class V>
LSTM_PLANNER_INLINE V tanh(V x) {
  return value(tanhFraction(x));
}

/// e^x within 4e-7 of its size, for x limited to [-87, 87].
template <class V>
LSTM_PLANNER_INLINE V exponential(V x) {
  constexpr float kRounder = 12582912.0f;  // 1.5 * 2^23: a sum with it holds an integer in its last bits
  constexpr float kTaylor[] = {1.0f / 120.0f, 1.0f / 24.0f, 1.0f / 6.0f, 0.5f, 1.0f, 1.0f};
  const V limited = clamp(x, 87.0f);
  const V rounded = multiplyAdd(limited, broadcast<V>(1.44269504f), broadcast<V>(kRounder));
  const V exponent = rounded - broadcast<V>(kRounder);
  const V rest = limited - exponent * broadcast<V>(0.693359375f) - exponent * broadcast<V>(-2.12194440e-4f);
  V sum = broadcast<V>(1.0f / 720.0f);
  for (const float coefficient : kTaylor) sum = multiplyAdd(sum, rest, broadcast<V>(coefficient));
  const IntegersOf<V> power_of_two = ((IntegersOf<V>)rounded << 23) + (127 << 23);
  return sum * (V)power_of_two;
}

/// Unlike 1 + tanh it is as exact for large negative x, relative to its size, as for others.
template <class V>
LSTM_PLANNER_INLINE V sigmoid(V x) {
  const V one = broadcast<V>(1.0f);
  return one / (one + exponential(-x));
}

}  // namespace
}  // namespace lstm_planner::simd
