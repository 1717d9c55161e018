#include "lstm_planner/drive/decision/bug_algorithm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lstm_planner {

namespace {
/// Boundaries that are gone around twice before it gives up for good.
constexpr int kMostRounds = 5;
}  // namespace

BugAlgorithm::BugAlgorithm(const EscapeParameters& parameters, const ShieldParameters& shield)
    : parameters_(parameters),
      roomy_clearance_(shield.clearance),
      tight_clearance_(shield.tight_clearance),
      sight_(shield.reach - footprintOf(shield).circumscribedRadius()) {}

void BugAlgorithm::start() {
  leave_below_ = std::numeric_limits<double>::infinity();
  following_ = false;
  rounds_ = 0;
}

void BugAlgorithm::moveGoal(const Point2& from, const Point2& to) {
  leave_below_ += distanceBetween(hit_position_, to) - distanceBetween(hit_position_, from);
}

BugAlgorithm::Answer BugAlgorithm::decide(const Situation& situation, const Shield& shield, const Point2& goal,
                                          double target_distance, Heading* move) {
  const double distance = distanceBetween(situation.pose, goal);
  const double open = openTowardsGoal(situation, shield, goal, distance);
  const bool can_go = open >= std::min(distance, parameters_.follow_step);
  if (following_) {
    measureBoundary(situation.pose);
    // Where the straight path leads nearer to the goal than where the boundary was met (Kamon and Rivlin's leaving
    // condition), even if the robot itself is not nearer yet.
    // Beside and behind the robot the scanner may be blind: only its own place counts there.
    const bool seen = std::abs(normalizeAngle(directionTo(situation.pose, goal) - situation.pose.yaw)) <= M_PI_2;
    const double nearest = seen ? distance - open : distance;
    if (can_go && nearest < leave_below_ - parameters_.leave_margin) {
      following_ = false;
      leave_below_ = nearest;  // What turns out not to be open must not be believed again.
    } else if (loopClosed(situation.pose)) {
      if (tight_ || rounds_ == kMostRounds) {
        return Answer::kNoPath;
      }
      followTight(situation.pose, goal);
    }
  }
  if (!following_) {
    if (distance < target_distance) {
      return Answer::kNearer;
    }
    if (can_go) {
      *move = {directionTo(situation.pose, goal), std::min(distance, parameters_.follow_step)};
      return Answer::kGo;
    }
    meetBoundary(situation, shield, goal);
  }
  *move = follow(situation, shield);
  return move->distance > 0.0 ? Answer::kGo : Answer::kLookAround;
}

double BugAlgorithm::openTowardsGoal(const Situation& situation, const Shield& shield, const Point2& goal,
                                     double distance) const {
  const double direction = directionTo(situation.pose, goal) - situation.pose.yaw;
  return shield.freeDistance({}, direction, std::min(distance, sight_), clearance());
}

double BugAlgorithm::clearance() const { return following_ && tight_ ? tight_clearance_ : roomy_clearance_; }

void BugAlgorithm::followTight(const Pose2& pose, const Point2& goal) {
  // Noise makes doors look narrower than they are: once more around, as close as the robot can.
  tight_ = true;
  ++rounds_;
  leave_below_ = distanceBetween(hit_position_, goal);
  along_ = 0.0;
  turned_ = 0.0;
  sense_ = 1;  // this way round is now the first direction
  leg_ = std::numeric_limits<double>::infinity();
  last_position_ = pose;
}

