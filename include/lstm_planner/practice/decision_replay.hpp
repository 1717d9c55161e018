#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/dataset/drive_step.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"
#include "lstm_planner/drive/decision/goal_changes.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/perception/drift_correction.hpp"

namespace lstm_planner {

/// What the planner would have done at one step of somebody's drive, beside what the driver did.
struct ReplayedDecision {
  long episode = 0;    ///< from 0
  double stamp = 0.0;  ///< s, of the scan that was decided about
  Pose2 pose;          ///< base in the odometry frame at `stamp`
  Pose2 next_pose;     ///< the same at the next step: it shows what the driver did
  Pose2 goal;          ///< odometry frame; the yaw as it was given
  Sectors sectors;     ///< what the planner saw
  Decision decision;
  double steering_angle = 0.0;  ///< rad in (-pi, pi], the planner's, relative to the heading
  int action = 0;               ///< index of the steering angle that is nearest to it
  double driven_angle = 0.0;    ///< rad in (-pi, pi], the driver's (DriveStep)
  int driven_action = 0;        ///< index of the steering angle that is nearest to it
};

/// Asks the planner's agent at every step of a drive what it would do there. The steps come from a DriveRecorder (while
/// somebody drives, or from a recording) or from a dataset that has scans. There is no other input, and no clock is
/// read, so the same recording gives the same decisions.
///
/// As on the robot, the agent remembers what it has seen. A new episode is a new goal for it, unless only the clock or
/// the odometry has jumped.
class DecisionReplay : public StepSink {
 public:
  /// Throws std::invalid_argument for bad parameters, or for a policy that does not fit them.
  DecisionReplay(DrivePolicy policy, const AgentParameters& parameters, const ScanRules& rules);

  void startEpisode(const Episode& episode) override;
  /// Decides about a step that has just started, while somebody drives: advice(). Throws as addStep().
  void advise(const DriveStep& step);
  /// Decides, unless advise() has done it, and notes what the driver did: decisions(). Throws std::invalid_argument if
  /// the step has no scan, or one that the model was not made for.
  void addStep(const DriveStep& step) override;
  void endEpisode(double stamp, EpisodeEnd end) override;
  void reject(Rejection rejection) override { ++rejections_[static_cast<std::size_t>(rejection)]; }

  const std::vector<ReplayedDecision>& decisions() const { return decisions_; }
  /// The decision about the step that has started, without what the driver does. Empty as soon as that is known.
  const std::optional<ReplayedDecision>& advice() const { return advice_; }
  const RejectionCounts& rejections() const { return rejections_; }
  const PolicyDescription& description() const { return agent_.policy().description(); }

 private:
  ReplayedDecision decideAbout(const DriveStep& step);
  void noteJump();

  ScanRules rules_;
  NavigationAgent agent_;
  DriftCorrection drift_;
  GoalChanges goal_changes_;
  Situation situation_;
  std::optional<ReplayedDecision> advice_;
  std::optional<double> newest_;  ///< s, the stamp that was decided about last
  std::vector<ReplayedDecision> decisions_;
  RejectionCounts rejections_{};
  long episodes_ = 0;
  std::optional<Episode> episode_;  ///< that was started last
  bool is_new_goal_ = true;
  long jumps_ = 0;
};

/// How a drive is cut into steps for a replay: those of the planner, with the model's steering angles.
RecorderParameters replayParameters(const PolicyDescription& description, const AgentParameters& agent,
                                    const ScanRules& rules);

/// How often planner and driver did the same. All shares are 0 without decisions.
struct Agreement {
  long decisions = 0;
  long same_action = 0;            ///< the same steering angle
  double mean_difference = 0.0;    ///< rad, between the planner's angle and the driver's
  double balanced = 0.0;           ///< share of the same angles, the mean over the angles that the driver took
  double majority = 0.0;           ///< the majority-class baseline: always the driver's most frequent angle
  double majority_balanced = 0.0;  ///< balanced share of this baseline
  long asked = 0;                  ///< decisions for which the network was asked
  long preferred = 0;              ///< of these, those in which it preferred the driver's angle (thesis Eq. 4.3)
};
Agreement agreementOf(const std::vector<ReplayedDecision>& decisions);

/// "71 decisions in 2 episodes (network 60, goal in sight 11): the planner took the driver's steering angle at 52 (73
/// %, balanced 61 %; majority-class baseline: ...), their angles differ by 14 degrees on average; the
/// network preferred it at 40 of 60; not decided about: 5 standing".
std::string describeReplay(const DecisionReplay& replay);

/// CSV: one row a decision with episode, stamp, source, overruled, action, steering_angle, driven_action, driven_angle,
/// and the network's preferences, separated by spaces. Angles in rad.
void writeDecisions(const std::vector<ReplayedDecision>& decisions, std::ostream* out);

}  // namespace lstm_planner
