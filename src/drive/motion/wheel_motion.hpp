#pragma once

#include <limits>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"

namespace lstm_planner {

/// Where the wheels really take the robot: on as they were told until a command acts, then along the command until the
/// next one, and then braking. How long a command takes to the wheels is not known: the shortest time is none, the
/// longest one follows from the reaction time.
class WheelMotion {
 public:
  static constexpr double kFree = std::numeric_limits<double>::infinity();

  /// `reaction_time`: s, from a measurement to the wheels. `margin`: m, to be kept to every return. The arguments must
  /// outlive it.
  WheelMotion(const MotionParameters& parameters, const MotionSituation& situation, const MotionHistory& history,
              double reaction_time, double margin);

  /// m that it gets however long commands take, infinite if it gets to where it stands.
  double free(const Twist2& command);

 private:
  /// Speeds of the wheels, m/s.
  struct Wheels {
    double left;
    double right;
  };
  struct Rolling {
    Wheels wheels;
    Pose2 pose;           ///< base frame of now
    double time = 0.0;    ///< s from now
    double free = 0.0;    ///< m it got
    bool is_free = true;  ///< up to here
  };

  Rolling begin(double delay) const;
  const Twist2& onItsWay(double left) const;
  double freeFrom(Rolling rolling, const Twist2& command) const;
  void roll(const Twist2& wanted, Rolling* rolling) const;
  double freeOnArc(const Pose2& from, double length, double turn) const;
  Wheels wheelsAt(const Twist2& twist) const;
  double rim(const Twist2& twist) const;

  const MotionParameters& parameters_;
  const Shield& shield_;
  const MotionHistory& history_;
  double acceleration_;  ///< m/s^2, of a wheel
  double period_;        ///< s
  double delay_;         ///< s, the longest
  double hold_;          ///< s, until the next command acts
  double margin_;        ///< m
  double gap_;           ///< m
  Twist2 current_;
  std::vector<Rolling> begins_;  ///< where commands find the robot, sooner or later
};

}  // namespace lstm_planner
