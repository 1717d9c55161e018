#include "lstm_planner/agent/sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "perception/lanes.hpp"

namespace lstm_planner {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Noise, and beams that graze a wall, must not make it seem looked through.
constexpr float kBehind = 0.1f;
constexpr std::size_t kBeside = 2;

constexpr float kNear = 0.5f;   ///< m; nearer neighbourhoods may always be looked through
constexpr float kBlur = 1e-3f;  ///< m; more than is lost in floats

std::size_t roundedUp(std::size_t count, std::size_t unit) { return (count + unit - 1) / unit * unit; }

}  // namespace

void Sight::show(const RangeProfile& profile, double yaw) {
  if (profile.ranges.empty() || profile.increment == 0.0) {
    finder_ = BeamFinder();
    return;
  }
  finder_ = BeamFinder(profile, yaw);
  measureBeams(profile);
}

void Sight::measureBeams(const RangeProfile& profile) {
  const std::size_t beams = profile.ranges.size();
  const std::size_t length = roundedUp(beams, kBlock);
  padded_.resize(length + 2 * kBeside);
  std::fill_n(padded_.begin(), kBeside, kInfinity);
  std::copy(profile.ranges.begin(), profile.ranges.end(), padded_.begin() + kBeside);
  std::fill(padded_.begin() + static_cast<std::ptrdiff_t>(kBeside + beams), padded_.end(), kInfinity);
  limits_.resize(length);
  const std::size_t blocks = length / kBlock;
  for (std::vector<float>& level : farthest_) level.resize(blocks + (std::size_t{1} << kLevels) + kLanes);
  const float* const ranges = padded_.data();
  float* const limits = limits_.data();
  for (std::size_t i = 0; i < length; i += kLanes) {
    static_assert(kBlock == kLanes, "a block side by side");
    Floats nearest = loadFloats(ranges + i);
    for (std::size_t j = 1; j <= 2 * kBeside; ++j) nearest = lesser(nearest, loadFloats(ranges + i + j));
    const Floats before = greater(nearest - allOf(kBehind), Floats{});
    store(before * before, limits + i);
    farthest_[0][i / kBlock] = mostOf(before) + kBlur;
  }
  for (std::size_t level = 1; level < kLevels; ++level) {
    const float* const half = farthest_[level - 1].data();
    const std::size_t other = std::size_t{1} << (level - 1);
    for (std::size_t block = 0; block < blocks; block += kLanes) {
      store(greater(loadFloats(half + block), loadFloats(half + block + other)), &farthest_[level][block]);
    }
  }
}

/// The most of the blocks from the first to the last: two powers of two that overlap.
inline float Sight::farthest(std::size_t first, std::size_t last) const {
  const std::size_t blocks = last - first + 1;
  const auto level = static_cast<std::size_t>(63 - __builtin_clzll(blocks));
  if (level >= kLevels) {
    return kInfinity;
  }
  const std::vector<float>& most = farthest_[level];
  return std::max(most[first], most[last + 1 - (std::size_t{1} << level)]);
}

void Sight::looksThrough(const float* x, const float* y, std::size_t count, std::uint8_t* through) {
  if (finder_.beams() == 0) {
    std::fill_n(through, count, std::uint8_t{0});
    return;
  }
  positions_.resize(std::max(positions_.size(), roundedUp(count, kLanes)));
  finder_.find(x, y, count, positions_.data());
  for (std::size_t i = 0; i < count; ++i) {
    const long beam = finder_.beamAt(positions_[i]);
    through[i] = beam >= 0 && limits_[static_cast<std::size_t>(beam)] > x[i] * x[i] + y[i] * y[i] ? 1 : 0;
  }
}

void Sight::limits(const float* x, const float* y, std::size_t count, float* limits) {
  if (finder_.beams() == 0) {
    std::fill_n(limits, count, 0.0f);
    return;
  }
  positions_.resize(std::max(positions_.size(), roundedUp(count, kLanes)));
  finder_.find(x, y, count, positions_.data());
  const auto last = static_cast<float>(finder_.beams() - 1);
  const float turn = finder_.beamsATurn();
  const float* const positions = positions_.data();
  // A neighbourhood's half angle is the arc sine of its radius by its distance, less than 1.1 times that; and a beam is
  // looked for half a beam to each side.
  const float beams_a_metre = 1.1f * neighbourhood_ * turn / static_cast<float>(2.0 * M_PI);
  for (std::size_t i = 0; i < count; ++i) {
    const float squared = x[i] * x[i] + y[i] * y[i];
    const float beams = beams_a_metre / std::sqrt(squared) + 1.0f;
    const float first = positions[i] - beams;
    const float beyond = positions[i] + beams;
    if (squared < kNear * kNear) {
      limits[i] = kInfinity;
    } else if (first >= 0.0f && beyond <= last) {
      const float most = farthest(static_cast<std::size_t>(static_cast<long>(first)) / kBlock,
                                  static_cast<std::size_t>(static_cast<long>(beyond)) / kBlock);
      const float least = most + neighbourhood_;  // for the middle, so that something of it may be nearer
      limits[i] = least * least > squared ? most * most : 0.0f;
    } else {
      // At the edges of what the scanner sees a neighbourhood may be half in sight.
      limits[i] = first <= last || beyond >= turn ? kInfinity : 0.0f;
    }
  }
}

}  // namespace lstm_planner
