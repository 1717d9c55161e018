#include "lstm_planner/dataset/drive_step.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "lstm_planner/common/words.hpp"

namespace lstm_planner {

namespace {

constexpr std::array<const char*, 8> kEpisodeEnds = {"running",   "arrived",       "new goal", "aborted",
                                                     "time jump", "odometry jump", "paused",   "finished"};
constexpr std::array<const char*, kRejectionCount> kRejections = {
    "no goal",       "standing",   "paused", "no odometry",      "no transform",
    "unusable scan", "not finite", "late",   "no allowed angle", "no next step"};

template <typename Value, std::size_t count>
Value valueNamed(const std::array<const char*, count>& names, const std::string& name, const char* what) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw std::invalid_argument("'" + name + "' is no " + what);
  return static_cast<Value>(found - names.begin());
}

}  // namespace

bool ScanGeometry::operator==(const ScanGeometry& other) const {
  const auto all = [](const ScanGeometry& geometry) {
    const auto& [pose, upside_down] = geometry.mount;
    return std::tie(geometry.frame, geometry.angle_min, geometry.angle_increment, geometry.beams, geometry.range_min,
                    geometry.range_max, pose.x, pose.y, pose.yaw, upside_down);
  };
  return all(*this) == all(other);
}

LaserScan scanOf(const ScanGeometry& geometry, std::vector<float> ranges) {
  LaserScan scan;
  scan.angle_min = geometry.angle_min;
  scan.angle_increment = geometry.angle_increment;
  scan.range_min = geometry.range_min;
  scan.range_max = geometry.range_max;
  scan.ranges = std::move(ranges);
  return scan;
}

const char* toString(EpisodeEnd end) { return kEpisodeEnds.at(static_cast<std::size_t>(end)); }

EpisodeEnd episodeEndNamed(const std::string& name) {
  return valueNamed<EpisodeEnd>(kEpisodeEnds, name, "end of an episode");
}

const char* toString(Rejection rejection) { return kRejections.at(static_cast<std::size_t>(rejection)); }

Rejection rejectionNamed(const std::string& name) {
  return valueNamed<Rejection>(kRejections, name, "reason to reject a step");
}

std::string textOf(const RejectionCounts& counts) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) words.push_back(std::to_string(counts[i]) + " " + toString(static_cast<Rejection>(i)));
  }
  return joined(words);
}

double drivenAngle(const Pose2& from, const Pose2& to, double min_distance) {
  const bool turned_in_place = distanceBetween(from, to) < min_distance;
  return normalizeAngle((turned_in_place ? to.yaw : directionTo(from, to)) - from.yaw);
}

}  // namespace lstm_planner
