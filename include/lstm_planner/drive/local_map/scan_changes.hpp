#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/drive/local_map/obstacle_window.hpp"
#include "lstm_planner/drive/local_map/scan_clearing.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// What a scan adds to a window of obstacles (the squares of its returns), and what it removes (the occupied squares
/// that it shows clear). It does not change the window itself.
class ScanChanges {
 public:
  /// `reach`: m; returns farther away count for nothing.
  explicit ScanChanges(double reach);

  /// Compares what is seen with what stands in the window; the answers hold until the next call.
  void find(const Situation& situation, const ObstacleWindow& window);

  /// keyOf() the occupied squares that the scan shows clear and that it has no return from.
  const std::vector<std::uint32_t>& cleared() const { return cleared_; }
  /// keyOf() the squares of the returns, in the order of the scan; once where several follow one another in a square.
  const std::vector<std::uint32_t>& returns() const { return returns_; }

 private:
  void findReturns(const Situation& situation, const ObstacleWindow& window);
  /// Adds what a scan shows clear; `pose` of the base.
  void findCleared(const RangeProfile& profile, const Pose2& pose, const ObstacleWindow& window);
  void findClearedInCell(const Square& first, const Point2& scanner, const ObstacleWindow& window);

  double reach_;
  ScanClearing scan_clearing_;
  std::vector<std::uint32_t> returns_;
  std::vector<std::uint32_t> cleared_;
};

}  // namespace lstm_planner
