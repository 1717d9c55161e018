#pragma once

#include <cmath>

namespace lstm_planner {

/// The last resort without progress: boundary following with the doubling search. What each means:
/// visitEscapeParameters().
struct EscapeParameters {
  bool enabled = true;
  int patience_steps = 40;
  double patience_distance = 8.0;
  double last_resort = 30.0;
  double progress = 0.25;
  double follow_step = 0.25;
  double probe_angle = 0.08727;
  double wall_turn = 1.7453;
  double leave_margin = 0.2;
  double first_leg = 24.0;
  double loop_tolerance = 0.4;
  double loop_length = 3.0;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitEscapeParameters(Parameters& escape, const Visitor& visit) {
  visit("escape/enabled", escape.enabled, {}, "", "false: the robot may stay in a dead end forever");
  visit("escape/patience_steps", escape.patience_steps, {1, 1000000}, "",
        "steps without a new best distance to the goal, after which the robot follows boundaries; fewer leaves dead "
        "ends sooner, but also interrupts detours that lead on");
  visit("escape/patience_distance", escape.patience_distance, {0.1, 1e5}, "m",
        "distance driven without a new best distance, with the same effect");
  visit("escape/last_resort", escape.last_resort, {1.0, 1e6}, "",
        "where obstacles are remembered, this many times the patience");
  visit("escape/progress", escape.progress, {0.01, 100.0}, "m",
        "a distance to the goal is a new best one if it is shorter than all earlier ones by at least this");
  visit("escape/follow_step", escape.follow_step, {0.05, 5.0}, "m",
        "distance to the waypoint while a boundary is followed; shorter follows corners more closely, and slower");
  visit("escape/probe_angle", escape.probe_angle, {0.01, 0.78}, "rad",
        "angle between two probed directions (5 degrees)");
  visit("escape/wall_turn", escape.wall_turn, {0.01, 3.14}, "rad",
        "angle back towards the boundary at which the probing starts (100 degrees)");
  visit("escape/leave_margin", escape.leave_margin, {0.01, 100.0}, "m",
        "the robot leaves the boundary when it is nearer to the goal by this much than where it met the boundary");
  visit("escape/first_leg", escape.first_leg, {0.1, 1e5}, "m",
        "length of boundary after which the robot turns back for the first time; doubles each time; longer suits large "
        "obstacles");
  visit("escape/loop_tolerance", escape.loop_tolerance, {0.01, 100.0}, "m",
        "a loop is closed when the robot is nearer than this to where it met the boundary; must be more than the drift "
        "of the odometry");
  visit("escape/loop_length", escape.loop_length, {0.1, 1e5}, "m", "a loop that is shorter than this does not count");
}

}  // namespace lstm_planner
