#pragma once

#include "lstm_planner/common/simd.hpp"

namespace lstm_planner {

// The vectors that every processor has, for code that is compiled once.

constexpr int kLanes = 4;
using Floats = simd::Floats<kLanes>;
using Ints = simd::Integers<kLanes>;
typedef double Doubles __attribute__((vector_size(16)));      ///< two
typedef double FourDoubles __attribute__((vector_size(32)));  ///< compilers make two vectors of it

LSTM_PLANNER_INLINE Floats allOf(float value) { return simd::broadcast<Floats>(value); }
LSTM_PLANNER_INLINE Ints allOf(int value) { return simd::broadcast<Ints>(value); }
LSTM_PLANNER_INLINE Floats loadFloats(const float* from) { return simd::load<Floats>(from); }

using simd::any;
using simd::magnitude;
using simd::maximum;
using simd::minimum;
using simd::store;

}  // namespace lstm_planner
