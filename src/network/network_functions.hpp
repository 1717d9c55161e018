#pragma once

// What the kernels of a network do with vectors besides sums; of internal linkage, as simd.hpp explains.

#include "lstm_planner/common/simd.hpp"

namespace lstm_planner::simd {
namespace {

/// A quotient that is not yet divided: a division takes as long as three products and keeps others waiting, and the
/// quotients of a product can share one.
template <class V>
struct Fraction {
  V numerator;
  V denominator;
};

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

/// Within 4e-7.
template <class V>
LSTM_PLANNER_INLINE V tanh(V x) {
  const TanhTerms<V> terms = tanhTerms(x);
  return terms.limited_x * terms.p / terms.q;
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
