#include "lstm_planner/drive/motion/elastic_band.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {

namespace {

constexpr double kBent = 5.0;  ///< m of the path; local planners look at less
constexpr double kLink = 0.1;  ///< m between the points of the chain at most
/// m from the robot within which obstacles push less, such that the path leaves it in an arc: it cannot move sideways.
constexpr double kGentle = 0.5;
constexpr double kDraw = 0.5;    ///< share of the distance to the middle between the neighbours, a round
constexpr double kPush = 0.06;   ///< m that an obstacle at no distance pushes, a round
constexpr int kRounds = 40;      ///< at most: a point moves by half a metre in so many
constexpr double kStill = 1e-3;  ///< m; a round that moves no point farther is the last one

}  // namespace

const Decision& ElasticBand::bend(const NavigationAgent& agent, const Pose2& robot, const Decision& decision,
                                  double clearance) {
  using Move = Decision::Move;
  const bool is_known =
      decision.on_route || decision.choice == Move::kGoalInSight || (isOneStep(decision) && !decision.path_on.empty());
  const LocalMap* memory = agent.memory();
  if (clearance <= 0.0 || memory == nullptr || !is_known) return decision;
  distance_ = agent.parameters().shield.footprint_radius + clearance;
  layChain({robot.x, robot.y}, decision);
  if (chain_.size() < 3) return decision;
  for (int round = 0; round < kRounds && relax(*memory) > kStill; ++round) {
  }
  if (!isPassable(*memory)) return decision;
  bent_ = decision;
  bent_.waypoint = chain_[1];
  bent_.path_on.assign(chain_.begin() + 2, chain_.end());
  bent_.path_on.insert(bent_.path_on.end(), rest_.begin(), rest_.end());
  return bent_;
}

void ElasticBand::layChain(const Point2& robot, const Decision& decision) {
  chain_.assign(1, robot);
  rest_.clear();
  left_ = kBent;
  addPiece(decision.waypoint);
  first_ = isOneStep(decision) ? chain_.size() : 1;
  for (const Point2& corner : decision.path_on) addPiece(corner);
}

void ElasticBand::addPiece(const Point2& corner) {
  const Point2 start = chain_.back();
  const double length = distanceBetween(start, corner);
  const double bent = std::min(length, left_);
  const int links = static_cast<int>(std::ceil(bent / kLink));
  for (int link = 1; link <= links; ++link) {
    const double share = bent / length * link / links;
    chain_.push_back({start.x + share * (corner.x - start.x), start.y + share * (corner.y - start.y)});
  }
  left_ -= bent;
  if (bent < length) rest_.push_back(corner);
}

/// How far it moved a point at most, m.
double ElasticBand::relax(const LocalMap& memory) {
  double farthest = 0.0;
  for (std::size_t i = first_; i + 1 < chain_.size(); ++i) {
    const Point2 middle{0.5 * (chain_[i - 1].x + chain_[i + 1].x), 0.5 * (chain_[i - 1].y + chain_[i + 1].y)};
    const Point2 pushed = push(memory, i);
    const Point2 move{kDraw * (middle.x - chain_[i].x) + pushed.x, kDraw * (middle.y - chain_[i].y) + pushed.y};
    chain_[i] = {chain_[i].x + move.x, chain_[i].y + move.y};
    farthest = std::max(farthest, std::hypot(move.x, move.y));
  }
  return farthest;
}

/// Aside, away from what is nearest on each side: between two obstacles that are as near nothing moves.
Point2 ElasticBand::push(const LocalMap& memory, std::size_t i) const {
  const Point2 here = chain_[i];
  const double along = directionTo(chain_[i - 1], chain_[i + 1]);
  const Point2 left{-std::sin(along), std::cos(along)};
  double nearest_left = distance_ * distance_;  // squared
  double nearest_right = nearest_left;
  memory.visitObstaclesNear(here, distance_, [&](const Point2& obstacle) {
    const double x = obstacle.x - here.x;
    const double y = obstacle.y - here.y;
    double& nearest = x * left.x + y * left.y > 0.0 ? nearest_left : nearest_right;
    nearest = std::min(nearest, x * x + y * y);
  });
  const double gentle = std::min(1.0, static_cast<double>(i) * kLink / kGentle);
  const double to_left = gentle * kPush * (std::sqrt(nearest_left) - std::sqrt(nearest_right)) / distance_;
  return {to_left * left.x, to_left * left.y};
}

/// But where the robot stands, and where the path ends: there may be less room than a path needs.
bool ElasticBand::isPassable(const LocalMap& memory) const {
  const auto isFree = [&](std::size_t i) { return memory.isFree(chain_[i - 1], chain_[i], LocalMap::Passage::kTight); };
  const auto isAtAnEnd = [&](std::size_t i) {
    return distanceBetween(chain_.front(), chain_[i]) < distance_ ||
           distanceBetween(chain_[i - 1], chain_.back()) < distance_;
  };
  std::size_t first = 1;
  while (first < chain_.size() && isAtAnEnd(first) && !isFree(first)) ++first;
  std::size_t end = chain_.size();
  while (end > first && isAtAnEnd(end - 1) && !isFree(end - 1)) --end;
  for (std::size_t i = first; i < end; ++i) {
    if (!isFree(i)) return false;
  }
  return true;
}

}  // namespace lstm_planner
