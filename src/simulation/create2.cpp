#include "lstm_planner/simulation/create2.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"

namespace lstm_planner {
namespace {

/// How the heading wanders (an Ornstein-Uhlenbeck process): rad per share of odometry_error, and over how many m.
constexpr double kHeadingError = 1.5;
constexpr double kHeadingMemory = 20.0;

}  // namespace

void validate(const Create2Parameters& parameters) {
  visitCreate2Parameters(parameters, RangeCheck());
  footprintOf(parameters);
}

Footprint footprintOf(const Create2Parameters& parameters) {
  return footprintOf("footprint", 0.5 * parameters.base_diameter, parameters.footprint);
}

Create2::Create2(const Create2Parameters& parameters, const Pose2& true_pose, std::uint64_t seed)
    : parameters_(parameters), true_pose_(true_pose), random_(seed) {
  validate(parameters_);
  if (!isFinite(true_pose)) throw std::invalid_argument("the robot's first pose is not finite");
  const double error = parameters_.odometry_error;
  if (error > 0.0) {
    length_error_ = uniform(random_, -error, error);
    turn_error_ = uniform(random_, -error, error);
  }
}

void Create2::command(const Twist2& twist) {
  left_.target_speed = 0.0;
  right_.target_speed = 0.0;
  if (!std::isfinite(twist.linear) || !std::isfinite(twist.angular)) return;
  const double limit = parameters_.max_wheel_speed;
  const double difference = 0.5 * twist.angular * parameters_.axle_length;
  left_.target_speed = std::clamp(twist.linear - difference, -limit, limit);
  right_.target_speed = std::clamp(twist.linear + difference, -limit, limit);
}

double Create2::advance(Wheel* wheel, double seconds) {
  const double change = wheel->target_speed - wheel->speed;
  const double ramp = std::min(seconds, std::abs(change) / parameters_.max_wheel_acceleration);
  const double speed = ramp < seconds ? wheel->target_speed
                                      : wheel->speed + std::copysign(ramp * parameters_.max_wheel_acceleration, change);
  const double distance = 0.5 * (wheel->speed + speed) * ramp + speed * (seconds - ramp);
  wheel->speed = speed;
  wheel->travelled += distance;
  return distance;
}

/// Odometry is what the encoders say, so its errors show in where the robot really gets to.
void Create2::moveTruly(double left, double right) {
  const double distance = 0.5 * (left + right) * (1.0 + length_error_);
  double turn = (right - left) / parameters_.axle_length * (1.0 + turn_error_);
  if (parameters_.odometry_error > 0.0 && distance != 0.0) {
    const double share = std::abs(distance) / kHeadingMemory;
    const double change =
        kHeadingError * parameters_.odometry_error * std::sqrt(2.0 * share) * normal(random_) - share * heading_error_;
    heading_error_ += change;
    turn += change;
  }
  true_pose_ = alongTurn(true_pose_, distance, turn);
  true_pose_.yaw = normalizeAngle(true_pose_.yaw);
}

void Create2::step(double seconds) {
  if (!(seconds > 0.0) || !std::isfinite(seconds)) return;
  const double left_slip = parameters_.slip > 0.0 ? parameters_.slip * normal(random_) : 0.0;
  const double right_slip = parameters_.slip > 0.0 ? parameters_.slip * normal(random_) : 0.0;
  const double left = advance(&left_, seconds) * (1.0 + parameters_.drift + left_slip);
  const double right = advance(&right_, seconds) * (1.0 - parameters_.drift + right_slip);
  moveTruly(left, right);

  const double tick_length = M_PI * parameters_.wheel_diameter / parameters_.ticks_per_revolution;
  const auto countTicks = [tick_length](Wheel* wheel) {
    // The tolerance keeps a wheel that stands on a border, but for rounding, from losing a tick.
    const long ticks = static_cast<long>(std::floor(wheel->travelled / tick_length + 1e-9));
    const long counted = ticks - wheel->ticks;
    wheel->ticks = ticks;
    return static_cast<double>(counted) * tick_length;
  };
  const double left_counted = countTicks(&left_);
  const double right_counted = countTicks(&right_);
  const double distance = 0.5 * (left_counted + right_counted);
  const double turn = (right_counted - left_counted) / parameters_.axle_length;
  odometry_ = alongMeanHeading(odometry_, distance, turn);
  measured_twist_ = {distance / seconds, turn / seconds};
}

void Create2::holdPosition(const Pose2& pose) { true_pose_ = pose; }

double Create2::wheelAngle(bool left) const {
  const long ticks = left ? left_.ticks : right_.ticks;
  return static_cast<double>(ticks) * 2.0 * M_PI / parameters_.ticks_per_revolution;
}

}  // namespace lstm_planner
