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

  /// Lets so much time pass, s; with more than 0.1 s bodies jump. Returns the bodies that ran into the robot, which is
  /// at `pose` (world frame), each once per meeting.
  virtual std::vector<Circle> advance(double seconds, const Footprint& robot, const Pose2& pose) = 0;

  /// Whether that body has met the robot and not left it since.
  bool isBesideRobot(std::size_t body) const { return is_beside_[body]; }

 protected:
  std::vector<bool> is_beside_;  ///< for each body: whether it is beside the robot
};

}  // namespace lstm_planner
