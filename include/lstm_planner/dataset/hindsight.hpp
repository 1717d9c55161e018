#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/dataset/drive_events.hpp"
#include "lstm_planner/dataset/drive_recorder.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"

namespace lstm_planner {

/// Which places a driver who named no goals is taken to have driven to.
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

/// The goals of a path in the odometry frame `frame`: each a GoalHeard with the stamp from which it was driven to, and
/// a GoalGivenUp with that at which the robot left it or was nearest to it, in order; all are stamps of the path.
///
/// Odometry that jumps (RecorderParameters::max_speed) or is silent for max_gap ends a path; so does its last message.
/// Goals are the places where the robot stood, and the ends of paths; what lies between two of them and is longer than
/// `longest` is divided into equal parts. An episode ends as soon as the robot comes within goal_tolerance of its goal,
/// so a place that the path passes that near earlier, or starts from, is no goal: the last place before it that is not
/// passed is taken, and what is left is driven to the next. So somebody who drives up a dead end and back has driven
/// to its end first. Nowhere to be found is such a place where somebody circles on the spot: that path has no goal.
///
/// Throws std::invalid_argument also when `shortest` is not more than the goal tolerance.
std::vector<DriveEvent> hindsightGoals(const std::vector<OdometryHeard>& path, const HindsightParameters& parameters,
                                       const RecorderParameters& recorder, const std::string& frame);

/// Tells a recorder the goals of a path while it hears that path.
class GoalSchedule {
 public:
  /// `goals`: of hindsightGoals(); `max_gap`: s, RecorderParameters::max_gap.
  GoalSchedule(std::vector<DriveEvent> goals, double max_gap) : goals_(std::move(goals)), max_gap_(max_gap) {}

  /// After the recorder has heard the odometry of this stamp, s.
  void tell(double stamp, DriveRecorder* recorder);

 private:
  std::vector<DriveEvent> goals_;
  double max_gap_;
  std::size_t next_ = 0;
};

}  // namespace lstm_planner
