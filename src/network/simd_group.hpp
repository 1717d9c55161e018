#pragma once

// Several vectors that go through the functions of simd.hpp together: each operation on all of them before the next
// one. A processor looks only so far ahead; were one vector's activation computed after the other's, each would wait
// for what the last one waits for.

#include "simd.hpp"

namespace lstm_planner::simd {
namespace {

template <class V, int kCount>
struct Group {
  V part[kCount];
};

template <class V, int kCount>
LSTM_PLANNER_INLINE Group<V, kCount> operator*(const Group<V, kCount>& a, const Group<V, kCount>& b) {
  Group<V, kCount> product;
  for (int i = 0; i < kCount; ++i) product.part[i] = a.part[i] * b.part[i];
  return product;
}
template <class V, int kCount>
LSTM_PLANNER_INLINE Group<V, kCount> operator/(const Group<V, kCount>& a, const Group<V, kCount>& b) {
  Group<V, kCount> quotient;
  for (int i = 0; i < kCount; ++i) quotient.part[i] = a.part[i] / b.part[i];
  return quotient;
}
/// What broadcast() is made of.
template <class V, int kCount>
LSTM_PLANNER_INLINE Group<V, kCount> operator-(float value, const Group<V, kCount>& /*zero*/) {
  Group<V, kCount> group;
  for (int i = 0; i < kCount; ++i) group.part[i] = broadcast<V>(value);
  return group;
}
template <class V, int kCount>
LSTM_PLANNER_INLINE Group<V, kCount> multiplyAdd(Group<V, kCount> a, Group<V, kCount> b, Group<V, kCount> c) {
  Group<V, kCount> result;
  for (int i = 0; i < kCount; ++i) result.part[i] = multiplyAdd(a.part[i], b.part[i], c.part[i]);
  return result;
}
template <class V, int kCount>
LSTM_PLANNER_INLINE Group<V, kCount> minimum(Group<V, kCount> a, Group<V, kCount> b) {
  Group<V, kCount> result;
  for (int i = 0; i < kCount; ++i) result.part[i] = minimum(a.part[i], b.part[i]);
  return result;
}
template <class V, int kCount>
LSTM_PLANNER_INLINE Group<V, kCount> maximum(Group<V, kCount> a, Group<V, kCount> b) {
  Group<V, kCount> result;
  for (int i = 0; i < kCount; ++i) result.part[i] = maximum(a.part[i], b.part[i]);
  return result;
}
template <class V, int kCount>
LSTM_PLANNER_INLINE Group<V, kCount> flushTiny(Group<V, kCount> a) {
  Group<V, kCount> result;
  for (int i = 0; i < kCount; ++i) result.part[i] = flushTiny(a.part[i]);
  return result;
}

}  // namespace
}  // namespace lstm_planner::simd
