#include "lstm_planner/evaluation/simulated_robot.hpp"

#include <algorithm>

#include "lstm_planner/parameter_check.hpp"

namespace lstm_planner {

SimulatedRobot::SimulatedRobot(const World& world, const Parameters& parameters, const Pose2& start, std::uint64_t seed)
    : world_(world), parameters_(parameters), base_(parameters.base, start, seed), scanner_(parameters.scanner, ~seed) {
  checkPositive("physics_period", parameters.physics_period);
  checkParameter(parameters.latency >= 0.0 && parameters.latency <= 10.0, "latency", parameters.latency,
                 "a time in [0, 10] s");
}

void SimulatedRobot::obeyCommands() {
  while (!commands_.empty() && commands_.front().time <= time_ + 1e-9) {
    base_.command(commands_.front().twist);
    commands_.pop_front();
  }
}

void SimulatedRobot::advance(double seconds) {
  double left = seconds;
  while (left > 1e-9) {
    const double period = std::min(left, parameters_.physics_period);
    obeyCommands();
    const Pose2 before = base_.truePose();
    base_.step(period);
    const bool touches = world_.touches({base_.truePose().x, base_.truePose().y}, 0.5 * parameters_.base.base_diameter);
    if (touches) {
      contacts_ += touching_ ? 0 : 1;
      base_.holdPosition({before.x, before.y, base_.truePose().yaw});
    }
    touching_ = touches;
    path_length_ += distanceBetween(before, base_.truePose());
    time_ += period;
    left -= period;
  }
}

void SimulatedRobot::sense(double range_cap, Situation* situation) {
  scanner_.scan(world_, base_.truePose(), time_, &scan_);
  perceive(scan_, parameters_.scanner.mount, {}, range_cap, situation);
  situation->time = time_;
  situation->pose = base_.odometry();
}

}  // namespace lstm_planner
