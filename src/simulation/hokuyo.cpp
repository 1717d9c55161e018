#include "lstm_planner/simulation/hokuyo.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/common/parameter_visitors.hpp"

namespace lstm_planner {
namespace {

constexpr std::size_t kPieces = 90;  // of a scan, each measured from one pose
constexpr std::size_t kNoiseTableSize = 8192;
constexpr double kFar = 10.0;      // m
constexpr double kFarNoise = 3.0;  // times the noise nearby

}  // namespace

void validate(const HokuyoParameters& parameters) {
  visitHokuyoParameters(parameters, RangeCheck());
  checkParameter(parameters.angle_increment != 0.0, "angle_increment", parameters.angle_increment,
                 "an angle other than 0");
  checkParameter(parameters.range_max > parameters.range_min, "range_max", parameters.range_max,
                 "a distance above range_min");
}

Hokuyo::Hokuyo(const HokuyoParameters& parameters, std::uint64_t seed) : parameters_(parameters), random_(seed) {
  validate(parameters_);
  ranges_.resize(static_cast<std::size_t>(parameters_.beams));
  noise_.reserve(kNoiseTableSize);
  for (std::size_t i = 0; i < kNoiseTableSize; ++i) {
    noise_.push_back(static_cast<float>(parameters_.noise * normal(random_)));
  }
}

double Hokuyo::rounded(double range) const {
  const double step = parameters_.range_step;
  return step > 0.0 ? step * std::round(range / step) : range;
}

void Hokuyo::scan(const World& world, const Pose2& base_pose, double stamp, LaserScan* scan) {
  sweep(
      world, [&](double) { return base_pose; }, stamp, scan);
}

void Hokuyo::castRays(const World& world, const std::function<Pose2(double)>& pose_at, double stamp) {
  const SensorMount& mount = parameters_.mount;
  const BeamTimes& times = parameters_.beam_times;
  const double increment = mount.mirror() * parameters_.angle_increment;
  const double max_range = std::min(parameters_.sight, parameters_.range_max);
  const std::size_t beams = ranges_.size();
  const std::size_t at_once = parameters_.isSwept() ? (beams + kPieces - 1) / kPieces : beams;
  for (std::size_t first = 0; first < beams; first += at_once) {
    piece_.resize(std::min(at_once, beams - first));
    const double middle = static_cast<double>(first) + 0.5 * static_cast<double>(piece_.size() - 1);
    const double share = beams > 1 ? middle / static_cast<double>(beams - 1) : 0.0;
    const Pose2 base = pose_at(stamp + times.first + share * (times.last - times.first));
    const double direction = base.yaw + mount.pose.yaw + mount.mirror() * parameters_.angle_min;
    world.castRays(toParentFrame(base, {mount.pose.x, mount.pose.y}),
                   direction + static_cast<double>(first) * increment, increment, max_range, &piece_);
    std::copy(piece_.begin(), piece_.end(), ranges_.begin() + static_cast<long>(first));
  }
}

void Hokuyo::sweep(const World& world, const std::function<Pose2(double)>& pose_at, double stamp, LaserScan* scan) {
  scan->stamp = stamp;
  scan->angle_min = parameters_.angle_min;
  scan->angle_increment = parameters_.angle_increment;
  scan->range_min = parameters_.range_min;
  scan->range_max = parameters_.range_max;
  scan->ranges.resize(ranges_.size());
  castRays(world, pose_at, stamp);

  for (std::size_t beam = 0; beam < ranges_.size(); ++beam) {
    // The upper bits decide about a drop-out, the lowest thirteen choose the noise.
    const std::uint64_t draw = random_();
    const double chance = static_cast<double>(draw >> 13) * 0x1.0p-51;
    if (chance < parameters_.dropout) {
      scan->ranges[beam] = std::numeric_limits<float>::quiet_NaN();
    } else {
      const double range = ranges_[beam];
      const double noise = noise_[draw % kNoiseTableSize] * (range > kFar ? kFarNoise : 1.0);
      scan->ranges[beam] = static_cast<float>(std::max(0.0, rounded(range + noise)));  // +inf stays +inf
    }
  }
}

}  // namespace lstm_planner
