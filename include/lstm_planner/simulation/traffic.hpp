#pragma once

#include <cstddef>
#include <vector>

#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// A world in which round bodies move by themselves as time passes: circles(), always in the same order.
class Traffic : public CircleWorld {
 public:
  /// `surroundings`, where the bodies move, must outlive the object.
  explicit Traffic(const World& surroundings) : CircleWorld({}, &surroundings) {}

  /// Lets that much time pass, s: no longer than a tenth of a second, or bodies jump. Returns the bodies that ran into
  /// the robot, which is at `pose`, each once a meeting.
  virtual std::vector<Circle> advance(double seconds, const Footprint& robot, const Pose2& pose) = 0;

  /// Whether that body has met the robot and not left it since.
  bool isBesideRobot(std::size_t body) const { return is_beside_[body]; }

 protected:
  std::vector<bool> is_beside_;  ///< the robot; a body each
};

}  // namespace lstm_planner
