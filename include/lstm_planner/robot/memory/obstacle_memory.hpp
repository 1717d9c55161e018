#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lstm_planner/base/grid/bit_rows.hpp"
#include "lstm_planner/robot/driving/agent_parameters.hpp"
#include "lstm_planner/robot/memory/line_masks.hpp"
#include "lstm_planner/robot/memory/sight.hpp"
#include "lstm_planner/robot/perception/situation.hpp"

namespace lstm_planner {

/// Remembers where obstacles were seen in a window that moves along with the robot, and forgets those that the scanner
/// sees through later. Bounded: about 0.6 MB with the defaults, however large the world and long the way.
///
/// All positions are in the odometry frame. Obstacles are kept in squares of MemoryParameters::resolution, one bit
/// each; four by four of them are a cell, the unit of the route search. Whether the footprint fits into a cell is
/// decided at the best of its 16 squares, and whether it fits through to a neighbour on the straight line between the
/// best squares of both. What was never seen counts as free.
class ObstacleMemory {
 public:
  enum class Passage : std::uint8_t {
    kBlocked,  ///< the footprint does not fit
    kTight,    ///< it fits
    kNarrow,   ///< it fits with the shield's clearance around it
    kRoomy     ///< it fits with the comfortable clearance around it
  };

  /// A place where something was seen, blocked or forgotten.
  struct Change {
    Point2 place;   ///< odometry frame
    bool occupied;  ///< now
  };

  static constexpr int kSide = 4;                     ///< squares a side of a cell
  static constexpr int kCellSquares = kSide * kSide;  ///< squares of a cell

  /// Throws as validate(AgentParameters) for parameters that do not fit together.
  ObstacleMemory(const MemoryParameters& parameters, const ShieldParameters& shield);

  /// Nothing is known any more.
  void forget();

  /// Takes in what is seen from where the robot is: forgets what the scan looks through, then marks the returns. Does
  /// nothing where the pose is out of reach (isInReach).
  void look(const Situation& situation);

  /// A place that turned out not to be passable although nothing is seen there; until forget(), or until so many others
  /// were blocked.
  void block(const Point2& place);

  /// Whether places count as passable that are narrower by the blur of noise and squares than what the shield lets
  /// through. Seldom right, but where there is no other way it is worth a try.
  void squeeze(bool on);

  /// What has changed since clearChanges(), in order; not all of it when everythingChanged().
  const std::vector<Change>& changes() const { return changes_; }
  /// The window moved, everything was forgotten, squeeze() took effect, or too much changed to be listed.
  bool everythingChanged() const { return everything_changed_; }
  void clearChanges();

  int side() const { return side_; }  ///< cells a side of the window
  double cellSize() const { return cell_size_; }
  int nearCells() const { return near_cells_; }  ///< within which an obstacle matters to what is passable
  /// Index of the cell at a position, row by row; -1 outside the window.
  int cellAt(const Point2& position) const;
  Point2 centerOf(int cell) const;
  Passage passage(int cell) { return static_cast<Passage>(judgement(cell) >> 4 & 3); }
  /// The place in a cell that is farthest from all obstacles.
  Point2 bestPlace(int cell);

  /// To which of its eight neighbours the footprint can go from a cell, best place to best place: a bit each,
  /// counter-clockwise from the neighbour along x. 0 at the border of the window.
  std::uint8_t exits(int cell);

  /// True when the way straight from one place to the other is a passage at least that good; ends outside the window
  /// are never free.
  bool isFree(const Point2& from, const Point2& to, Passage passage);

 private:
  /// A square by its place in the window; or in the odometry frame, where that is said.
  struct Square {
    int column;
    int row;
  };
  static constexpr std::uint8_t kUnknown = 0xff;
  /// The judgement of a cell far from everything: its best square is one of the four in the middle.
  static constexpr std::uint8_t kNothingNear =
      static_cast<std::uint8_t>(static_cast<int>(Passage::kRoomy) << 4 | (kSide / 2 * kSide + kSide / 2));

