#include "lstm_planner/simulation/scripted_driver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/simulation/standing_cells.hpp"

namespace lstm_planner {
namespace {

constexpr double kLookPeriod = 0.1;     // s between two looks while nothing changes
constexpr double kNearestPath = 0.4;    // m from a place too near to a wall to where a path starts
constexpr double kForesight = 0.7;      // s of driving on that must not lead into anything
constexpr double kInertia = 0.08;       // s that he knows his robot to take to do what the keys say
constexpr double kForesightStep = 0.1;  // s
constexpr double kUsualMargin = 0.04;   // m between footprint and walls that is driven with where there is room
constexpr double kAimedMargin = 0.02;   // m; by who is aimed well
constexpr double kTightMargin = 0.005;  // m; and where there is not
constexpr double kAimed = 0.1;          // rad; nearer to the direction of the path than this is aimed at it
constexpr double kSteered = 0.2;        // rad away from it before a turn key is pressed while driving
constexpr double kAttention = 2.0;      // s after which it is aimed anew, badly in another way

Pose2 driveOn(const Pose2& pose, const Twist2& twist, double seconds) {
  const double middle = pose.yaw + 0.5 * twist.angular * seconds;
  const Point2 there = pointAlong(pose, middle, twist.linear * seconds);
  return {there.x, there.y, pose.yaw + twist.angular * seconds};
}

}  // namespace

void validate(const ScriptedDriverParameters& parameters) {
  visitDriverParameters(parameters, RangeCheck());
  checkParameter(parameters.sharp_turn > kSteered, "sharp_turn", parameters.sharp_turn, "more than 0.2 rad");
  checkParameter(parameters.longest_reaction >= parameters.shortest_reaction, "longest_reaction",
                 parameters.longest_reaction, "at least shortest_reaction");
}

ScriptedDriver::ScriptedDriver(const GridWorld& world, const ScriptedDriverParameters& parameters, std::uint64_t seed)
    : world_(world), parameters_(parameters), distances_(world.grid(), true), random_(seed) {
  validate(parameters);
}

void ScriptedDriver::setGoal(const Point2& goal) {
  goal_ = goal;
  GeodesicField::Options options;
  const double radius = distanceNeeded(parameters_.footprint_radius, world_.grid());
  options.clearance = radius + parameters_.clearance;
  options.comfort = radius + std::max(parameters_.comfort, parameters_.clearance);
  options.reluctance = parameters_.reluctance;
  field_.emplace(world_.grid(), distances_, world_.grid().cellAt(goal), options);
  state_ = State::kDriving;
  turning_ = false;
}

void ScriptedDriver::dropGoal() {
  field_.reset();
  keys_ = {};
  decided_.reset();
  state_ = State::kWaiting;
}

CellIndex ScriptedDriver::startOfPath(const Point2& position) const {
  const OccupancyGrid& grid = world_.grid();
  const CellIndex here = grid.cellAt(position);
  if (std::isfinite(field_->at(here))) return here;
  const int reach = static_cast<int>(kNearestPath / grid.resolution());
  CellIndex best = here;
  double nearest = std::numeric_limits<double>::infinity();
  for (int row = here.row - reach; row <= here.row + reach; ++row) {
    for (int column = here.column - reach; column <= here.column + reach; ++column) {
      const double distance = distanceBetween(position, grid.centerOf({column, row}));
      if (distance >= nearest || !std::isfinite(field_->at({column, row}))) continue;
      best = {column, row};
      nearest = distance;
    }
  }
  return best;
}

/// Whether all of a straight path is such that the robot may go there.
bool ScriptedDriver::isOpen(const Point2& from, const Point2& to) const {
  const double length = distanceBetween(from, to);
  const double direction = directionTo(from, to);
  for (double s = 0.0; s < length; s += 0.5 * world_.grid().resolution()) {
    if (!std::isfinite(field_->at(world_.grid().cellAt(pointAlong(from, direction, s))))) return false;
  }
  return true;
}

/// The farthest point of the path within the lookahead that can be driven at straight on.
Point2 ScriptedDriver::pointAhead(const Point2& position) const {
  const OccupancyGrid& grid = world_.grid();
  CellIndex cell = startOfPath(position);
  Point2 ahead = grid.centerOf(cell);
  const bool off_the_path = !std::isfinite(field_->at(grid.cellAt(position)));
  while (distanceBetween(position, grid.centerOf(cell)) < parameters_.lookahead) {
    const CellIndex next = field_->nextOnPath(cell);
    if (next == cell) return off_the_path ? ahead : goal_;
    const Point2 center = grid.centerOf(next);
    if (!off_the_path && !isOpen(position, center)) break;
    cell = next;
    ahead = center;
    if (off_the_path && distanceBetween(position, ahead) > kNearestPath) break;
  }
  return ahead;
}

Twist2 ScriptedDriver::twistOf(const Keys& keys) const {
  return {keys.forward ? parameters_.speed : 0.0, keys.turn * parameters_.turn_speed};
}

/// Whether driving on like this brings the robot near to something; nearer than it is already, where it is near.
bool ScriptedDriver::isSafe(const Pose2& pose, const Keys& keys) const {
  if (!keys.forward) return true;
  const auto touches = [&](const Pose2& there, double margin) {
    const Point2 center{there.x, there.y};
    return world_.touches(center, parameters_.footprint_radius + margin) ||
           world_.grid().at(world_.grid().cellAt(center)) != Cell::kFree;
  };
  const double usual = is_aimed_ ? kAimedMargin : kUsualMargin;
  const double margin = touches(pose, usual) ? kTightMargin : usual;
  for (double seconds = kForesightStep; seconds < kForesight; seconds += kForesightStep) {
    if (touches(driveOn(pose, twistOf(keys), seconds), margin)) return false;
  }
  return true;
}

void ScriptedDriver::wander(double seconds) {
  const double kept = std::exp(-std::max(0.0, seconds) / kAttention);
  aim_error_ = kept * aim_error_ + std::sqrt(1.0 - kept * kept) * parameters_.wander * normal(random_);
}

bool ScriptedDriver::pauses(double time) {
  if (time < pause_end_) return true;
  const double chance = parameters_.pause_interval > 0.0 ? kLookPeriod / parameters_.pause_interval : 0.0;
  if (uniform(random_) >= chance) return false;
  pause_end_ = time + parameters_.longest_pause * uniform(random_);
  return true;
}

ScriptedDriver::Keys ScriptedDriver::steer(const Pose2& pose, double error) {
  const int side = error > 0.0 ? 1 : -1;
  is_aimed_ = false;
  turning_ = std::abs(error) > (turning_ ? kAimed : parameters_.sharp_turn);
  if (turning_) return {false, side};
  const bool steers = parameters_.drives_arcs && std::abs(error) > (keys_.turn == side ? kAimed : kSteered);
  const Keys steering{true, side};
  if (steers && isSafe(pose, steering)) return steering;
  // In a narrow passage he drives on when he is aimed well, or he would turn to and fro for ever.
  is_aimed_ = std::abs(error) < kAimed;
  const Keys straight{true, 0};
  if (isSafe(pose, straight)) return straight;
  // Aimed too badly to drive on.
  turning_ = true;
  return {false, side};
}

ScriptedDriver::Keys ScriptedDriver::decide(const Pose2& pose) {
  const Point2 here{pose.x, pose.y};
  if (distanceBetween(here, goal_) < parameters_.arrival_distance) return {};
  if (!std::isfinite(field_->at(startOfPath(here)))) {
    state_ = State::kNoPath;
    return {};
  }
  return steer(pose, normalizeAngle(directionTo(here, pointAhead(here)) + aim_error_ - pose.yaw));
}

void ScriptedDriver::reconsider(const Pose2& pose, double time) {
  wander(time - last_look_);
  last_look_ = time;
  next_look_ = time + kLookPeriod;
  const double reaction = uniform(random_, parameters_.shortest_reaction, parameters_.longest_reaction);
  const bool pause = pauses(time);
  const Keys keys = decide(driveOn(pose, twistOf(keys_), reaction + kInertia));
  if (state_ != State::kDriving) return;
  decided_ = pause ? Keys{} : keys;
  if (*decided_ == keys_) {
    decided_.reset();
    if (distanceBetween(pose, goal_) < parameters_.arrival_distance && keys_ == Keys{} && !pause) {
      state_ = State::kArrived;
    }
    return;
  }
  change_ = time + reaction;
  next_look_ = change_ + parameters_.shortest_hold;
}

Twist2 ScriptedDriver::command(const Pose2& pose, double time) {
  if (!isFinite(pose) || !std::isfinite(time)) return {};
  if (time < last_look_) {  // the clock was set back
    last_look_ = next_look_ = change_ = pause_end_ = time;
  }
  if (state_ == State::kDriving) {
    if (decided_ && time >= change_) {
      keys_ = *decided_;
      decided_.reset();
    }
    if (!isSafe(pose, keys_)) {
      // Who drives towards something watches out for it: braking takes no time to react.
      keys_ = {};
      decided_.reset();
      next_look_ = time;
    }
    if (time >= next_look_) reconsider(pose, time);
  }
  if (state_ != State::kDriving) {
    keys_ = {};
    decided_.reset();
  }
  return twistOf(keys_);
}

}  // namespace lstm_planner
