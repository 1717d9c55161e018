#include "lstm_planner/drive/motion/elastic_band.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

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

/// The chain that is bent, and what lies behind it.
class ElasticBand {
 public:
  /// `distance`: m from the middle of the footprint to obstacles that is wanted.
  ElasticBand(const LocalMap& memory, double distance, const Point2& robot, const Decision& decision)
      : memory_(memory), distance_(distance), chain_{robot} {
    addPiece(decision.waypoint);
    if (isOneStep(decision)) first_ = chain_.size();
    for (const Point2& corner : decision.path_on) addPiece(corner);
  }

  std::optional<Decision> bend(Decision decision) {
    if (chain_.size() < 3) return std::nullopt;
    for (int round = 0; round < kRounds && relax() > kStill; ++round) {
    }
    if (!isPassable()) return std::nullopt;
    decision.waypoint = chain_[1];
    decision.path_on.assign(chain_.begin() + 2, chain_.end());
    decision.path_on.insert(decision.path_on.end(), rest_.begin(), rest_.end());
    return decision;
  }

 private:
  void addPiece(const Point2& corner) {
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
  double relax() {
    double farthest = 0.0;
    for (std::size_t i = first_; i + 1 < chain_.size(); ++i) {
      const Point2 middle{0.5 * (chain_[i - 1].x + chain_[i + 1].x), 0.5 * (chain_[i - 1].y + chain_[i + 1].y)};
      const Point2 pushed = push(i);
      const Point2 move{kDraw * (middle.x - chain_[i].x) + pushed.x, kDraw * (middle.y - chain_[i].y) + pushed.y};
      chain_[i] = {chain_[i].x + move.x, chain_[i].y + move.y};
      farthest = std::max(farthest, std::hypot(move.x, move.y));
    }
    return farthest;
  }

  /// Aside, away from what is nearest on each side: between two obstacles that are as near nothing moves.
  Point2 push(std::size_t i) const {
    const Point2 here = chain_[i];
    const double along = directionTo(chain_[i - 1], chain_[i + 1]);
    const Point2 left{-std::sin(along), std::cos(along)};
    double nearest_left = distance_ * distance_;  // squared
    double nearest_right = nearest_left;
    memory_.visitObstaclesNear(here, distance_, [&](const Point2& obstacle) {
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
  bool isPassable() const {
    const auto isFree = [&](std::size_t i) {
      return memory_.isFree(chain_[i - 1], chain_[i], LocalMap::Passage::kTight);
    };
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

  const LocalMap& memory_;
  double distance_;            ///< m
  double left_ = kBent;        ///< m of the path for which there is no chain yet
  std::size_t first_ = 1;      ///< point of the chain that may move
  std::vector<Point2> chain_;  ///< from the robot on
  std::vector<Point2> rest_;   ///< corners of the path behind the chain
};

}  // namespace

std::optional<Decision> bentAway(const NavigationAgent& agent, const Pose2& robot, const Decision& decision,
                                 double clearance) {
  const bool is_known = decision.on_route || decision.choice == Decision::Move::kGoalInSight ||
                        (isOneStep(decision) && !decision.path_on.empty());
  const LocalMap* memory = agent.memory();
  if (clearance <= 0.0 || memory == nullptr || !is_known) return std::nullopt;
  const double distance = agent.parameters().shield.footprint_radius + clearance;
  return ElasticBand(*memory, distance, {robot.x, robot.y}, decision).bend(decision);
}

}  // namespace lstm_planner
