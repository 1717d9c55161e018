// Included once by each shield_kernels_*.cpp, which are compiled for different instruction sets. Everything but the
// function at the end, SHIELD_KERNELS, has internal linkage, as simd.hpp explains.

#include "lstm_planner/base/common/simd.hpp"
#include "robot/driving/shield_kernels.hpp"

#if !defined(SHIELD_KERNELS)
#error "SHIELD_KERNELS names the function that this file defines"
#endif

namespace lstm_planner {
namespace {

using namespace simd;

using Wide = Floats<kWidest>;

constexpr double kInfinity = __builtin_huge_val();

LSTM_PLANNER_INLINE double square(double value) { return value * value; }
LSTM_PLANNER_INLINE double lesser(double a, double b) { return b < a ? b : a; }
LSTM_PLANNER_INLINE double greater(double a, double b) { return a < b ? b : a; }
LSTM_PLANNER_INLINE double root(double value) { return __builtin_sqrt(value); }

/// The square of a length; rounded before it is added up.
LSTM_PLANNER_INLINE double squareOfLength(Doubles vector) {
  const Doubles squares = rounded(vector * vector);
  return squares[0] + squares[1];
}

// ----------------------------------------------------------------- groups

/// The least of four, by coordinate.
LSTM_PLANNER_INLINE Doubles leastOf(const FourDoubles& x, const FourDoubles& y) {
  const FourDoubles two = minimum(firstOfPairs(x, y), secondOfPairs(x, y));
  return minimum(Doubles{two[0], two[1]}, Doubles{two[2], two[3]});
}
LSTM_PLANNER_INLINE Doubles mostOf(const FourDoubles& x, const FourDoubles& y) {
  const FourDoubles two = maximum(firstOfPairs(x, y), secondOfPairs(x, y));
  return maximum(Doubles{two[0], two[1]}, Doubles{two[2], two[3]});
}

std::size_t add(const double* places, std::size_t groups, double reach_squared, double* into_places, float* into_boxes,
                std::size_t* count) {
  for (std::size_t group = 0; group < groups; ++group, places += 2 * kReturnsAGroup) {
    double* const x = into_places + 2 * kReturnsAGroup * *count;
    double* const y = x + kReturnsAGroup;
    FourDoubles left = broadcast<FourDoubles>(kInfinity);
    FourDoubles bottom = left;
    FourDoubles right = -left;
    FourDoubles top = -left;
    for (std::size_t i = 0; i < kReturnsAGroup; i += 4) {
      const auto first = load<FourDoubles>(places + 2 * i);
      const auto second = load<FourDoubles>(places + 2 * i + 4);
      // In another order, which does not matter, and which needs fewer instructions.
      const FourDoubles xs = firstOfPairs(first, second);
      const FourDoubles ys = secondOfPairs(first, second);
      store(xs, x + i);
      store(ys, y + i);
      left = minimum(xs, left);
      right = maximum(xs, right);
      bottom = minimum(ys, bottom);
      top = maximum(ys, top);
    }
    const Doubles low = leastOf(left, bottom);
    const Doubles high = mostOf(right, top);
    if (squareOfLength(maximum(maximum(low, -high), Doubles{})) > reach_squared) continue;
    if (!(squareOfLength(maximum(-low, high)) <= reach_squared)) return group;
    const Doubles middle = 0.5 * (low + high);
    const Doubles half = 0.5 * (high - low);
    float* const box = into_boxes + *count / kGroupsABlock * kNumbersABlock + *count % kGroupsABlock;
    box[0] = static_cast<float>(middle[0]);
    box[kGroupsABlock] = static_cast<float>(middle[1]);
    box[2 * kGroupsABlock] = static_cast<float>(half[0]);
    box[3 * kGroupsABlock] = static_cast<float>(half[1]);
    ++*count;
  }
  return groups;
}

// ------------------------------------------------------------------ lines

/// Finds how far a disc can go, group by group.
class FreeLine {
 public:
  explicit FreeLine(const DiscLine& line)
      : line_(line),
        free_(line.limit),
        wanted_squared_(square(line.wanted)),
        touched_squared_(square(line.wanted + kShieldTouchSlack)) {}

  double free() const { return free_; }
  bool isKnown() const { return free_ <= 0.0 || free_ < line_.enough; }

