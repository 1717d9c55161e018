#include "lstm_planner/drive/local_map/scan_changes.hpp"

#include <algorithm>
#include <cmath>

#include "drive/local_map/bounded_rounding.hpp"

namespace lstm_planner {

namespace {

constexpr int kSide = ObstacleWindow::kSide;

constexpr std::size_t kUsualChanges = 1024;  ///< for which there is room from the first

}  // namespace

ScanChanges::ScanChanges(double reach) : reach_(reach) { cleared_.reserve(kUsualChanges); }

void ScanChanges::find(const Situation& situation, const ObstacleWindow& window) {
  findReturns(situation, window);
  cleared_.clear();
  findCleared(situation.profile, situation.pose, window);
  findCleared(situation.second.profile, situation.pose, window);
}

void ScanChanges::findReturns(const Situation& situation, const ObstacleWindow& window) {
  const Pose2& pose = situation.pose;
  const double scale = 1.0 / window.resolution();
  // Squares are counted from one so far to the left of and below the robot that no return has a negative number.
  const int bias = static_cast<int>(std::ceil(reach_ * scale)) + 1;
  const Square here = window.squareAt({pose.x, pose.y});
  const Square origin = window.origin();
  const auto cosine = static_cast<float>(std::cos(pose.yaw) * scale);
  const auto sine = static_cast<float>(std::sin(pose.yaw) * scale);
  const auto base_x = static_cast<float>(pose.x * scale - (here.column + origin.column) + bias);
  const auto base_y = static_cast<float>(pose.y * scale - (here.row + origin.row) + bias);
  const int first_column = here.column - bias;
  const int first_row = here.row - bias;
  const auto farthest = static_cast<float>(reach_ * reach_);
  returns_.clear();
  returns_.reserve(std::max(situation.obstacles.size(), situation.profile.ranges.size()));
  for (const Point2& place : situation.obstacles) {
    const auto x = static_cast<float>(place.x);
    const auto y = static_cast<float>(place.y);
    if (!(x * x + y * y <= farthest)) continue;
    const Square square{static_cast<int>(cosine * x - sine * y + base_x) + first_column,
                        static_cast<int>(sine * x + cosine * y + base_y) + first_row};
    if (!window.contains(square)) continue;
    const std::uint32_t key = keyOf(square);
    if (returns_.empty() || returns_.back() != key) returns_.push_back(key);
  }
}

void ScanChanges::findCleared(const RangeProfile& profile, const Pose2& pose, const ObstacleWindow& window) {
  scan_clearing_.show(profile, pose.yaw);
  if (scan_clearing_.isBlind()) {
    return;
  }
  const Point2 scanner = toParentFrame(pose, profile.origin);
  const int reach = static_cast<int>(reach_ / window.cellSize());
  const int middle_column = floorOf(scanner.x / window.cellSize()) - window.origin().column / kSide;
  const int middle_row = floorOf(scanner.y / window.cellSize()) - window.origin().row / kSide;
  const int last = window.side() - 1;
  for (int row = std::max(0, middle_row - reach); row <= std::min(last, middle_row + reach); ++row) {
    for (int column = std::max(0, middle_column - reach); column <= std::min(last, middle_column + reach); ++column) {
      if (window.cells().test(column, row)) findClearedInCell({column * kSide, row * kSide}, scanner, window);
    }
  }
}

void ScanChanges::findClearedInCell(const Square& first, const Point2& scanner, const ObstacleWindow& window) {
  const Point2 corner = window.centerOf(Square{0, 0});
  const auto left = static_cast<float>(corner.x - scanner.x);
  const auto bottom = static_cast<float>(corner.y - scanner.y);
  const auto resolution = static_cast<float>(window.resolution());
  for (int row = first.row; row < first.row + kSide; ++row) {
    for (int column = first.column; column < first.column + kSide; ++column) {
      const Square square{column, row};
      if (!window.isOccupied(square)) continue;
      const float x = static_cast<float>(column) * resolution + left;
      const float y = static_cast<float>(row) * resolution + bottom;
      if (!scan_clearing_.isClear(x, y)) continue;
      const std::uint32_t key = keyOf(square);
      if (std::find(returns_.begin(), returns_.end(), key) == returns_.end()) cleared_.push_back(key);
    }
  }
}

}  // namespace lstm_planner
