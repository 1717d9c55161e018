#pragma once

#include <vector>

#include "lstm_planner/robot/simulation/world.hpp"

namespace lstm_planner {

/// A world in which round bodies move by themselves as time passes.
class Traffic : public World {
 public:
  struct Body {
    Circle circle;
    bool beside_robot = false;  ///< it has met the robot and not left it since
  };

  /// `surroundings`, where the bodies move, must outlive the object.
  explicit Traffic(const World& surroundings) : surroundings_(surroundings) {}

  void castRays(const Point2& origin, double first_direction, double increment, double max_range,
                std::vector<double>* ranges) const override;
  using World::touches;
  bool touches(const Point2& center, double radius) const override;

  /// Lets that much time pass, s: no longer than a tenth of a second, or bodies jump. Returns the bodies that ran into
  /// the robot, which is at `pose`, each once a meeting.
  virtual std::vector<Circle> advance(double seconds, const Footprint& robot, const Pose2& pose) = 0;

  virtual std::vector<Body> bodies() const = 0;  ///< always in the same order
  const World& surroundings() const { return surroundings_; }

 protected:
  bool touchesPolygon(const Footprint& polygon, const Pose2& pose) const override;

 private:
  const World& surroundings_;
};

}  // namespace lstm_planner
