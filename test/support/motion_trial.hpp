#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/drive/motion/trail.hpp"

namespace lstm_planner::test {

/// A robot that starts to drive amid returns that stand, from its base frame. Checked in steps of its own, with wheels
/// that take time; it shares no code with what the controller looks ahead by.
class MotionTrial {
 public:
  Footprint footprint{0.17};
  MotionParameters motion;
  std::vector<Point2> returns;  ///< m
  Point2 goal{3.0, 0.0};        ///< m, straight ahead of the plan
  double turn = 0.0;            ///< rad by which the plan leads farther to the left every second; 0: to the goal
  double period = 0.05;         ///< s, between two commands
  double latency = 0.1;         ///< s, from a command to the wheels; at most reaction_time - period
  bool has_stood = false;       ///< for so long that two thirds of the margin must do

  /// Drives for so many commands. How much nearer a return comes than it may, m: it may come as near as the margin, or,
  /// if it is within the margin from the beginning, as near as it was. Of a robot with corners half the margin counts
  /// while it goes back where it was, and two thirds after it has stood.
  double shortfall(int commands) {
    double worst = 0.0;
    margin_ = motion.safety_margin;
    if (has_stood && !footprint.isCircle()) margin_ *= 2.0 / 3.0;
    const MotionController controller(motion);
    Shield shield(footprint, motion.safety_margin, 4.0);
    Trail trail;
    MotionHistory history;
    history.has_stood = has_stood;
    std::vector<double> least;
    for (const Point2& point : returns) least.push_back(footprint.distanceTo(point));
    for (int k = 0; k < commands; ++k) {
      std::vector<Point2> seen;
      for (const Point2& point : returns) seen.push_back(toLocalFrame(pose_, point));
      shield.show(seen);
      trail.note(pose_, history.goes_back);
      if (!footprint.isCircle()) history.back = trail.back(pose_, history.goes_back);
      const std::vector<Pose2> plan{pose_, planEnd()};
      const MotionCommand command = controller.compute({plan, pose_, twist(), shield, period}, {}, {}, history);
      if (command.goes_back) margin_ = 0.5 * motion.safety_margin;
      history.goes_back = command.goes_back;
      history.gets_out = command.goes_back && has_stood;
      history.note(command, motion.reaction_time, period);
      commands_.push_back({time_ + kStep * std::floor(latency / kStep), command});
      has_moved = has_moved || command.linear != 0.0 || command.angular != 0.0;
      const double wheel = std::abs(command.linear) + 0.5 * motion.axle_length * std::abs(command.angular);
      beyond_limits = std::max({beyond_limits, wheel - motion.max_wheel_speed, command.linear - motion.max_linear,
                                std::abs(command.angular) - motion.max_angular});
      for (double end = time_ + period; time_ < end - 0.5 * kStep;) {
        step();
        for (std::size_t i = 0; i < returns.size(); ++i) {
          const double gap = footprint.distanceTo(toLocalFrame(pose_, returns[i]));
          worst = std::max(worst, std::min(margin_, least[i]) - gap);
        }
      }
    }
    return worst;
  }

  bool has_moved = false;
  double beyond_limits = 0.0;  ///< m/s or rad/s by which a command was more than the robot may drive, turn or roll

 private:
  static constexpr double kStep = 0.005;  // s

  struct Waiting {
    double since;
    Twist2 twist;
  };

  Pose2 planEnd() const {
    if (turn == 0.0) return {goal.x, goal.y, 0.0};
    const Point2 way = toParentFrame({0.0, 0.0, turn * std::floor(time_)}, goal);
    return {pose_.x + way.x, pose_.y + way.y, 0.0};
  }

  Twist2 twist() const { return {0.5 * (left_ + right_), (right_ - left_) / motion.axle_length}; }

  void step() {
    while (commands_.size() > 1 && commands_[1].since <= time_ + 1e-9) commands_.pop_front();
    const Twist2 wanted = commands_.front().since <= time_ + 1e-9 ? commands_.front().twist : Twist2{};
    const double most =
        (motion.wheel_acceleration > 0.0 ? motion.wheel_acceleration : motion.linear_acceleration) * kStep;
    const double half = 0.5 * motion.axle_length * wanted.angular;
    left_ += std::max(-most, std::min(most, wanted.linear - half - left_));
    right_ += std::max(-most, std::min(most, wanted.linear + half - right_));
    const Twist2 now = twist();
    pose_ = alongTurn(pose_, now.linear * kStep, now.angular * kStep);
    time_ += kStep;
  }

  Pose2 pose_;
  double left_ = 0.0, right_ = 0.0;  // m/s
  double time_ = 0.0;
  double margin_ = 0.0;
  std::deque<Waiting> commands_;
};

}  // namespace lstm_planner::test