  /// Four by four with what was free before the group, so that they need not wait for each other.
  LSTM_PLANNER_INLINE void meet(const double* places) {
    FourDoubles least = broadcast<FourDoubles>(free_);
    const double before = free_;
    for (std::size_t i = 0; i < kReturnsAGroup; i += 4) {
      const FourDoubles dx = load<FourDoubles>(places + i) - line_.from_x;
      const FourDoubles dy = load<FourDoubles>(places + kReturnsAGroup + i) - line_.from_y;
      const FourDoubles along = rounded(line_.along_x * dx) + rounded(line_.along_y * dy);
      const FourDoubles aside = magnitude(rounded(line_.along_x * dy) - rounded(line_.along_y * dx));
      const FourDoubles aside_squared = rounded(aside * aside);
      // What the disc does not reach before or at the end of what is free so far does not matter.
      const FourDoubles beyond = maximum(along - before, FourDoubles{});
      const auto matters = (along > FourDoubles{}) & (rounded(beyond * beyond) + aside_squared < wanted_squared_);
      const unsigned bits = bitsOfFour(matters);
      if (bits == 0) continue;
      if ((bits & bitsOfFour(rounded(along * along) + aside_squared < touched_squared_)) != 0) {
        meetNear(along, aside, bits);
        continue;
      }
      const FourDoubles until = maximum(along - squareRoots(wanted_squared_ - aside_squared), FourDoubles{});
      least = minimum(matters ? until : least, least);
    }
    free_ = lesser(free_, smallestOf(least));
  }

 private:
  /// Some of them are as near as they may ever come, or nearer.
  void meetNear(const FourDoubles& along, const FourDoubles& aside, unsigned bits) {
    for (; bits != 0; bits &= bits - 1) {
      const int lane = __builtin_ctz(bits);
      shorten(along[lane], aside[lane]);
    }
  }

  void shorten(double along, double aside) {
    const double squared = rounded(square(along)) + rounded(square(aside));
    double radius = line_.wanted;
    if (squared < touched_squared_) {
      const double now = root(squared);
      if (now <= line_.hard) {
        free_ = 0.0;
        return;
      }
      radius = greater(line_.hard, lesser(line_.wanted, now - kShieldTouchSlack));
    }
    if (aside >= radius) return;
    free_ = lesser(free_, greater(0.0, along - root(rounded(square(radius)) - rounded(square(aside)))));
  }

  const DiscLine& line_;
  double free_;  ///< m, so far
  double wanted_squared_;
  double touched_squared_;  ///< what is no farther may only come nearer by less than the slack
};

double freeLine(const ReturnGroups& groups, const DiscLine& line) {
  const auto x = broadcast<Wide>(static_cast<float>(line.from_x));
  const auto y = broadcast<Wide>(static_cast<float>(line.from_y));
  const auto along_x = broadcast<Wide>(static_cast<float>(line.along_x));
  const auto along_y = broadcast<Wide>(static_cast<float>(line.along_y));
  const auto blur = static_cast<float>(line.blur);
  const auto wide = broadcast<Wide>(static_cast<float>(line.wanted) + blur);
  const float beyond = static_cast<float>(line.wanted) + 2.0f * blur;
  auto far = broadcast<Wide>(static_cast<float>(line.limit) + beyond);
  FreeLine free(line);
  for (std::size_t first = 0; first < groups.count; first += kWidest) {
    const float* const boxes = groups.boxes + first / kGroupsABlock * kNumbersABlock + first % kGroupsABlock;
    const Wide dx = load<Wide>(boxes) - x;
    const Wide dy = load<Wide>(boxes + kGroupsABlock) - y;
    const Wide half_x = load<Wide>(boxes + 2 * kGroupsABlock);
    const Wide half_y = load<Wide>(boxes + 3 * kGroupsABlock);
    const Wide along = along_x * dx + along_y * dy;
    const Wide aside = along_x * dy - along_y * dx;
    const Wide half_along = magnitude(along_x) * half_x + magnitude(along_y) * half_y;
    const Wide half_aside = magnitude(along_y) * half_x + magnitude(along_x) * half_y;
    unsigned met = bitsOf((magnitude(aside) - half_aside <= wide) & (along + half_along >= broadcast<Wide>(-blur)) &
                          (along - half_along <= far)) &
                   firstBits(groups.count - first);
    for (; met != 0; met &= met - 1) {
      const double* const places =
          groups.places + (first + static_cast<std::size_t>(__builtin_ctz(met))) * 2 * kReturnsAGroup;
      free.meet(places);
      if (free.isKnown()) return free.free();
      far = broadcast<Wide>(static_cast<float>(free.free()) + beyond);
    }
  }
  return free.free();
}

}  // namespace

ShieldKernels SHIELD_KERNELS() { return {&add, &freeLine}; }

}  // namespace lstm_planner
