#pragma once

#include <cstddef>
#include <map>
#include <memory>

#include "lstm_planner/grid/occupancy_grid.hpp"
#include "lstm_planner/simulation/contact_count.hpp"
#include "lstm_planner/simulation/create2.hpp"
#include "lstm_planner/simulation/create2_stub_parameters.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// The world that the parameters name. Throws std::invalid_argument when they name none or two, when its file cannot be
/// read, or when the robot would touch something at the start pose.
std::unique_ptr<World> makeWorld(const Create2StubParameters& parameters);

/// A building with other robots in it: discs that move, as large as the robots' circumscribed circles.
class WorldWithRobots : public CircleWorld {
 public:
  /// `radius`: of each robot, m. `building` must outlive the object.
  WorldWithRobots(const World& building, double radius) : CircleWorld({}, &building), radius_(radius) {}

  /// Where a robot is now; it is nowhere before.
  void moveRobot(std::size_t robot, const Point2& position);

 private:
  double radius_;
  std::map<std::size_t, std::size_t> circle_of_;  ///< number of a robot's circle
};

/// A robot in a world. It cannot drive into anything: what it runs against holds it (its wheels go on and the encoders
/// count; one that is round may still turn). A contact is counted when touching starts; it has ended when the robot is
/// 1 cm away.
class RobotInWorld {
 public:
  RobotInWorld(const World& world, const Create2Parameters& parameters, const Pose2& start, std::uint64_t seed);

  void step(double seconds);

  Create2& robot() { return robot_; }
  unsigned contacts() const { return static_cast<unsigned>(contacts_.contacts()); }
  /// True while something presses the left or right half of the bumper.
  bool pressed(bool left) const;

 private:
  const World& world_;
  Create2 robot_;
  Footprint footprint_;
  ContactCount contacts_;
};

}  // namespace lstm_planner
