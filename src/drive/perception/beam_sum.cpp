#include "drive/perception/beam_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drive/perception/baseline_vectors.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {
namespace {

/// Every second four beams: an addition need not wait for the one before.
class BeamAdder {
 public:
  explicit BeamAdder(float cap) : cap_(cap) {}

  LSTM_PLANNER_INLINE void add(Floats ranges) {
    const Floats infinity = allOf(kInfinity);
    const Ints sees = ranges > Floats{};
    const Ints is_uncapped = sees & (ranges < allOf(cap_));
    range_ += __builtin_convertvector(is_uncapped ? ranges : Floats{}, FourDoubles);
    nearest_ = minimum(sees ? ranges : infinity, nearest_);
    measured_ -= sees & (ranges < infinity);
    sees_ -= sees;
    silent_ -= ranges == allOf(RangeProfile::kSilent);
    uncapped_ -= is_uncapped;
  }

  BeamSum sum(const BeamAdder& others, double cap) const {
    const FourDoubles range = range_ + others.range_;
    BeamSum sum;
    sum.silent = sumOf(silent_ + others.silent_);
    sum.known = sumOf(sees_ + others.sees_) + sum.silent;
    sum.measured = sumOf(measured_ + others.measured_);
    sum.range = range[0] + range[2] + (range[1] + range[3]) + (sum.known - sumOf(uncapped_ + others.uncapped_)) * cap;
    const Floats nearest = minimum(nearest_, others.nearest_);
    sum.nearest = std::min({nearest[0], nearest[1], nearest[2], nearest[3]});
    return sum;
  }

 private:
  static int sumOf(Ints counts) { return counts[0] + counts[1] + counts[2] + counts[3]; }

  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  float cap_;
  FourDoubles range_ = {};
  Floats nearest_ = allOf(kInfinity);
  Ints measured_ = {};
  Ints sees_ = {};
  Ints silent_ = {};
  Ints uncapped_ = {};
};

}  // namespace

BeamSum sumOfBeams(const float* ranges, std::size_t count, double cap) {
  auto float_cap = static_cast<float>(cap);
  // No float lies between the two.
  if (float_cap < cap) float_cap = std::nextafter(float_cap, std::numeric_limits<float>::max());
  BeamAdder even(float_cap);
  BeamAdder odd(float_cap);
  constexpr std::size_t kTogether = 2 * kLanes;
  std::size_t i = 0;
  for (; i + kTogether <= count; i += kTogether) {
    even.add(loadFloats(ranges + i));
    odd.add(loadFloats(ranges + i + kLanes));
  }
  float rest[kTogether] = {};  // an unknown range adds nothing
  std::copy(ranges + i, ranges + count, rest);
  even.add(loadFloats(rest));
  odd.add(loadFloats(rest + kLanes));
  return even.sum(odd, cap);
}

}  // namespace lstm_planner
