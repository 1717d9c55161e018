#include "lstm_planner/simulation/simulated_robot.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/drive/perception/deskew.hpp"

namespace lstm_planner {
namespace {

constexpr std::uint64_t kSecondSeed = 0x2545F4914F6CDD1D;  // any: the noise of two scanners differs

constexpr double kSameTime = 1e-6;       // s
constexpr double kNoSpeed = 1e6;         // m/s: the simulation's poses do not jump
constexpr double kStandingSpeed = 0.02;  // m/s; who is slower towards somebody is not driving into him

/// m/s towards `other`.
double approachSpeed(const Point2& position, const Point2& velocity, const Point2& other) {
  const double direction = directionTo(position, other);
  return velocity.x * std::cos(direction) + velocity.y * std::sin(direction);
}

}  // namespace

SimulatedRobot::SimulatedRobot(const World& world, const Parameters& parameters, const Pose2& start, std::uint64_t seed)
    : world_(world),
      parameters_(parameters),
      base_(parameters.base, start, seed),
      footprint_(footprintOf(parameters.base)),
      scanner_(parameters.scanner, ~seed),
      true_poses_(kNoSpeed),
      odometries_(kNoSpeed) {
  visitSimulatedRobotParameters(parameters, RangeCheck());
  if (parameters.second_scanner) {
    second_ = SecondScanner{Hokuyo(*parameters.second_scanner, seed ^ kSecondSeed), {}, {}, 0.0};
  }
}

double SimulatedRobot::Parameters::longestScanPeriod() const {
  const double rate = second_scanner ? std::min(scanner.rate, second_scanner->rate) : scanner.rate;
  return 1.0 / rate;
}

SimulatedRobot::SimulatedRobot(Traffic* traffic, const Parameters& parameters, const Pose2& start, std::uint64_t seed)
    : SimulatedRobot(*traffic, parameters, start, seed) {
  traffic_ = traffic;
}

void SimulatedRobot::obeyCommands() {
  while (!commands_.empty() && commands_.front().time <= time_ + 1e-9) {
    base_.command(commands_.front().twist);
    commands_.pop_front();
  }
}

/// Whether the robot at `pose` touches nobody but walkers that have run into it (counted then) and lets them pass.
bool SimulatedRobot::isBrushedBy(const Pose2& pose, const Point2& velocity) const {
  if (traffic_ == nullptr || traffic_->surroundings()->touches(footprint_, pose)) return false;
  const std::vector<Circle>& bodies = traffic_->circles();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool touches = airBetween(footprint_, pose, bodies[i]) < 0.0;
    const double approach = approachSpeed({pose.x, pose.y}, velocity, bodies[i].center);
    if (touches && !(traffic_->isBesideRobot(i) && approach <= kStandingSpeed)) return false;
  }
  return true;
}

/// Moves unless something is in the way; returns the velocity that the robot had or wanted, m/s in the world.
Point2 SimulatedRobot::move(double seconds) {
  const Pose2 before = base_.truePose();
  base_.step(seconds);
  const Pose2 after = base_.truePose();
  const Point2 velocity{(after.x - before.x) / seconds, (after.y - before.y) / seconds};
  const bool blocked = world_.touches(footprint_, after);
  if (blocked) base_.holdPosition({before.x, before.y, footprint_.isCircle() ? after.yaw : before.yaw});
  contacts_.note(blocked && !isBrushedBy(after, velocity));
  path_length_ += distanceBetween(before, base_.truePose());
  return velocity;
}

void SimulatedRobot::letWalk(double seconds, const Point2& velocity) {
  const Point2 here{base_.truePose().x, base_.truePose().y};
  for (const Circle& walker : traffic_->advance(seconds, footprint_, base_.truePose())) {
    if (contacts_.isTouching()) continue;  // counted already
    const double approach = approachSpeed(here, velocity, walker.center);
    const bool moves = std::hypot(velocity.x, velocity.y) > kStandingSpeed;
    if (approach > kStandingSpeed) {
      contacts_.add();
    } else {
      ++bumped_;
      bumped_moving_ += moves ? 1 : 0;
    }
  }
}

void SimulatedRobot::advance(double seconds) {
  double left = seconds;
  while (left > 1e-9) {
    const double period = std::min(left, parameters_.physics_period);
    obeyCommands();
    const Point2 velocity = move(period);
    if (traffic_ != nullptr) letWalk(period, velocity);
    time_ += period;
    if (parameters_.isSwept()) {
      true_poses_.add({time_, base_.truePose(), {}});
      odometries_.add({time_, odometry(), {}});
    }
    left -= period;
  }
}

void SimulatedRobot::takeScan(Hokuyo* scanner, LaserScan* scan) const {
  const auto poseAt = [this](double time) { return true_poses_.empty() ? base_.truePose() : true_poses_.poseAt(time); };
  scanner->sweep(world_, poseAt, scanner->stampOf(time_), scan);
}

void SimulatedRobot::straighten(const Hokuyo& scanner, LaserScan* scan) const {
  if (!parameters_.corrects_scans) return;
  ScanRules rules = Hokuyo::rules();
  rules.beam_times = scanner.parameters().beam_times;
  deskew(
      scanner.parameters().mount, rules, [this](double time) { return odometryAt(time); }, scan);
}

void SimulatedRobot::scan(LaserScan* scan) { takeScan(&scanner_, scan); }

void SimulatedRobot::sense(double range_cap, Situation* situation) {
  scan(&scan_);
  straighten(scanner_, &scan_);
  perceive(scan_, parameters_.scanner.mount, Hokuyo::rules(), range_cap, situation);
  situation->time = scan_.stamp;
  situation->pose = odometryAt(scan_.stamp);
  if (second_) senseWithSecond(situation);
}

void SimulatedRobot::senseWithSecond(Situation* situation) {
  if (time_ >= second_->next) {
    takeScan(&second_->scanner, &second_->scan);
    straighten(second_->scanner, &second_->scan);
    second_->pose = odometryAt(second_->scan.stamp);
    second_->next = time_ + 1.0 / second_->scanner.parameters().rate - kSameTime;
  }
  const LaserScan& scan = second_->scan;
  perceiveSecond({scan, second_->scanner.parameters().mount, second_->pose, scan.stamp}, Hokuyo::rules(), situation);
}

}  // namespace lstm_planner
