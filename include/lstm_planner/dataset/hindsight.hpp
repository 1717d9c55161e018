#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/dataset/drive_events.hpp"
#include "lstm_planner/dataset/drive_recorder.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"

namespace lstm_planner {

/// Which places are taken as the goals of a driver who named none.
struct HindsightParameters {
  double stop = 2.0;
  double longest = 10.0;
  double shortest = 2.0;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitHindsightParameters(Parameters& hindsight, const Visitor& visit) {
  visit("stop", hindsight.stop, {0.01, 86400.0}, "s", "a place is a goal if the robot stood there for this time");
  visit("longest", hindsight.longest, {0.01, 1e5}, "m", "longest path to a goal; after it a goal is set");
  visit("shortest", hindsight.shortest, {0.01, 1e5}, "m", "shortest path to a goal; nearer places are not goals");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const HindsightParameters& parameters);

/// The goals of a path in the odometry frame `frame`. Each is a GoalHeard with the stamp at which the robot began to
/// drive to it, and a GoalGivenUp with the stamp at which the robot left it or was nearest to it. They are in order,
/// and all stamps are stamps of the path.
///
/// A path ends if odometry jumps (RecorderParameters::max_speed) or is silent for max_gap, and at its last message.
/// Goals are the places where the robot stood, and the ends of paths. If the path between two of them is longer than
/// `longest`, it is divided into equal parts. An episode ends as soon as the robot comes within goal_tolerance of its
/// goal. So a place that the path passes that closely before, or starts from, is not a goal: the last place before it
/// that is not passed is taken, and the rest belongs to the next goal. So a driver who drives into a dead end and back
/// has first driven to its end. If somebody drives in small circles, there is no such place, and the path has no goal.
///
/// Throws as validate(), and std::invalid_argument if `shortest` is not more than the goal tolerance.
std::vector<DriveEvent> hindsightGoals(const std::vector<OdometryHeard>& path, const HindsightParameters& parameters,
                                       const RecorderParameters& recorder, const std::string& frame);

/// Gives a recorder the goals of a path while it gets that path.
class GoalSchedule {
 public:
  /// `goals`: those of hindsightGoals(); `max_gap`: RecorderParameters::max_gap, s.
  GoalSchedule(std::vector<DriveEvent> goals, double max_gap) : goals_(std::move(goals)), max_gap_(max_gap) {}

  /// To be called after the recorder has got the odometry of this stamp, s.
  void tell(double stamp, DriveRecorder* recorder);

 private:
  std::vector<DriveEvent> goals_;
  double max_gap_;
  std::size_t next_ = 0;
};

}  // namespace lstm_planner
