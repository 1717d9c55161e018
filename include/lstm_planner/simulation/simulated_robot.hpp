#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "lstm_planner/drive/perception/odometry_history.hpp"
#include "lstm_planner/drive/perception/situation.hpp"
#include "lstm_planner/simulation/contact_count.hpp"
#include "lstm_planner/simulation/create2.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"
#include "lstm_planner/simulation/traffic.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// A Create 2 with a Hokuyo in a world: moves, senses, counts contacts. No ROS, no real time; the same for the same
/// seed. People in the world move as time passes for the robot.
///
/// A contact is caused by the robot: it drove into something, or met a walker towards whom it was driving. A walker who
/// runs into a robot that stands, or drives in another direction, has bumped into it.
class SimulatedRobot {
 public:
  /// What the robot is made of; periods and times in s.
  struct Parameters {
    Create2Parameters base;
    HokuyoParameters scanner;
    double physics_period = 0.02;
    double latency = 0.0;
    std::optional<HokuyoParameters> second_scanner = std::nullopt;  ///< none unless it is set
    bool corrects_scans = true;                                     ///< takes its motion out of them: deskew()

    /// Time from one scan to the next of the slowest scanner, s.
    double longestScanPeriod() const;
    /// Whether a scanner measures its beams one after the other.
    bool isSwept() const { return scanner.isSwept() || (second_scanner && second_scanner->isSwept()); }
  };

  /// `world` must outlive the robot. Throws as Create2 and Hokuyo.
  SimulatedRobot(const World& world, const Parameters& parameters, const Pose2& start, std::uint64_t seed);
  /// Among moving bodies; `traffic` must outlive the robot.
  SimulatedRobot(Traffic* traffic, const Parameters& parameters, const Pose2& start, std::uint64_t seed);

  /// Takes effect when the latency has passed.
  void command(const Twist2& twist) { commands_.push_back({time_ + parameters_.latency, twist}); }

  /// Lets so much time pass, s.
  void advance(double seconds);

  /// The scan that ends now, corrected by the odometry (deskew()); the pose of `situation` is the odometry at its
  /// stamp. A second scanner scans at its own rate; between its scans its last one counts.
  void sense(double range_cap, Situation* situation);

  /// The scan that ends now, as the driver would publish it; `scan` is overwritten and its memory reused.
  void scan(LaserScan* scan);

  double time() const { return time_; }  ///< s since the start
  const Pose2& truePose() const { return base_.truePose(); }
  const Pose2& odometry() const { return base_.odometry(); }  ///< in a frame that starts at the start
  const Twist2& measuredTwist() const { return base_.measuredTwist(); }
  /// How often the footprint started to touch something, without walkers that ran into it (see above).
  int contacts() const { return contacts_.contacts(); }
  int bumped() const { return bumped_; }               ///< how often a walker ran into the robot
  int bumpedMoving() const { return bumped_moving_; }  ///< of those, while it moved aside or away from the walker
  double pathLength() const { return path_length_; }   ///< m truly driven

 private:
  /// A command that has not reached the wheels yet.
  struct Command {
    double time = 0.0;  ///< s, when it takes effect
    Twist2 twist;
  };
  void takeScan(Hokuyo* scanner, LaserScan* scan) const;
  void straighten(const Hokuyo& scanner, LaserScan* scan) const;
  Pose2 odometryAt(double time) const { return odometries_.empty() ? odometry() : odometries_.poseAt(time); }
  void obeyCommands();
  Point2 move(double seconds);
  void senseWithSecond(Situation* situation);
  bool isBrushedBy(const Pose2& pose, const Point2& velocity) const;
  void letWalk(double seconds, const Point2& velocity);

  const World& world_;
  Parameters parameters_;
  Create2 base_;
  Footprint footprint_;
  Hokuyo scanner_;
  LaserScan scan_;
  /// A second scanner, and what it saw last.
  struct SecondScanner {
    Hokuyo scanner;
    LaserScan scan;
    Pose2 pose;         ///< odometry then
    double next = 0.0;  ///< s, of its next scan
  };
  std::optional<SecondScanner> second_;
  std::deque<Command> commands_;
  double time_ = 0.0;
  OdometryHistory true_poses_;  ///< of the last second; empty unless a scanner measures its beams one after the other
  OdometryHistory odometries_;  ///< likewise
  Traffic* traffic_ = nullptr;
  ContactCount contacts_;
  int bumped_ = 0;
  int bumped_moving_ = 0;
  double path_length_ = 0.0;
};

/// Visits the parameters that are not those of base and scanner; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitSimulatedRobotParameters(Parameters& robot, const Visitor& visit) {
  visit("physics_period", robot.physics_period, {1e-4, 1.0}, "s", "from one calculated motion to the next");
  visit("latency", robot.latency, {0.0, 10.0}, "s",
        "from a command to the motion of the wheels, rounded to physics periods");
}

}  // namespace lstm_planner
