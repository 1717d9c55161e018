#pragma once

// Included by scan_kernels_source.hpp: what is done with each beam of a scan. Everything has internal linkage, as
// simd.hpp explains. All instruction sets answer the same to the last bit.

#include "lstm_planner/base/common/simd.hpp"
#include "robot/perception/scan_kernels.hpp"

namespace lstm_planner {
namespace {

using namespace simd;

using Wide = Floats<kWidest>;

constexpr float kInfinity = __builtin_huge_valf();
constexpr float kSilent = -1.0f;  ///< RangeProfile::kSilent

template <class V>
LSTM_PLANNER_INLINE V meaningOf(const ReadingBounds& bounds, V readings) {
  using Integers = IntegersOf<V>;
  const Integers measured = (readings >= broadcast<V>(bounds.least)) & (readings <= broadcast<V>(bounds.most));
  const Integers nothing =
      (readings >= broadcast<V>(bounds.nothing_from)) |
      ((readings >= broadcast<V>(bounds.code_first)) & (readings <= broadcast<V>(bounds.code_last)));
  if (!any(~measured | nothing)) return readings;  // nearly always
  const Integers silent =
      ((readings != readings) & (Integers{} + bounds.nan_is_silent)) |
      ((readings == V{}) & (Integers{} + bounds.zero_is_silent)) |
      ((readings > V{}) & (readings < broadcast<V>(bounds.least)) & (Integers{} + bounds.below_is_silent));
  const Integers too_near = readings == broadcast<V>(-kInfinity);
  V meaning = select(measured, readings, V{});
  meaning = select(silent, broadcast<V>(kSilent), meaning);
  meaning = select(too_near, readings, meaning);
  return select(nothing, broadcast<V>(kInfinity), meaning);
}

void meanings(const ReadingBounds& bounds, const float* readings, std::size_t count, float* ranges) {
  std::size_t i = 0;
  for (; i + kWidest <= count; i += kWidest) store(meaningOf(bounds, load<Wide>(readings + i)), ranges + i);
  for (; i < count; ++i) ranges[i] = meaningOf(bounds, broadcast<Floats<4>>(readings[i]))[0];
}

/// Adds up beams, eight by eight whatever the instruction set, so that all round alike.
class BeamAdder {
 public:
  explicit BeamAdder(float cap) : cap_(cap) {}

  LSTM_PLANNER_INLINE void add(const Floats<8>& ranges) {
    const Floats<8> infinity = broadcast<Floats<8>>(kInfinity);
    const Integers<8> sees = ranges > Floats<8>{};
    const Integers<8> is_uncapped = sees & (ranges < broadcast<Floats<8>>(cap_));
    const Floats<8> uncapped = select(is_uncapped, ranges, Floats<8>{});
    first_ += __builtin_convertvector((Floats<4>{uncapped[0], uncapped[1], uncapped[2], uncapped[3]}), FourDoubles);
    last_ += __builtin_convertvector((Floats<4>{uncapped[4], uncapped[5], uncapped[6], uncapped[7]}), FourDoubles);
    nearest_ = minimum(select(sees, ranges, infinity), nearest_);
    measured_ -= sees & (ranges < infinity);
    sees_ -= sees;
    silent_ -= ranges == broadcast<Floats<8>>(kSilent);
    uncapped_ -= is_uncapped;
  }

  LSTM_PLANNER_INLINE BeamSum sum(double cap) const {
    BeamSum sum;
    const FourDoubles all = first_ + last_;
    sum.silent = sumOfLanes(silent_);
    sum.known = sumOfLanes(sees_) + sum.silent;
    sum.measured = sumOfLanes(measured_);
    sum.range = all[0] + all[2] + (all[1] + all[3]) + rounded((sum.known - sumOfLanes(uncapped_)) * cap);
    sum.nearest = kInfinity;
    for (int lane = 0; lane < 8; ++lane) sum.nearest = nearest_[lane] < sum.nearest ? nearest_[lane] : sum.nearest;
    return sum;
  }

 private:
  float cap_;
  FourDoubles first_ = {};
  FourDoubles last_ = {};
  Floats<8> nearest_ = kInfinity - Floats<8>{};
  Integers<8> measured_ = {};
  Integers<8> sees_ = {};
  Integers<8> silent_ = {};
  Integers<8> uncapped_ = {};
};

BeamSum sum(const float* ranges, std::size_t count, double cap) {
  auto float_cap = static_cast<float>(cap);
  if (float_cap < cap) float_cap = __builtin_nextafterf(float_cap, kInfinity);  // no float lies between the two
  BeamAdder adder(float_cap);
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) adder.add(load<Floats<8>>(ranges + i));
  if (i < count) adder.add(loadFirst<Floats<8>>(ranges + i, static_cast<long>(count - i)));
  return adder.sum(cap);
}

/// A return with a range.
LSTM_PLANNER_INLINE bool isReturn(float range) { return range > 0.0f && range < kInfinity; }

std::size_t points(const float* ranges, std::size_t count, double nearest_range, const double* origin,
                   const double* directions, double* points) {
  const FourDoubles from = {origin[0], origin[1], origin[0], origin[1]};
  double* to = points;
  // Two points from two ranges, each twice.
  const auto addTwo = [&](const FourDoubles& twice, const double* along) __attribute__((always_inline)) {
    store(from + rounded(twice * load<FourDoubles>(along)), to);
    to += 4;
  };
  for (std::size_t i = 0; i < count;) {
    // Returns lie side by side. Where the place of each depends on the one before, the processor waits.
    if (i + 8 <= count) {
      const auto eight = load<Floats<8>>(ranges + i);
      if (!any(~((eight > Floats<8>{}) & (eight < broadcast<Floats<8>>(kInfinity))))) {
        for (int half = 0; half < 2; ++half) {
          const auto four = __builtin_convertvector(load<Floats<4>>(ranges + i), FourDoubles);
          addTwo(FourDoubles{four[0], four[0], four[1], four[1]}, directions + 2 * i);
          addTwo(FourDoubles{four[2], four[2], four[3], four[3]}, directions + 2 * i + 4);
          i += 4;
        }
        continue;
      }
    }
    // Written in any case, and overwritten by the next: faster than a jump that nobody can foresee.
    const bool too_near = ranges[i] == -kInfinity;
    const double range = too_near ? nearest_range : ranges[i];
    to[0] = origin[0] + rounded(range * directions[2 * i]);
    to[1] = origin[1] + rounded(range * directions[2 * i + 1]);
    to += isReturn(ranges[i]) || too_near ? 2 : 0;
    ++i;
  }
  return static_cast<std::size_t>(to - points) / 2;
}

}  // namespace
}  // namespace lstm_planner
