#pragma once

// What the kernels of lane_kernels_source.hpp do with vectors besides sums; of internal linkage, as simd.hpp explains.
// Training is sensitive to the last bit: these functions round as they always did, unlike those of the inference.

#include "lstm_planner/common/simd.hpp"
#include "training/lane_kernels.hpp"

namespace lstm_planner {
namespace {

using namespace simd;

template <int n>
using Vectors = Group<Floats<kWidest>, n>;
/// As many lanes as rows are multiples of.
using LaneGroup = Vectors<kLaneGroup / kWidest>;

LSTM_PLANNER_INLINE float sumOf(const LaneGroup& group) {
  float lanes[kLaneGroup];
  store(group, lanes);
  float sum = 0.0f;
  for (const float lane : lanes) sum += lane;
  return sum;
}

/// exp(x) for |x| <= 87: 2^n times the series of exp on +-ln(2)/2, whose first term left out is 1.2e-7 of the sum.
template <int n>
LSTM_PLANNER_INLINE Vectors<n> exponential(const Vectors<n>& x) {
  constexpr float kLog2e = 1.44269504f;
  constexpr float kLn2High = 0.693359375f;
  constexpr float kLn2Low = -2.12194440e-4f;
  constexpr float kRound = 12582912.0f;  // 1.5 * 2^23: adding it leaves no room for fractions
  const Vectors<n> rounded = (x * kLog2e + kRound) - kRound;
  const Vectors<n> rest = (x - rounded * kLn2High) - rounded * kLn2Low;
  Vectors<n> series = rest * (1.0f / 720.0f) + (1.0f / 120.0f);
  series = series * rest + (1.0f / 24.0f);
  series = series * rest + (1.0f / 6.0f);
  series = series * rest + 0.5f;
  series = series * rest + 1.0f;
  series = series * rest + 1.0f;
  for (int i = 0; i < n; ++i) {
    const Integers<kWidest> exponent = __builtin_convertvector(rounded.of[i], Integers<kWidest>);
    series.of[i] = series.of[i] * (Floats<kWidest>)((exponent + 127) << 23);
  }
  return series;
}

template <int n>
LSTM_PLANNER_INLINE Vectors<n> sigmoid(const Vectors<n>& x) {
  constexpr float kLimit = 30.0f;
  const Vectors<n> limited =
      minimum(maximum(x, broadcast<Vectors<n>>(-kLimit)), broadcast<Vectors<n>>(kLimit));  // NaN: -kLimit
  return 1.0f / (1.0f + exponential(-1.0f * limited));
}

template <int n>
LSTM_PLANNER_INLINE Vectors<n> hyperbolicTangent(const Vectors<n>& x) {
  return 2.0f * sigmoid(2.0f * x) - 1.0f;
}

}  // namespace
}  // namespace lstm_planner
