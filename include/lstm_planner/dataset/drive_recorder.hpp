#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/dataset/drive_events.hpp"
#include "lstm_planner/dataset/drive_step.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"
#include "lstm_planner/drive/decision/action_set.hpp"
#include "lstm_planner/drive/decision/observer.hpp"
#include "lstm_planner/drive/perception/odometry_history.hpp"
#include "lstm_planner/drive/perception/silence_watch.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// Cuts a drive into labelled steps (thesis 4.2, Eq. 4.1-4.2).
///
/// A sample is taken once in every `period` of the stamps' clock: the first scan, with the pose at its stamp,
/// interpolated between the two odometry messages around it (the nearest one can be half an odometry period away). It
/// starts a step if the robot has moved since the last one. The pose where the next step starts gives the label; then
/// the step is given to the sink. The same events give the same steps, in any order of arrival within
/// RecorderParameters::delay, live or from a file. Not thread safe.
class DriveRecorder {
 public:
  /// Pose of a frame in the odometry frame at a time (s), Pose2() of that frame itself; empty if it is not known.
  using FrameLookup = std::function<std::optional<Pose2>(const std::string& frame, double stamp)>;

  /// `sink` must outlive the recorder. Throws as validate().
  DriveRecorder(const RecorderParameters& parameters, StepSink* sink, FrameLookup lookup);

  /// An event with a flaw (flawOf()) is rejected, and so are odometry and scans that come too late. Goals, and the end
  /// of one, that come too late hold from then on.
  void add(DriveEvent event);

  /// Counts something that was heard but cannot become an event; `why` is a sentence.
  void reject(Rejection rejection, const std::string& why);

  /// Works on all that was heard and ends the episode.
  void finish();

  /// While it is paused, nothing becomes a step. Pausing ends the episode, but keeps the goal.
  void setPaused(bool paused);
  bool paused() const { return paused_; }

  /// Ends the running episode, if there is one, for this reason. The goal goes with it where it was reached or given
  /// up, and a goal in the odometry frame where the odometry jumped, unless it was given since the odometry before.
  void endEpisode(EpisodeEnd end);

  /// The goal that is being driven to, in its frame; empty if there is none.
  const std::optional<GoalInFrame>& goal() const { return goal_; }
  /// The last sample; empty before the first.
  const std::optional<Situation>& situation() const { return situation_; }
  bool inEpisode() const { return in_episode_; }

 private:
  void work(const OdometryHeard& odometry);
  void work(const GoalHeard& goal);
  void work(const GoalGivenUp& given_up);
  void work(const ScanHeard& scan);
  void workOnWhatIsDue(bool all);
  void sample(ScanHeard scan);
  /// Why the scan cannot be used; empty if it can. Corrects its distortion by the robot's motion.
  std::string see(ScanHeard* scan);
  bool isGoalInOdometry() const;
  bool isAt(const Point2& goal, const Pose2& pose) const;
  void startEpisode();
  void startStep(const ScanHeard& scan);
  void labelStep();

  RecorderParameters parameters_;
  ActionSet actions_;
  StepSink* sink_;
  FrameLookup lookup_;
  EventOrder order_;
  double newest_ = 0.0;  ///< s, of what was heard
  double now_ = 0.0;     ///< s, of what is being worked on

  OdometryHistory history_;
  std::vector<ScanHeard> waiting_;       ///< scans that are newer than the odometry
  std::optional<double> last_sample_;    ///< number of its period
  double last_seen_ = 0.0;               ///< s, of the last scan in a period that had a sample
  std::optional<double> last_unusable_;  ///< number of the last period without a usable scan
  std::optional<Situation> situation_;   ///< at the last sample
  SilenceWatch silence_;
  Observer observer_;

  std::optional<GoalInFrame> goal_;
  std::string goal_source_;
  bool is_goal_newest_ = false;  ///< given, perhaps again, since the last odometry
  Point2 goal_position_;         ///< odometry frame, at the last sample
  bool in_episode_ = false;
  bool paused_ = false;
  std::optional<DriveStep> step_;  ///< not labelled yet
  double previous_action_ = 0.0;   ///< rad
  long number_ = 0;                ///< of the next step
};

}  // namespace lstm_planner
