#pragma once

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// How far a robot that is to look around has turned. Turning to and fro counts once.
class FullTurn {
 public:
  /// It begins with this heading (rad) at that time (s).
  void start(double yaw, double time);
  void note(double yaw, double time);

  /// It has seen everything around it, or turns no further: a robot with corners cannot turn everywhere.
  bool isOver() const;

 private:
  double yaw_ = 0.0;    ///< rad
  double turn_ = 0.0;   ///< rad since the start, counter-clockwise
  double least_ = 0.0;  ///< rad, of turn_
  double most_ = 0.0;   ///< rad, of turn_
  double noted_ = 0.0;  ///< rad, most_ - least_ when it last made progress
  double since_ = 0.0;  ///< s, when that was
  double now_ = 0.0;    ///< s
};

}  // namespace lstm_planner
