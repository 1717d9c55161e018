#include "lstm_planner/robot/simulation/traffic.hpp"

#include <algorithm>

namespace lstm_planner {

void Traffic::castRays(const Point2& origin, double first_direction, double increment, double max_range,
                       std::vector<double>* ranges) const {
  surroundings_.castRays(origin, first_direction, increment, max_range, ranges);
  for (const Body& body : bodies()) {
    castRaysAtCircle(body.circle, origin, first_direction, increment, max_range, ranges);
  }
}

bool Traffic::touches(const Point2& center, double radius) const {
  const std::vector<Body> all = bodies();
  const auto isTouched = [&](const Body& body) {
    return distanceBetween(center, body.circle.center) < radius + body.circle.radius;
  };
  return std::any_of(all.begin(), all.end(), isTouched) || surroundings_.touches(center, radius);
}

bool Traffic::touchesPolygon(const Footprint& polygon, const Pose2& pose) const {
  const std::vector<Body> all = bodies();
  const auto isTouched = [&](const Body& body) { return airBetween(polygon, pose, body.circle) < 0.0; };
  return std::any_of(all.begin(), all.end(), isTouched) || surroundings_.touches(polygon, pose);
}

}  // namespace lstm_planner
