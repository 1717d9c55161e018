#include "drive/motion/way_out.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <unordered_set>
#include <utility>

#include "drive/motion/motion_parts.hpp"
#include "lstm_planner/common/arc.hpp"

namespace lstm_planner {

namespace {

/// A piece of the way: an arc, or a turn where its length is 0.
struct WayPiece {
  double length;
  double turn;
};

/// A pose that can be reached, and from which one.
struct WayNode {
  Pose2 pose;
  WayPiece from_parent;
  int parent;
};

/// One search, see findWayOut().
class WaySearch {
 public:
  WaySearch(const Shield& shield, double margin, const std::vector<Pose2>& was, const std::vector<Pose2>& plan)
      : shield_(shield), margin_(margin), was_(was), plan_(plan) {}

  std::vector<Pose2> run() {
    add({}, {}, -1, 0.0);
    retrace();
    while (!open_.empty()) {
      const auto [cost, index] = open_.top();
      open_.pop();
      const WayNode node = nodes_[static_cast<std::size_t>(index)];
      if (!settled_.insert(keyOf(node.pose)).second) continue;
      if (settled_.size() > kMostPoses) break;
      if (const double turn = turnToPlan(node.pose); isOut(node.pose, turn)) return poses(index, turn);
      expand(node.pose, index, cost);
    }
    return {};
  }

 private:
  static constexpr double kPlace = 0.04;                     ///< m; two poses as near as this are one
  static constexpr double kHeading = 0.1;                    ///< rad, likewise
  static constexpr double kPiece = 0.08;                     ///< m that are driven at a time
  static constexpr double kTurn = 0.2;                       ///< rad that are turned at a time
  static constexpr double kCurvatures[] = {0.0, 2.5, -2.5};  ///< 1/m
  static constexpr double kTurnCosts = 0.4;                  ///< m, of a radian
  static constexpr double kBackCosts = 1.5;                  ///< m, of a metre backwards
  static constexpr double kFarthest = 2.0;                   ///< m
  static constexpr std::size_t kMostPoses = 6000;            ///< that are looked at
  static constexpr double kAhead = 0.3;                      ///< m that must be free ahead in the end
  static constexpr double kAheadOnPlan = 0.4;                ///< m to the point that it heads for
  static constexpr double kWasThere = 0.05;                  ///< m from where it was
  static constexpr double kWasHeaded = 0.15;                 ///< rad, likewise
  static constexpr double kSpacing = 0.02;                   ///< m between the poses of the answer
  static constexpr double kTurnSpacing = 0.05;               ///< rad, likewise
  static constexpr double kWhereItWas = 0.75;  ///< share of the margin that is kept on the way that it came
  static constexpr double kShortest = 2e-3;    ///< m; what is shorter is a turn
  static constexpr double kSlack = 1e-3;       ///< m or rad

  using Open = std::pair<double, int>;  ///< cost, node

  static std::uint64_t keyOf(const Pose2& pose) {
    const auto part = [](double value) { return static_cast<std::uint64_t>(std::lround(value) + 0x8000) & 0xffff; };
    return part(pose.x / kPlace) << 32 | part(pose.y / kPlace) << 16 | part(normalizeAngle(pose.yaw) / kHeading);
  }

  void reach(const Pose2& pose, const WayPiece& piece, int parent, double cost) {
    if (std::hypot(pose.x, pose.y) <= kFarthest && settled_.count(keyOf(pose)) == 0) add(pose, piece, parent, cost);
  }

  void add(const Pose2& pose, const WayPiece& piece, int parent, double cost) {
    open_.push({cost, static_cast<int>(nodes_.size())});
    nodes_.push_back({pose, piece, parent});
  }

  /// The way that the robot came, exactly as it came.
  void retrace() {
    double cost = 0.0;
    for (auto place = was_.rbegin(); place != was_.rend(); ++place) {
      const Pose2 from = nodes_.back().pose;
      const Pose2 step = compose(inverse(from), *place);
      const WayPiece piece{std::copysign(std::hypot(step.x, step.y), step.x), normalizeAngle(step.yaw)};
      if (std::hypot(place->x, place->y) > kFarthest || !isFree(from, piece, kWhereItWas * margin_)) return;
      cost += kBackCosts * std::abs(piece.length) + kTurnCosts * std::abs(piece.turn);
      add(*place, piece, static_cast<int>(nodes_.size()) - 1, cost);
    }
  }

