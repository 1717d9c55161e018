#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace lstm_planner {

/// Four numbers side by side, as every x86-64 and ARMv8 processor can compute them at once. What is compared is a mask:
/// all bits of a lane, or none.
using Floats = float __attribute__((vector_size(16)));
using Ints = std::int32_t __attribute__((vector_size(16)));
using Longs = std::int64_t __attribute__((vector_size(16)));
using Doubles = double __attribute__((vector_size(16)));  ///< only two

constexpr int kLanes = 4;

inline Floats allOf(float value) { return Floats{value, value, value, value}; }
inline Doubles allOf(double value) { return Doubles{value, value}; }
inline Ints allOf(std::int32_t value) { return Ints{value, value, value, value}; }

/// Numbers that start anywhere in memory.
inline Doubles loadDoubles(const double* from) {
  Doubles values;
  std::memcpy(&values, from, sizeof(values));
  return values;
}
inline Floats loadFloats(const float* from) {
  Floats values;
  std::memcpy(&values, from, sizeof(values));
  return values;
}
/// The first of four, the others 0.
inline Floats loadFloats(const float* from, long count) {
  Floats values = {};
  std::memcpy(&values, from, sizeof(float) * static_cast<std::size_t>(count));
  return values;
}
inline void store(Floats values, float* to) { std::memcpy(to, &values, sizeof(values)); }
inline void store(Doubles values, double* to) { std::memcpy(to, &values, sizeof(values)); }
inline void store(Ints values, std::int32_t* to) { std::memcpy(to, &values, sizeof(values)); }

inline Ints bitsOf(Floats values) { return reinterpret_cast<Ints>(values); }
inline Floats floatsOf(Ints bits) { return reinterpret_cast<Floats>(bits); }

inline Floats select(Ints mask, Floats yes, Floats no) { return floatsOf((bitsOf(yes) & mask) | (bitsOf(no) & ~mask)); }
/// The second where either is NaN.
inline Floats lesser(Floats a, Floats b) { return a < b ? a : b; }
inline Floats greater(Floats a, Floats b) { return a > b ? a : b; }
inline Doubles lesser(Doubles a, Doubles b) { return a < b ? a : b; }
inline Doubles greater(Doubles a, Doubles b) { return a > b ? a : b; }
inline Floats magnitude(Floats values) { return floatsOf(bitsOf(values) & allOf(std::int32_t{0x7fffffff})); }

inline Doubles magnitude(Doubles values) {
  constexpr std::int64_t kSignless = 0x7fffffffffffffff;
  return reinterpret_cast<Doubles>(reinterpret_cast<Longs>(values) & Longs{kSignless, kSignless});
}

/// Rounded towards 0.
inline Ints toInts(Floats values) { return __builtin_convertvector(values, Ints); }
inline Floats toFloats(Ints values) { return __builtin_convertvector(values, Floats); }

inline std::int32_t sumOfLanes(Ints values) { return values[0] + values[1] + values[2] + values[3]; }

inline float mostOf(Floats values) {
  const Floats two = greater(values, Floats{values[2], values[3], values[2], values[3]});
  return two[0] > two[1] ? two[0] : two[1];
}

/// True when any lane of a mask is set.
template <typename Mask>
inline bool any(Mask mask) {
  std::int64_t halves[2];
  static_assert(sizeof(mask) == sizeof(halves), "16 bytes");
  std::memcpy(halves, &mask, sizeof(halves));
  return (halves[0] | halves[1]) != 0;
}

inline Doubles firstTwo(Floats values) {
  float __attribute__((vector_size(8))) two;
  std::memcpy(&two, &values, sizeof(two));
  return __builtin_convertvector(two, Doubles);
}
inline Doubles lastTwo(Floats values) { return firstTwo(Floats{values[2], values[3], values[2], values[3]}); }

/// Four pairs that follow one another, in single precision: the first numbers and the second ones.
inline void splitPairs(const double* pairs, Floats* first, Floats* second) {
  using Two = float __attribute__((vector_size(8)));
  const Two a = __builtin_convertvector(loadDoubles(pairs), Two);
  const Two b = __builtin_convertvector(loadDoubles(pairs + 2), Two);
  const Two c = __builtin_convertvector(loadDoubles(pairs + 4), Two);
  const Two d = __builtin_convertvector(loadDoubles(pairs + 6), Two);
  *first = Floats{a[0], b[0], c[0], d[0]};
  *second = Floats{a[1], b[1], c[1], d[1]};
}

}  // namespace lstm_planner
