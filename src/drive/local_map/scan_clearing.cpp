#include "lstm_planner/drive/local_map/scan_clearing.hpp"

#include <algorithm>
#include <limits>

#include "drive/perception/baseline_vectors.hpp"
#include "lstm_planner/grid/bit_rows.hpp"

namespace lstm_planner {

namespace {

constexpr float kInfiniteRange = std::numeric_limits<float>::infinity();

/// Noise, and beams that graze a wall, must not make it seem cleared.
constexpr float kBehindObstacle = 0.1f;
constexpr std::size_t kBeside = 2;

constexpr float kBlur = 1e-3f;  ///< m; more than is lost in floats

constexpr float kCloseBy = 0.5f;  ///< m; nearer neighbourhoods may always be cleared

/// 1 / sqrt(x) or up to 0.2 % less: an approximation by the bits of a float, and one of Newton's steps.
Floats inverseRoot(Floats x) {
  const auto guess = (Floats)(0x5f3759df - ((Ints)x >> 1));
  return guess * (1.5f - 0.5f * x * guess * guess);
}

std::size_t roundedUp(std::size_t count, std::size_t unit) { return (count + unit - 1) / unit * unit; }

}  // namespace

void ScanClearing::show(const RangeProfile& profile, double yaw) {
  if (profile.ranges.empty() || profile.increment == 0.0) {
    finder_ = BeamFinder();
    return;
  }
  finder_ = BeamFinder(profile, yaw);
  measureBeams(profile);
}

void ScanClearing::measureBeams(const RangeProfile& profile) {
  const std::size_t beams = profile.ranges.size();
  const std::size_t length = roundedUp(beams, kBlock);
  padded_.resize(length + 2 * kBeside);
  std::fill_n(padded_.begin(), kBeside, kInfiniteRange);
  std::copy(profile.ranges.begin(), profile.ranges.end(), padded_.begin() + kBeside);
  std::fill(padded_.begin() + static_cast<std::ptrdiff_t>(kBeside + beams), padded_.end(), kInfiniteRange);
  limits_.resize(length);
  const std::size_t blocks = length / kBlock;
  blocks_ = blocks + (std::size_t{1} << kLevels) + kLanes;
  farthest_.resize(kLevels * blocks_);
  const float* const ranges = padded_.data();
  const Floats farthest = allOf(profile.farthestRange());
  float* const limits = limits_.data();
  for (std::size_t i = 0; i < length; i += kLanes) {
    static_assert(kBlock == kLanes, "a block side by side");
    Floats nearest = loadFloats(ranges + i);
    for (std::size_t j = 1; j <= 2 * kBeside; ++j) nearest = minimum(nearest, loadFloats(ranges + i + j));
    const Floats before = maximum(minimum(nearest, farthest) - allOf(kBehindObstacle), Floats{});
    store(before * before, limits + i);
    farthest_[i / kBlock] = simd::largestOf(before) + kBlur;
  }
  for (std::size_t level = 1; level < kLevels; ++level) {
    const float* const half = &farthest_[(level - 1) * blocks_];
    float* const whole = &farthest_[level * blocks_];
    const std::size_t other = std::size_t{1} << (level - 1);
    for (std::size_t block = 0; block < blocks; block += kLanes) {
      store(maximum(loadFloats(half + block), loadFloats(half + block + other)), whole + block);
    }
  }
}

float ScanClearing::farthest(std::size_t first, std::size_t last) const {
  // Two powers of two that overlap.
  const std::size_t blocks = last + 1 - first;
  const auto level = static_cast<std::size_t>(highestBit(blocks));
  if (level >= kLevels) return kInfiniteRange;
  const float* const most = &farthest_[level * blocks_];
  return std::max(most[first], most[last + 1 - (std::size_t{1} << level)]);
}

float ScanClearing::limitOf(float squared, float first, float beyond) const {
  if (squared < kCloseBy * kCloseBy) return kInfiniteRange;
  const auto last_beam = static_cast<float>(finder_.beams() - 1);
  if (first >= 0.0f && beyond <= last_beam) {
    const float most = farthest(static_cast<unsigned>(first) / kBlock, static_cast<unsigned>(beyond) / kBlock);
    const float least = most + neighbourhood_;  // for the middle, so that something of it may be nearer
    return least * least > squared ? most * most : 0.0f;
  }
  // At the edges of what the scanner sees a neighbourhood may be half in sight.
  return first <= last_beam || beyond >= finder_.beamsATurn() ? kInfiniteRange : 0.0f;
}

void ScanClearing::findLimits(const float* x, const float* y, std::size_t count, float* limits) const {
  // A neighbourhood's half angle is the arc sine of its radius by its distance, less than 1.1 times that less 0.2 %;
  // and a beam is looked for half a beam to each side.
  const float beams_a_metre = 1.1f * neighbourhood_ * finder_.beamsARadian();
  float positions[kMost];
  finder_.find(x, y, count, positions);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Floats dx = loadFloats(x + i);
    const Floats dy = loadFloats(y + i);
    const Floats squared = dx * dx + dy * dy;
    const Floats half = beams_a_metre * inverseRoot(squared) + 1.0f;
    const Floats position = loadFloats(positions + i);
    const Floats first = position - half;
    const Floats beyond = position + half;
    for (int lane = 0; lane < kLanes; ++lane) *limits++ = limitOf(squared[lane], first[lane], beyond[lane]);
  }
}

void ScanClearing::findClear(const float* x, const float* y, std::size_t count, std::uint8_t* clear) const {
  float positions[kMost];
  finder_.find(x, y, count, positions);
  for (std::size_t i = 0; i < count; ++i) {
    const long beam = finder_.beamAt(positions[i]);
    clear[i] = beam >= 0 && limits_[static_cast<std::size_t>(beam)] > x[i] * x[i] + y[i] * y[i] ? 1 : 0;
  }
}

}  // namespace lstm_planner
