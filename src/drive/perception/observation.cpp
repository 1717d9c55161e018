#include "lstm_planner/drive/perception/observation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lstm_planner {

Observation observe(const Sectors& sectors, const Pose2& pose, const Point2& goal, double previous_action,
                    double position_cell) {
  Point2 position{pose.x, pose.y};
  if (position_cell > 0.0) {
    position.x = (std::floor(pose.x / position_cell) + 0.5) * position_cell;
    position.y = (std::floor(pose.y / position_cell) + 0.5) * position_cell;
  }

  Observation observation;
  observation.sector_ranges = sectors.range;
  observation.goal_distance = distanceBetween(position, goal);
  // A goal that coincides with the robot has no bearing; straight ahead is the one that asks for no turn.
  observation.goal_bearing =
      observation.goal_distance > 0.0 ? normalizeAngle(directionTo(position, goal) - pose.yaw) : 0.0;
  observation.heading = normalizeAngle(pose.yaw);
  observation.previous_action = previous_action;
  observation.route_bearing = observation.goal_bearing;
  observation.route_length = observation.goal_distance;
  return observation;
}

Observation mirrored(Observation observation) {
  // Ahead and behind stay, the others lie from ahead to behind on either side.
  const auto mirrorAround = [](std::array<double, kPlaceDirections>* values) {
    std::reverse(values->begin() + 1, values->end());
  };
  std::reverse(observation.sector_ranges.begin(), observation.sector_ranges.end());
  for (double* angle : {&observation.goal_bearing, &observation.heading, &observation.previous_action,
                        &observation.route_bearing, &observation.turn}) {
    *angle = normalizeAngle(-*angle);
  }
  mirrorAround(&observation.visits);
  for (PlacesAround& places : observation.places) {
    mirrorAround(&places.visits);
    mirrorAround(&places.ages);
  }
  observation.motion.y = -observation.motion.y;
  return observation;
}

double yawOfQuaternion(double x, double y, double z, double w) {
  const double largest = std::max({std::abs(x), std::abs(y), std::abs(z), std::abs(w)});
  if (!(largest > 0.0) || !std::isfinite(x + y + z + w)) return std::numeric_limits<double>::quiet_NaN();
  // Scaled first, so that the squares of very small or large components neither vanish nor overflow.
  x /= largest;
  y /= largest;
  z /= largest;
  w /= largest;
  return normalizeAngle(std::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z));
}

}  // namespace lstm_planner