void BugAlgorithm::meetBoundary(const Situation& situation, const Shield& shield, const Point2& goal) {
  following_ = true;
  hit_position_ = {situation.pose.x, situation.pose.y};
  leave_below_ = std::min(leave_below_, distanceBetween(situation.pose, goal));
  last_position_ = situation.pose;
  along_ = 0.0;
  turned_ = 0.0;
  sense_ = 1;
  leg_ = parameters_.first_leg;
  tight_ = false;

  // The side that needs the smaller turn away from the goal; the wall is then on the other one.
  const double to_goal = directionTo(situation.pose, goal);
  double turn[2] = {M_PI, M_PI};
  for (const int side : {-1, 1}) {
    for (double angle = 0.0; angle < M_PI; angle += parameters_.probe_angle) {
      const double direction = to_goal + side * angle - situation.pose.yaw;
      if (shield.isFree({}, direction, parameters_.follow_step, clearance())) {
        turn[(side + 1) / 2] = angle;
        break;
      }
    }
  }
  side_ = turn[1] <= turn[0] ? -1 : 1;
  // The boundary is still ahead, not aside: probing has to start at the goal's direction.
  travel_direction_ = normalizeAngle(to_goal - side_ * parameters_.wall_turn);
}

void BugAlgorithm::measureBoundary(const Pose2& pose) {
  const double moved = distanceBetween(last_position_, pose);
  // Shorter moves have no reliable direction.
  if (moved < 0.3 * parameters_.follow_step) {
    return;
  }
  const double direction = directionTo(last_position_, pose);
  // How the boundary runs where it was met: the turn away from the goal, which may be driven as an arc, is no part of
  // it.
  const bool departing = turned_ == 0.0 && std::abs(along_) < 2.0 * parameters_.follow_step;
  if (departing) {
    departure_direction_ = direction;
  } else {
    turned_ += turnOf(direction);
  }
  along_ += sense_ * moved;
  travel_direction_ = direction;
  last_position_ = pose;
  if (sense_ * along_ >= leg_) {
    // The other way round: what was on the right is now on the left.
    sense_ = -sense_;
    side_ = -side_;
    travel_direction_ = normalizeAngle(travel_direction_ + M_PI);
    leg_ *= 2.0;
  }
}

double BugAlgorithm::turnOf(double direction) const {
  // Probing starts wall_turn on the side of the wall and sweeps away from it: a larger turn towards the wall than that
  // was really one away from it, of more than half a circle.
  const double turn = normalizeAngle(direction - travel_direction_);
  const double slack = 0.35;
  return side_ * turn > parameters_.wall_turn + slack ? turn - side_ * 2.0 * M_PI : turn;
}

bool BugAlgorithm::loopClosed(const Pose2& pose) const {
  if (std::abs(along_) < parameters_.loop_length || distanceBetween(pose, hit_position_) > parameters_.loop_tolerance) {
    return false;
  }
  // A closed boundary turns by a full circle, and comes back as it went.
  const double off_circle = std::abs(std::abs(turned_) - 2.0 * M_PI);
  const double direction = sense_ > 0 ? departure_direction_ : departure_direction_ + M_PI;
  return off_circle < M_PI_2 && std::abs(normalizeAngle(travel_direction_ - direction)) < M_PI_2;
}

Heading BugAlgorithm::follow(const Situation& situation, const Shield& shield) {
  const double start = travel_direction_ + side_ * parameters_.wall_turn;
  Heading move;
  if (probe(situation, shield, start, clearance(), &move) || probe(situation, shield, start, tight_clearance_, &move)) {
    return move;
  }
  // Boxed in as far as can be seen: turn towards where nothing has been seen.
  return {situation.pose.yaw - side_ * 2.0, 0.0};
}

bool BugAlgorithm::probe(const Situation& situation, const Shield& shield, double start, double clearance,
                         Heading* move) const {
  const int probes = static_cast<int>(2.0 * M_PI / parameters_.probe_angle);
  for (int i = 0; i < probes; ++i) {
    const double direction = start - side_ * i * parameters_.probe_angle;
    const double free = shield.freeDistance({}, direction - situation.pose.yaw, parameters_.follow_step, clearance);
    if (free >= parameters_.follow_step) {
      *move = {normalizeAngle(direction), parameters_.follow_step};
      return true;
    }
  }
  return false;
}

}  // namespace lstm_planner
