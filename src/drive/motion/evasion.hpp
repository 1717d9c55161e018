#pragma once

#include <vector>

#include "lstm_planner/drive/motion/motion_controller.hpp"

namespace lstm_planner {

/// What comes of a choice if the things that move go on as they do now, in the robot's next seconds
/// (MotionParameters::evade_time).
struct Outlook {
  double room = 0.0;   ///< m, the least distance of the footprint to a thing; later ones count as a little more
  double touch = 0.0;  ///< s, until the first touch; the whole time where there is none
  Pose2 end;           ///< base frame of now
  Twist2 first;        ///< the command now
};

/// Rolls the robot's choices forward among things that move. All in the base frame of now.
class Evasion {
 public:
  /// All must outlive it. For `reaction_time` (s) the robot goes on as it does now (`current`).
  Evasion(const MotionParameters& parameters, double reaction_time, const Shield& shield,
          const std::vector<MovingThing>& things, const Twist2& current);

  /// It obeys a command.
  Outlook withCommand(const Twist2& command) const;

  /// It turns to a direction (rad) and drives there, at most that fast (m/s), until it stands before an obstacle.
  Outlook towards(double direction, double speed) const;

  /// It drives straight back, at most that fast (m/s), and stands `free` (m) behind where it is.
  Outlook backwards(double speed, double free) const;

 private:
  template <typename Command>
  Outlook roll(const Command& commandAt) const;
  double roomAt(const Pose2& pose, double time) const;

  const MotionParameters& parameters_;
  double reaction_time_;
  const Shield& shield_;
  const std::vector<MovingThing>& things_;
  Twist2 current_;
};

}  // namespace lstm_planner
