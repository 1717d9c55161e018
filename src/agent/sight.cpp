#include "lstm_planner/agent/sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "perception/lanes.hpp"

namespace lstm_planner {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNear = 1.0f;  ///< m; nearer neighbourhoods may always be looked through
constexpr float kFar = 3.0f;   ///< m
constexpr float kBlur = 1e-3f;  ///< m; more than is lost in floats

std::size_t roundedUp(std::size_t count, std::size_t unit) { return (count + unit - 1) / unit * unit; }

}  // namespace

void Sight::show(const RangeProfile& profile, double yaw) {
  if (profile.ranges.empty() || profile.increment == 0.0) {
    finder_ = BeamFinder();
    return;
  }
  finder_ = BeamFinder(profile, yaw);
  near_.from = kNear;
  far_.from = kFar;
  measureBeams(profile);
  measureBlocks(&near_);
  measureBlocks(&far_);
}

void Sight::measureBeams(const RangeProfile& profile) {
  const std::size_t beams = profile.ranges.size();
  const auto beside = static_cast<std::size_t>(beside_);
  const std::size_t length = roundedUp(beams, kBlock);
  padded_.resize(length + 2 * beside);
  std::fill(padded_.begin(), padded_.begin() + beside_, kInfinity);
  std::copy(profile.ranges.begin(), profile.ranges.end(), padded_.begin() + beside_);
  std::fill(padded_.begin() + beside_ + static_cast<std::ptrdiff_t>(beams), padded_.end(), kInfinity);
  limits_.resize(length);
  blocks_.resize(length / kBlock);
  for (std::size_t block = 0; block < length; block += kBlock) {
    Floats farthest = {};
    for (std::size_t i = block; i < block + kBlock; i += kLanes) {
      Floats nearest = loadFloats(&padded_[i]);
      for (std::size_t j = 1; j <= 2 * beside; ++j) nearest = lesser(nearest, loadFloats(&padded_[i + j]));
      const Floats before = greater(nearest - allOf(behind_), Floats{});
      store(before * before, &limits_[i]);
      farthest = greater(farthest, before);
    }
    blocks_[block / kBlock] = std::max({farthest[0] * 1.0f, farthest[1] * 1.0f, farthest[2] * 1.0f, farthest[3] * 1.0f});
  }
}

void Sight::measureBlocks(Horizon* horizon) {
  // A neighbourhood's half angle is the arc sine of its radius by its distance: less than 1.1 times that.
  horizon->beams = 1.1f * neighbourhood_ / horizon->from * finder_.beamsATurn() / static_cast<float>(2.0 * M_PI) +
                   static_cast<float>(beside_ + 2);
  const std::size_t blocks = blocks_.size();
  const auto wide = static_cast<std::size_t>(std::ceil(horizon->beams / static_cast<float>(kBlock)));
  horizon->limits.resize(blocks);
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t first = block > wide ? block - wide : 0;
    const std::size_t last = std::min(block + wide, blocks - 1);
    float farthest = blocks_[first];
    for (std::size_t i = first + 1; i <= last; ++i) farthest = std::max(farthest, blocks_[i]);
    const float limit = farthest + neighbourhood_ + kBlur;
    horizon->limits[block] = limit * limit;
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

void Sight::mayLookThrough(const float* x, const float* y, std::size_t count, std::uint8_t* may) {
  if (finder_.beams() == 0) {
    std::fill_n(may, count, std::uint8_t{0});
    return;
  }
  positions_.resize(std::max(positions_.size(), roundedUp(count, kLanes)));
  finder_.find(x, y, count, positions_.data());
  for (std::size_t i = 0; i < count; ++i) {
    may[i] = mayLookThrough(positions_[i], x[i] * x[i] + y[i] * y[i]) ? 1 : 0;
  }
}

bool Sight::mayLookThrough(float position, float squared) const {
  if (squared < kNear * kNear) {
    return true;
  }
  const Horizon& horizon = squared < kFar * kFar ? near_ : far_;
  const auto last = static_cast<float>(finder_.beams() - 1);
  if (position < last - horizon.beams && position > horizon.beams) {
    return horizon.limits[static_cast<std::size_t>(position) / kBlock] > squared;
  }
  // At the edges of what the scanner sees a neighbourhood may be half in sight.
  return position <= last + horizon.beams || position >= finder_.beamsATurn() - horizon.beams;
}

}  // namespace lstm_planner
