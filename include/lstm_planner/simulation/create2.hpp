#pragma once

#include <cstdint>
#include <string>

#include "lstm_planner/common/footprint.hpp"
#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/random.hpp"

namespace lstm_planner {

/// The iRobot Create 2 (create_robot's CREATE_2 model) and its errors. Units: visitCreate2Parameters().
struct Create2Parameters {
  double axle_length = 0.235;
  double wheel_diameter = 0.072;
  double ticks_per_revolution = 508.8;
  double max_wheel_speed = 0.5;
  double base_diameter = 0.3485;
  std::string footprint = "";
  double max_wheel_acceleration = 2.0;
  double slip = 0.0;
  double drift = 0.0;
  /// Error of the odometry, as a share of the distance. Each robot draws from its seed one error of all lengths and one
  /// of all turns, both uniform in +-odometry_error. Its heading also has an error that changes slowly around 0:
  /// normal,
  /// 1.5 odometry_error rad, forgotten within 20 m. If the robot goes straight on, its position is then wrong by that
  /// share of the distance (root mean square), after 10 m and after 100 m.
  double odometry_error = 0.0;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitCreate2Parameters(Parameters& robot, const Visitor& visit) {
  visit("axle_length", robot.axle_length, {0.01, 5.0}, "m", "wheel separation (track width)");
  visit("wheel_diameter", robot.wheel_diameter, {0.001, 5.0}, "m", "of each wheel");
  visit("ticks_per_revolution", robot.ticks_per_revolution, {1.0, 1e6}, "", "of a wheel's encoder");
  visit("max_wheel_speed", robot.max_wheel_speed, {0.01, 20.0}, "m/s",
        "each wheel is clipped on its own, so the curvature changes");
  visit("base_diameter", robot.base_diameter, {0.01, 10.0}, "m",
        "of the footprint; a contact is counted when it touches something");
  visit("footprint", robot.footprint, {}, "m",
        "corners [[x, y], ...] of a robot that is not round, in place of base_diameter; empty: it is round");
  visit("max_wheel_acceleration", robot.max_wheel_acceleration, {0.01, 1e9}, "m/s^2", "of each wheel");
  visit("slip", robot.slip, {0.0, 1.0}, "",
        "standard deviation of each wheel's true travel relative to what its encoder counts, per step");
  visit("drift", robot.drift, {-1.0, 1.0}, "",
        "constant relative error of the left wheel's travel; the right wheel has the opposite one");
  visit("odometry_error", robot.odometry_error, {0.0, 0.5}, "",
        "share of the distance by which odometry errs: 0.02 = 2 %");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const Create2Parameters& parameters);

/// The footprint with which contacts are counted. Throws as validate().
Footprint footprintOf(const Create2Parameters& parameters);

/// Differential drive with encoders. A step moves the true pose exactly along the arc that the two wheels travel. The
/// odometry adds up whole encoder ticks as create_robot does: the mean of the wheels along the mean heading, and their
/// difference divided by the axle length as the turn. Odometry starts at (0, 0, 0). The same for the same seed.
class Create2 {
 public:
  /// Throws as validate(), and std::invalid_argument for a pose that is not finite.
  Create2(const Create2Parameters& parameters, const Pose2& true_pose, std::uint64_t seed);

  void command(const Twist2& twist);  ///< wheel speeds are clipped here; a non-finite twist stops the robot
  void step(double seconds);          ///< moves; the caller handles contacts with holdPosition()

  /// Puts the robot back to `pose`, because it ran into something; the encoders keep their counts.
  void holdPosition(const Pose2& pose);

  const Pose2& truePose() const { return true_pose_; }
  const Pose2& odometry() const { return odometry_; }
  /// Twist of the last step() by the encoders.
  const Twist2& measuredTwist() const { return measured_twist_; }
  double wheelAngle(bool left) const;  ///< rad since the start, from the encoder

 private:
  /// One of the two wheels.
  struct Wheel {
    double target_speed = 0.0;  ///< m/s
    double speed = 0.0;         ///< m/s
    double travelled = 0.0;     ///< m, as the encoder would count with endless resolution
    long ticks = 0;
  };
  double advance(Wheel* wheel, double seconds);
  void moveTruly(double left, double right);

  Create2Parameters parameters_;
  Pose2 true_pose_;
  Pose2 odometry_;
  Twist2 measured_twist_;
  Wheel left_;
  Wheel right_;
  Random random_;
  double heading_error_ = 0.0;  ///< rad, slowly changing error of the counted heading
  double length_error_ = 0.0;   ///< relative, of every length that odometry counts
  double turn_error_ = 0.0;     ///< relative, of every turn that odometry counts
};

}  // namespace lstm_planner
