#pragma once

#include <array>
#include <string>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/decision/goal_tracker.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/drive/perception/observation.hpp"

namespace lstm_planner {

/// Larger than any coordinate (m), time (s) or angle (rad) that is measured; sums and squares of smaller numbers are
/// finite.
constexpr double kLargestNumber = 1e10;

/// Beams of a scan; more than any scanner has.
constexpr int kMostBeams = 100'000;

/// How a scan was taken: the same for many steps.
struct ScanGeometry {
  std::string frame;             ///< the scanner's
  double angle_min = 0.0;        ///< rad
  double angle_increment = 0.0;  ///< rad
  int beams = 0;
  double range_min = 0.0;  ///< m
  double range_max = 0.0;  ///< m
  SensorMount mount;       ///< in the base frame

  bool operator==(const ScanGeometry& other) const;
};

/// A scan of that geometry, without stamp.
LaserScan scanOf(const ScanGeometry& geometry, std::vector<float> ranges);

/// One step of somebody's drive, as it was measured: what was seen, where the goal was, and which way was taken.
/// Nothing in it is scaled, so that it can be encoded for any network later.
struct DriveStep {
  long number = 0;          ///< in its episode, from 0; a gap is a step to which no allowed angle was near enough
  double stamp = 0.0;       ///< s, of the scan
  double next_stamp = 0.0;  ///< s, of the next step's scan: when the label became known
  Pose2 pose;               ///< base in the odometry frame at `stamp`
  Pose2 next_pose;          ///< the same at `next_stamp`
  Twist2 twist;             ///< of the base at `stamp`
  Point2 goal;              ///< odometry frame, m

  /// The network's observation, with the position not rounded (EncoderParameters::position_cell of 0). The previous
  /// action is the angle of the label of the step before; 0 in the first step of an episode.
  Observation observation;
  std::array<double, kSectorCount> minimum_ranges{};  ///< m, nearest return of each sector; +inf where there is none
  std::array<int, kSectorCount> beams{};              ///< beams of each sector
  std::array<int, kSectorCount> measured{};           ///< of these, beams with a measured range

  double driven_angle = 0.0;  ///< rad in (-pi, pi], gamma of thesis Eq. 4.1: see drivenAngle()
  int label = 0;              ///< index of the allowed angle that is nearest to driven_angle (Eq. 4.2)

  ScanGeometry geometry;
  std::vector<float> ranges;  ///< m, as the scanner's driver published them; empty if scans are not kept
};

/// Why an episode ended.
enum class EpisodeEnd {
  kRunning,       ///< it has not ended; or the recording was cut off
  kArrived,       ///< the robot came within the goal tolerance
  kNewGoal,       ///< another goal was given
  kAborted,       ///< the goal was cancelled or given up
  kTimeJump,      ///< the clock jumped, or nothing was heard for longer than RecorderParameters::max_gap
  kOdometryJump,  ///< the odometry jumped
  kPaused,        ///< recording was paused
  kFinished       ///< recording ended
};
const char* toString(EpisodeEnd end);
/// Throws std::invalid_argument for another text than toString() gives.
EpisodeEnd episodeEndNamed(const std::string& name);

/// A drive to one goal.
struct Episode {
  GoalInFrame goal;         ///< as it was given; in the odometry frame if it was given in one of the robot's
  std::string goal_source;  ///< where it came from: a topic, "waypoints", "hindsight"
  double begun = 0.0;       ///< s
  double ended = 0.0;       ///< s
  EpisodeEnd end = EpisodeEnd::kRunning;
  bool discarded = false;  ///< by the driver; nothing is learned from it
};

/// Why something that was seen has not become a step.
enum class Rejection {
  kNoGoal,          ///< there was no goal to drive to
  kStanding,        ///< the robot had not moved since the last step
  kPaused,          ///< recording was paused
  kNoOdometry,      ///< no odometry around the scan
  kNoTransform,     ///< the pose of the scanner or of the goal's frame was not known
  kUnusableScan,    ///< perceive() refused it, or the scanner is covered (SilenceWatch); counted once in a period
  kNotFinite,       ///< a message with a number that is not finite, or larger than any measurement: flawOf()
  kLate,            ///< odometry or a scan that came after messages with later stamps were processed
  kNoAllowedAngle,  ///< the robot went where no allowed angle leads, e.g. backwards
  kNoNextStep,      ///< its episode ended before its label was known
};
constexpr int kRejectionCount = 10;
const char* toString(Rejection rejection);
/// Throws std::invalid_argument for another text than toString() gives.
Rejection rejectionNamed(const std::string& name);

/// How often each of them occurred.
using RejectionCounts = std::array<long, kRejectionCount>;
/// "3 standing, 1 late"; empty if there are none.
std::string textOf(const RejectionCounts& counts);

/// gamma of thesis Eq. 4.1: the direction in which the robot went from one pose to the next, relative to its heading at
/// the first, rad in (-pi, pi]. If it went less than `min_distance` (m), it has turned in place: then the turn.
double drivenAngle(const Pose2& from, const Pose2& to, double min_distance);

/// Receives what a recorder records, in the order in which it happens.
class StepSink {
 public:
  virtual ~StepSink() = default;
  virtual void startEpisode(const Episode& episode) = 0;
  /// A step of the newest episode has started; its label is not known yet. addStep() or reject() follows when it is.
  virtual void startStep(const DriveStep& /*step*/) {}
  virtual void addStep(const DriveStep& step) = 0;  ///< of the episode that was started last
  virtual void endEpisode(double stamp, EpisodeEnd end) = 0;
  virtual void reject(Rejection rejection) = 0;
  /// Why a message or a scan was rejected, if more is known than the kind. Called after reject().
  virtual void explain(Rejection /*rejection*/, const std::string& /*why*/) {}
};

}  // namespace lstm_planner
