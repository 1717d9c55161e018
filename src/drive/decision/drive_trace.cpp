#include "lstm_planner/drive/decision/drive_trace.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {
namespace {

constexpr double kVisitRadius = 0.8;  ///< m to the places whose visits are told whatever lies in between
/// m to the places of each scale, where nothing is seen to be in between.
constexpr std::array<double, kPlaceScales> kProbes = {0.8, 2.0, 5.0};
constexpr double kWallMargin = 0.3;    ///< m; places are probed on this side of a wall
constexpr double kNearestProbe = 0.4;  ///< m

/// m that seem to be free in direction heading + i * 45 degrees; a lot where the scanner does not look.
double freeRange(const Observation& observation, int direction) {
  const auto& ranges = observation.sector_ranges;
  switch (direction) {
    case 0:
      return std::min(ranges[3], ranges[4]);
    case 1:
      return std::min(ranges[5], ranges[6]);
    case 2:
      return ranges[7];
    case 6:
      return ranges[0];
    case 7:
      return std::min(ranges[1], ranges[2]);
    default:
      return 1e3;
  }
}

}  // namespace

void DriveTrace::clear() {
  places_.clear();
  last_pose_.reset();
  progress_.clear();
}

void DriveTrace::update(const Pose2& pose, Observation* observation) {
  places_.visit({pose.x, pose.y});
  lookAround(pose, observation);
  noteProgress(observation);
  noteMotion(pose, observation);
}

void DriveTrace::lookAround(const Pose2& pose, Observation* observation) const {
  for (int i = 0; i < kPlaceDirections; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const double direction = pose.yaw + i * M_PI_4;
    const Point2 ahead{std::cos(direction), std::sin(direction)};
    const auto placeAt = [&](double distance) {
      return Point2{pose.x + distance * ahead.x, pose.y + distance * ahead.y};
    };
    observation->visits[index] = places_.at(PlaceTrace::kStep, placeAt(kVisitRadius)).count;
    const double free = std::max(kNearestProbe, freeRange(*observation, i) - kWallMargin);
    for (std::size_t scale = 0; scale < kPlaceScales; ++scale) {
      const Point2 place = placeAt(std::min(free, kProbes[scale]));
      const PlaceVisit visit = places_.at(static_cast<PlaceTrace::Scale>(scale), place);
      observation->places[scale].visits[index] = visit.count;
      observation->places[scale].ages[index] = visit.age;
    }
  }
  observation->room_visits = places_.at(PlaceTrace::kRoom, {pose.x, pose.y}).count;
}

void DriveTrace::noteProgress(Observation* observation) {
  const double distance = observation->goal_distance;
  progress_.note(distance);
  observation->behind_best = std::max(0.0, distance - progress_.best());
  observation->steps_since_best = progress_.steps();
}

void DriveTrace::noteMotion(const Pose2& pose, Observation* observation) {
  if (last_pose_) {
    observation->motion = toLocalFrame(*last_pose_, {pose.x, pose.y});
    observation->turn = normalizeAngle(pose.yaw - last_pose_->yaw);
  }
  last_pose_ = pose;
}

}  // namespace lstm_planner
