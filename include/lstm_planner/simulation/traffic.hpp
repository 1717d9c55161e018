#pragma once

#include <vector>

#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// A world in which round bodies move by themselves as time passes.
class Traffic : public CircleWorld {
 public:
  /// One of the things that move.
  struct Body {
    Circle circle;
    bool beside_robot = false;  ///< it has met the robot and not left it since
  };

  /// `surroundings`, where the bodies move, must outlive the object.
  explicit Traffic(const World& surroundings) : CircleWorld({}, &surroundings) {}

  /// Lets that much time pass, s: no longer than a tenth of a second, or bodies jump. Returns the bodies that ran into
  /// the robot, which is at `pose`, each once a meeting.
  virtual std::vector<Circle> advance(double seconds, const Footprint& robot, const Pose2& pose) = 0;

  const std::vector<Body>& bodies() const { return bodies_; }  ///< always in the same order
  const World& surroundings() const { return *surroundings_; }

 protected:
  /// The bodies have moved: they are seen and touched where they are now.
  void show() {
    circles().clear();
    for (const Body& body : bodies_) circles().push_back(body.circle);
  }

  std::vector<Body> bodies_;
};

}  // namespace lstm_planner
