#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "drive/motion/motion_parts.hpp"
#include "lstm_planner/common/arc.hpp"
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
          const std::vector<MovingThing>& things, const Twist2& current)
      : parameters_(parameters), reaction_time_(reaction_time), shield_(shield), things_(things), current_(current) {}

  /// It obeys a command.
  Outlook withCommand(const Twist2& command) const {
    return roll([&](const Pose2&) { return command; });
  }

  /// It turns to a direction (rad) and drives there, at most that fast (m/s), until it stands before an obstacle.
  Outlook towards(double direction, double speed) const {
    const double free = shield_.freeDistance({}, direction, speed * parameters_.evade_time, parameters_.safety_margin);
    const double gain = headingGain(parameters_.heading_gain, reaction_time_);
    return roll([&](const Pose2& pose) {
      const double error = normalizeAngle(direction - pose.yaw);
      Twist2 twist{0.0, clampMagnitude(gain * error, parameters_.max_angular)};
      const double left = free - std::hypot(pose.x, pose.y);
      if (std::abs(error) < parameters_.turn_in_place && left > 0.0) {
        const double brakes = std::sqrt(2.0 * parameters_.linear_acceleration * left);
        // It never backs on an arc: what is behind may not be seen.
        twist.linear = std::clamp(speed * std::cos(error), 0.0, brakes);
      }
      return twist;
    });
  }

  /// It drives straight back, at most that fast (m/s), and stands `free` (m) behind where it is.
  Outlook backwards(double speed, double free) const {
    const double acceleration = parameters_.linear_acceleration;
    return roll([&](const Pose2& pose) {
      const double left = std::max(0.0, free + pose.x);
      const double stops =
          acceleration * (std::hypot(reaction_time_, std::sqrt(2.0 * left / acceleration)) - reaction_time_);
      return Twist2{-std::min(speed, stops), 0.0};
    });
  }

 private:
  static constexpr double kStep = 0.1;   // s
  static constexpr double kDoubt = 0.1;  // m/s: what is later is less certain, and there is time for another choice

  template <typename Command>
  Outlook roll(const Command& commandAt) const {
    Pose2 pose;
    Outlook outlook{std::numeric_limits<double>::infinity(), parameters_.evade_time, pose, commandAt(pose)};
    double speed = current_.linear;
    for (double time = kStep; time <= parameters_.evade_time; time += kStep) {
      const Twist2 wanted = time <= reaction_time_ ? current_ : commandAt(pose);
      speed += clampMagnitude(wanted.linear - speed, parameters_.linear_acceleration * kStep);
      pose = alongTurn(pose, speed * kStep, wanted.angular * kStep);
      const double room = roomAt(pose, time);
      if (room <= 0.0) outlook.touch = std::min(outlook.touch, time);
      outlook.room = std::min(outlook.room, room + kDoubt * time);
    }
    outlook.end = pose;
    return outlook;
  }
  double roomAt(const Pose2& pose, double time) const {
    double room = std::numeric_limits<double>::infinity();
    for (const MovingThing& thing : things_) {
      const Point2 center{thing.center.x + time * thing.velocity.x, thing.center.y + time * thing.velocity.y};
      room = std::min(room, shield_.footprint().distanceTo(toLocalFrame(pose, center)) - thing.radius);
    }
    return room;
  }

  const MotionParameters& parameters_;
  double reaction_time_;
  const Shield& shield_;
  const std::vector<MovingThing>& things_;
  Twist2 current_;
};

}  // namespace lstm_planner