  bool isFree(const Pose2& from, const WayPiece& piece, double margin) const {
    const auto& [length, turn] = piece;
    if (std::abs(length) < kShortest) return shield_.freeTurn(from, turn, margin) >= std::abs(turn) - kSlack;
    return shield_.freeArc(from, turn / length, length, margin) >= std::abs(length) - kSlack;
  }

  void expand(const Pose2& pose, int index, double cost) {
    for (const double turn : {kTurn, -kTurn}) go(pose, {0.0, turn}, index, cost + kTurnCosts * kTurn);
    for (const double curvature : kCurvatures) {
      const double turn = curvature * kPiece;
      const double bend = kTurnCosts * std::abs(turn);
      go(pose, {kPiece, turn}, index, cost + kPiece + bend);
      if (wasAt(alongTurn(pose, -kPiece, -turn))) go(pose, {-kPiece, -turn}, index, cost + kBackCosts * kPiece + bend);
    }
  }

  void go(const Pose2& pose, const WayPiece& piece, int index, double cost) {
    if (isFree(pose, piece, margin_)) reach(alongTurn(pose, piece.length, piece.turn), piece, index, cost);
  }

  bool wasAt(const Pose2& pose) const {
    return std::any_of(was_.begin(), was_.end(), [&](const Pose2& place) {
      return distanceBetween(place, pose) <= kWasThere && turnBetween(place, pose) <= kWasHeaded;
    });
  }

  /// rad, from a pose's heading to where the plan leads from about there.
  double turnToPlan(const Pose2& pose) const {
    const auto nearest = std::min_element(plan_.begin(), plan_.end(), [&](const Pose2& a, const Pose2& b) {
      return distanceBetween(a, pose) < distanceBetween(b, pose);
    });
    return normalizeAngle(directionTo(pose, firstBeyond(nearest + 1, plan_, pose, kAheadOnPlan)) - pose.yaw);
  }

  /// Whether it can turn by that much, to the plan, and drive on.
  bool isOut(const Pose2& pose, double turn) const {
    return isFree(pose, {0.0, turn}, margin_) && isFree({pose.x, pose.y, pose.yaw + turn}, {kAhead, 0.0}, margin_);
  }

  std::vector<Pose2> poses(int index, double last_turn) const {
    std::vector<Pose2> poses;
    const Pose2& end = nodes_[static_cast<std::size_t>(index)].pose;
    addBackwards({{end.x, end.y, end.yaw + last_turn}, {0.0, last_turn}, index}, &poses);
    for (int i = index; i > 0; i = nodes_[static_cast<std::size_t>(i)].parent) {
      addBackwards(nodes_[static_cast<std::size_t>(i)], &poses);
    }
    poses.emplace_back();
    std::reverse(poses.begin(), poses.end());
    return poses;
  }

  /// The pose of a node, and those on the way to it.
  void addBackwards(const WayNode& node, std::vector<Pose2>* poses) const {
    poses->push_back(node.pose);
    const auto& [length, turn] = node.from_parent;
    const double pieces = std::ceil(std::max(std::abs(length) / kSpacing, std::abs(turn) / kTurnSpacing));
    const Pose2& from = nodes_[static_cast<std::size_t>(node.parent)].pose;
    for (double i = pieces - 1.0; i > 0.5; --i) {
      poses->push_back(alongTurn(from, length * i / pieces, turn * i / pieces));
    }
  }

  const Shield& shield_;
  double margin_;
  const std::vector<Pose2>& was_;
  const std::vector<Pose2>& plan_;
  std::vector<WayNode> nodes_;
  std::unordered_set<std::uint64_t> settled_;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
};

}  // namespace

std::vector<Pose2> findWayOut(const Shield& shield, double margin, const std::vector<Pose2>& was,
                              const std::vector<Pose2>& plan) {
  return plan.empty() ? std::vector<Pose2>() : WaySearch(shield, margin, was, plan).run();
}

}  // namespace lstm_planner