  // obstacle_memory.cpp: what is remembered.
  /// In the odometry frame.
  Square squareAt(const Point2& position) const;
  Square squareOf(int cell, int square) const {
    return {cell % side_ * kSide + square % kSide, cell / side_ * kSide + square / kSide};
  }
  Point2 centerOf(const Square& square) const {
    return {(origin_column_ * kSide + square.column + 0.5) * parameters_.resolution,
            (origin_row_ * kSide + square.row + 0.5) * parameters_.resolution};
  }
  int cellOf(const Square& square) const { return square.row / kSide * side_ + square.column / kSide; }
  void moveWindow(const Pose2& pose);
  void forgetUnderneath(const Pose2& pose);
  void set(const Square& square, bool occupied);
  void noteChange(const Point2& place, bool occupied);
  void outdate(int cell);
  void outdateAll();

  // obstacle_memory_look.cpp: what a scan adds and takes away.
  void collectReturns(const Situation& situation);
  bool isReturned(std::uint32_t key);
  void forgetSeenThrough(const Situation& situation);
  /// `cells`: keyOf() their first squares; overwritten.
  void lookThroughCells(const SquareGrid& grid, std::uint32_t* cells, std::size_t count);
  void markReturns();
  static std::uint32_t keyOf(const Square& square) {
    return static_cast<std::uint32_t>(square.row) << 16 | static_cast<std::uint32_t>(square.column);
  }
  static Square squareOf(std::uint32_t key) { return {static_cast<int>(key & 0xffff), static_cast<int>(key >> 16)}; }

  // obstacle_memory_passages.cpp: what is passable.
  std::uint8_t judgement(int cell) {
    std::uint8_t& judged = judged_[static_cast<std::size_t>(cell)];
    if (judged == kUnknown) {
      judged = judge(cell);
    }
    return judged;
  }
  bool isAnythingNear(int cell, int reach) const;
  std::uint8_t judge(int cell) const;
  /// `squared`: m^2 from the middle of the best square to the nearest obstacle.
  std::uint8_t judgementOf(double squared, int best_square) const;
  std::uint8_t judgeExits(int cell);
  int bestSquare(int cell, int* squared) const;
  bool isLineFree(const Square& from, const Square& to) const;
  bool isGapFree(const Point2& position, double radius) const;
  bool isBlockNear(int cell, int reach) const;

  // obstacle_memory_blocks.cpp: the same obstacle by obstacle.
  void collectNearby(int cell, int reach) const;
  std::uint8_t judgeAmongBlocks(int cell) const;
  std::uint8_t judgeExitsAmongBlocks(int cell);
  void setTightRadius(double radius);
  /// The squares round: a way from best place to best place may come this much nearer to an obstacle in between.
  double onTheWay(double radius) const { return radius - 0.5 * parameters_.resolution; }

  MemoryParameters parameters_;
  int side_;
  double cell_size_;        ///< m
  double footprint_radius_; ///< m
  double tight_clearance_;  ///< m
  double tight_radius_ = 0.0;  ///< m from the middle of the footprint to the middle of an occupied square
  double narrow_radius_;    ///< m
  double roomy_radius_;     ///< m
  int near_cells_;          ///< cells within which an obstacle matters
  int origin_column_ = 0;   ///< of the window, in cells of the odometry frame
  int origin_row_ = 0;
  bool placed_ = false;
  BitRows squares_;                   ///< that are occupied
  BitRows cells_;                     ///< with an occupied square
  std::vector<std::uint8_t> judged_;  ///< exits known (bit 6), passage (2 bits), best square (4 bits)
  std::vector<std::uint8_t> exits_;
  LineMasks line_masks_;  ///< squares beside the way from one best place to another that must be free
  std::vector<Point2> blocks_;
  std::vector<Change> changes_;
  bool everything_changed_ = true;
  int outdated_ = -1;  ///< the cell that was outdated last, if nothing was judged since

  Sight sight_;
  std::vector<std::uint32_t> returns_;       ///< keyOf() squares in the order of the scan, and room for more
  std::size_t returns_count_ = 0;
  std::vector<std::uint32_t> places_;        ///< what returns_ are made from
  std::array<std::uint64_t, 64> returned_;   ///< row and column, modulo 64, of the returns
  bool returned_is_known_ = false;
  std::vector<std::uint32_t> seen_through_;  ///< keyOf() squares
  mutable std::vector<Point2> nearby_;       ///< of collectNearby()
};

}  // namespace lstm_planner
