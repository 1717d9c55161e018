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

constexpr float kNear = 1.0f;   ///< m; nearer neighbourhoods may always be looked through
constexpr float kFar = 3.0f;    ///< m
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
  measureBlocks(kNear, &near_);
  measureBlocks(kFar, &far_);
}

void Sight::measureBeams(const RangeProfile& profile) {
  const std::size_t beams = profile.ranges.size();
  const std::size_t length = roundedUp(beams, kBlock);
  padded_.resize(length + 2 * kBeside);
  std::fill_n(padded_.begin(), kBeside, kInfinity);
  std::copy(profile.ranges.begin(), profile.ranges.end(), padded_.begin() + kBeside);
  std::fill(padded_.begin() + static_cast<std::ptrdiff_t>(kBeside + beams), padded_.end(), kInfinity);
  limits_.resize(length);
  blocks_.resize(length / kBlock);
  const float* const ranges = padded_.data();
  float* const limits = limits_.data();
  for (std::size_t block = 0; block < length; block += kBlock) {
    Floats farthest = {};
    for (std::size_t i = block; i < block + kBlock; i += kLanes) {
      Floats nearest = loadFloats(ranges + i);
      for (std::size_t j = 1; j <= 2 * kBeside; ++j) nearest = lesser(nearest, loadFloats(ranges + i + j));
      const Floats before = greater(nearest - allOf(kBehind), Floats{});
      store(before * before, limits + i);
      farthest = greater(farthest, before);
    }
    blocks_[block / kBlock] = mostOf(farthest);
  }
}

void Sight::measureBlocks(float from, Horizon* horizon) {
  // A neighbourhood's half angle is the arc sine of its radius by its distance: less than 1.1 times that.
  horizon->beams = 1.1f * neighbourhood_ / from * finder_.beamsATurn() / static_cast<float>(2.0 * M_PI) +
                   static_cast<float>(kBeside + 2);
  const std::size_t blocks = blocks_.size();
  const auto wide = static_cast<std::size_t>(std::ceil(horizon->beams / static_cast<float>(kBlock)));
  padded_.resize(std::max(padded_.size(), roundedUp(blocks, kLanes) + 2 * wide));
  std::fill_n(padded_.begin(), roundedUp(blocks, kLanes) + 2 * wide, 0.0f);
  std::copy(blocks_.begin(), blocks_.end(), padded_.begin() + static_cast<std::ptrdiff_t>(wide));
  horizon->farthest.resize(roundedUp(blocks, kLanes));
  for (std::size_t block = 0; block < blocks; block += kLanes) {
    Floats farthest = {};
    for (std::size_t i = 0; i <= 2 * wide; ++i) farthest = greater(farthest, loadFloats(&padded_[block + i]));
    store(farthest + allOf(kBlur), &horizon->farthest[block]);
  }
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
  for (std::size_t i = 0; i < count; ++i) {
    const float squared = x[i] * x[i] + y[i] * y[i];
    const float position = positions[i];
    const Horizon& horizon = squared < kFar * kFar ? near_ : far_;
    if (squared < kNear * kNear) {
      limits[i] = kInfinity;
    } else if (position < last - horizon.beams && position > horizon.beams) {
      const float farthest = horizon.farthest[static_cast<std::size_t>(static_cast<long>(position)) / kBlock];
      const float least = farthest + neighbourhood_;  // for the middle, so that something of it may be nearer
      limits[i] = least * least > squared ? farthest * farthest : 0.0f;
    } else {
      // At the edges of what the scanner sees a neighbourhood may be half in sight.
      const bool in_sight = position <= last + horizon.beams || position >= turn - horizon.beams;
      limits[i] = in_sight ? kInfinity : 0.0f;
    }
  }
}

}  // namespace lstm_planner
