#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "lstm_planner/drive/collision/shield_parameters.hpp"
#include "lstm_planner/drive/local_map/clearance.hpp"
#include "lstm_planner/drive/local_map/memory_parameters.hpp"
#include "lstm_planner/drive/local_map/obstacle_window.hpp"
#include "lstm_planner/drive/local_map/scan_changes.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// Remembers obstacles in a window that moves with the robot (ObstacleWindow), forgets an obstacle if the scanner later
/// shows its place clear (ScanChanges), and knows where the footprint fits through (Clearance). Its memory is
/// bounded: about 0.9 MB with the defaults, for any size of the world and length of the path.
///
/// All positions are in the odometry frame. Obstacles are kept in squares of MemoryParameters::resolution; a cell of
/// four by four of them is the unit of the route search. What was never seen counts as free.
class LocalMap {
 public:
  using Passage = lstm_planner::Passage;

  static constexpr int kSide = ObstacleWindow::kSide;                ///< squares a side of a cell
  static constexpr int kCellSquares = ObstacleWindow::kCellSquares;  ///< squares of a cell

  /// Of AgentParameters that validate() accepts. Throws as footprintOf().
  LocalMap(const MemoryParameters& parameters, const ShieldParameters& shield);

  /// Nothing is known any more.
  void forget();

  /// Takes in what is seen from where the robot is: forgets what the scan shows clear, then marks the returns. Does
  /// nothing where the pose is out of reach (isInReach).
  ///
  /// Obstacles of a costmap (Situation::marked) are added, also where the scan shows them clear, and removed when a
  /// situation does not have them any more; but not in or beside squares where the scan has shown an obstacle.
  void add(const Situation& situation);

  /// Obstacles that are known beforehand (odometry frame): from the next add() on they are remembered as if they had
  /// been seen, also where the window comes later and after forget(). They take the place of those that were known
  /// before.
  void know(std::vector<Point2> obstacles) { known_ = std::move(obstacles); }

  /// Marks a place as not passable although no obstacle was seen there; until unblockAll() or forget(), or until many
  /// other places were marked.
  void block(const Point2& place) { clearance_.block(place); }
  /// Takes back block(), if the place is still marked.
  void unblock(const Point2& place) { clearance_.unblock(place); }
  void unblockAll() { clearance_.unblockAll(); }

  /// Whether places count as passable that seem too narrow by not more than the error of noise and squares. This is
  /// seldom true, but worth a try if there is no other path.
  void relaxClearance(bool on) { clearance_.relaxClearance(on); }

  /// Where obstacles are remembered: the middles of the occupied squares.
  std::vector<Point2> obstacles() const { return window().occupied(); }

  int side() const { return window().side(); }  ///< cells a side of the window
  double cellSize() const { return window().cellSize(); }
  int nearCells() const { return clearance_.nearCells(); }  ///< within which an obstacle matters to what is passable
  /// Index of the cell at a position, row by row; -1 outside the window.
  int cellAt(const Point2& position) const { return window().cellAt(position); }
  Point2 centerOf(int cell) const { return window().centerOf(cell); }
  bool isAtBorder(int cell) const { return window().isAtBorder(cell); }
  Passage passage(int cell) { return clearance_.passage(cell); }
  /// The place in a cell that is farthest from all obstacles.
  Point2 bestPlace(int cell) { return clearance_.bestPlace(cell); }

  /// To which of its eight neighbours the footprint can go from a cell, best place to best place: a bit each,
  /// counter-clockwise from the neighbour along x. 0 at the border of the window.
  std::uint8_t exits(int cell) { return clearance_.exits(cell); }

  /// Visits the middles of the occupied squares that are at most `reach` (m) from a place along each axis.
  template <typename Visit>
  void visitObstaclesNear(const Point2& place, double reach, const Visit& visit) const {
    window().visitOccupiedNear(place, reach, visit);
  }

  /// True when the straight path from one place to the other is a passage at least that good; ends outside the window
  /// are never free.
  bool isFree(const Point2& from, const Point2& to, Passage passage) const {
    return clearance_.isFree(from, to, passage);
  }

 private:
  /// A square of the odometry frame in one number.
  using Mark = std::uint64_t;

  const ObstacleWindow& window() const { return clearance_.window(); }
  void markKnown();
  void takeOverMarks(const Situation& situation);
  void collectMarks(const Situation& situation);
  bool isSeenBeside(const Square& square) const;
  bool isMarked(const Square& square) const;
  Mark markAt(const Square& square) const;
  Square squareOfMark(Mark mark) const;
  void forgetUnderneath(const Pose2& pose);

  double footprint_radius_;  ///< m, inscribed
  Clearance clearance_;
  ScanChanges scan_changes_;
  double reach_;               ///< m, of what is remembered
  std::vector<Point2> known_;  ///< beforehand
  std::vector<Mark> marks_;    ///< of a costmap, sorted
  std::vector<Mark> marked_;   ///< of the current situation
};

}  // namespace lstm_planner
