#include "lstm_planner/robot/memory/sight.hpp"

#include <algorithm>
#include <limits>

#include "robot/perception/baseline_vectors.hpp"
#include "robot/perception/scan_kernels.hpp"

namespace lstm_planner {

namespace {

constexpr float kInfiniteRange = std::numeric_limits<float>::infinity();

/// Noise, and beams that graze a wall, must not make it seem cleared.
constexpr float kBehindObstacle = 0.1f;
constexpr std::size_t kBeside = 2;

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

SightBeams Sight::beams() const {
  SightBeams beams;
  beams.first = finder_.firstBeam();
  beams.beams = static_cast<int>(finder_.beams());
  beams.beams_a_turn = finder_.beamsATurn();
  beams.limits = limits_.data();
  beams.farthest = farthest_.data();
  beams.blocks = static_cast<int>(blocks_);
  beams.levels = static_cast<int>(kLevels);
  beams.neighbourhood = neighbourhood_;
  return beams;
}

}  // namespace lstm_planner
