#pragma once

// Vectors of numbers on which one instruction works: 4, 8 or 16 floats or integers. Every x86-64 and ARMv8 processor
// has vectors of 16 bytes. The wider ones are for kernels, which are compiled once for each instruction set
// (*_baseline.cpp, *_avx2.cpp, *_avx512.cpp).
//
// Everything here has internal linkage. If these functions were shared between files, the linker might keep the copy
// that was compiled for AVX-512, and an older machine would crash. For the same reason a kernel must not include Eigen
// or templates of the standard library.

#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

// Vectors are passed only between inlined functions, so how they are passed does not matter.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

#define LSTM_PLANNER_INLINE __attribute__((always_inline, unused)) inline

namespace lstm_planner::simd {
namespace {

/// Vectors of so many lanes, numbers side by side that one instruction works on.
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
/// What comparisons of floats give, too: all bits of a lane, or none.
template <int kLanes>
using Integers = typename VectorOf<kLanes>::Integers;

/// Vectors that go through the same functions side by side. If they were handled one after the other, the processor
/// would see only the instructions of the first vector, and wait.
template <class V, int n>
struct Group {
  V of[n];
};

/// The number that a vector is made of.
template <class V>
struct ElementOf {
  using Type = decltype(V{}[0] + V{}[0]);
};
template <class V, int n>
struct ElementOf<Group<V, n>> : ElementOf<V> {};
template <class V>
using Element = typename ElementOf<V>::Type;

template <class V>
constexpr int kLanesOf = static_cast<int>(sizeof(V) / sizeof(Element<V>));

template <class V>
using IntegersOf = Integers<kLanesOf<V>>;

/// The widest vector of the instruction set that this file is compiled for.
#if defined(__AVX512F__)
constexpr int kWidest = 16;
#elif defined(__AVX__)
constexpr int kWidest = 8;
#else
constexpr int kWidest = 4;
#endif

#define LSTM_PLANNER_FOR_GROUP(expression)                                            \
  Group<V, n> result;                                                                 \
  _Pragma("GCC unroll 16") for (int i = 0; i < n; ++i) { result.of[i] = expression; } \
  return result

/// Reads numbers from any address.
template <class V>
LSTM_PLANNER_INLINE V load(const Element<V>* from) {
  V vector;
  __builtin_memcpy(&vector, from, sizeof(V));
  return vector;
}
/// Copies one vector after the other: what is copied as a whole, a compiler keeps in memory.
template <class G>
LSTM_PLANNER_INLINE G loadGroup(const Element<G>* from) {
  G group;
  for (auto& vector : group.of) {
    __builtin_memcpy(&vector, from, sizeof(vector));
    from += sizeof(vector) / sizeof(*from);
  }
  return group;
}

template <class V>
LSTM_PLANNER_INLINE void store(V vector, Element<V>* to) {
  __builtin_memcpy(to, &vector, sizeof(V));
}
template <class V, int n>
LSTM_PLANNER_INLINE void store(const Group<V, n>& group, Element<V>* to) {
  for (int i = 0; i < n; ++i) __builtin_memcpy(to + i * kLanesOf<V>, &group.of[i], sizeof(V));
}
/// Stores only the first `count` lanes.
template <class V>
LSTM_PLANNER_INLINE void storeFirst(V vector, int count, Element<V>* to) {
  if (count >= kLanesOf<V>) {
    store(vector, to);
    return;
  }
  Element<V> lanes[kLanesOf<V>];
  store(vector, lanes);
  for (int lane = 0; lane < count; ++lane) to[lane] = lanes[lane];
}

/// See broadcast().
template <class V>
struct Broadcast {
  static LSTM_PLANNER_INLINE V of(Element<V> value) {
    return value - V{};  // not V{} + value: -0 would become 0, and the compiler would have to add
  }
};
template <class V, int n>
struct Broadcast<Group<V, n>> {
  static LSTM_PLANNER_INLINE Group<V, n> of(Element<V> value) { LSTM_PLANNER_FOR_GROUP(Broadcast<V>::of(value)); }
};
/// One number in all lanes.
template <class V>
LSTM_PLANNER_INLINE V broadcast(Element<V> value) {
  return Broadcast<V>::of(value);
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

#define LSTM_PLANNER_OPERATOR(sign)                                                           \
  template <class V, int n>                                                                   \
  LSTM_PLANNER_INLINE Group<V, n> operator sign(const Group<V, n>& a, const Group<V, n>& b) { \
    LSTM_PLANNER_FOR_GROUP(a.of[i] sign b.of[i]);                                             \
  }                                                                                           \
  template <class V, int n>                                                                   \
  LSTM_PLANNER_INLINE Group<V, n> operator sign(const Group<V, n>& a, Element<V> b) {         \
    LSTM_PLANNER_FOR_GROUP(a.of[i] sign b);                                                   \
  }                                                                                           \
  template <class V, int n>                                                                   \
  LSTM_PLANNER_INLINE Group<V, n> operator sign(Element<V> a, const Group<V, n>& b) {         \
    LSTM_PLANNER_FOR_GROUP(a sign b.of[i]);                                                   \
  }
LSTM_PLANNER_OPERATOR(+)
LSTM_PLANNER_OPERATOR(-)
LSTM_PLANNER_OPERATOR(*)
LSTM_PLANNER_OPERATOR(/)
#undef LSTM_PLANNER_OPERATOR

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

#undef LSTM_PLANNER_FOR_GROUP

template <class V>
LSTM_PLANNER_INLINE V clamp(V value, float limit) {
  return maximum(minimum(value, broadcast<V>(limit)), broadcast<V>(-limit));
}

}  // namespace
}  // namespace lstm_planner::simd
