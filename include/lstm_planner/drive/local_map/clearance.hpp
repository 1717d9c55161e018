#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/drive/collision/shield_parameters.hpp"
#include "lstm_planner/drive/local_map/memory_parameters.hpp"
#include "lstm_planner/drive/local_map/obstacle_window.hpp"

namespace lstm_planner {

/// How much room there is for the footprint.
enum class Passage : std::uint8_t {
  kBlocked,  ///< it does not fit
  kTight,    ///< it fits
  kNarrow,   ///< it fits with the shield's clearance around it
  kRoomy     ///< it fits with the comfortable clearance around it
};

/// Obstacles in a window, and where the footprint fits through them, and through places that are blocked although
/// nothing was seen there.
///
/// Whether it fits into a cell is decided at the best of its 16 squares, and whether it fits through to a neighbour on
/// the straight line between the best squares of both. Answers are kept until something changes near by.
class Clearance {
 public:
  Clearance(const MemoryParameters& parameters, const ShieldParameters& shield);

  const ObstacleWindow& window() const { return window_; }

  /// Nothing stands anywhere, and nothing is blocked.
  void forget();
  /// As ObstacleWindow.
  bool moveTo(const Pose2& pose);
  void set(const Square& square, bool occupied) { outdate(window_.set(square, occupied)); }

  /// A place is blocked from now on. Of too many the oldest gives way.
  void block(const Point2& place);
  /// Takes back block(), if the place is still blocked.
  void unblock(const Point2& place);
  /// Takes back all of them.
  void unblockAll();

  /// Whether places count as passable that seem too narrow by not more than the error of noise and squares.
  void relaxClearance(bool on);

  int nearCells() const { return near_cells_; }  ///< within which an obstacle matters
  Passage passage(int cell) { return static_cast<Passage>(judgement(cell) >> 4 & 3); }
  /// The place in a cell that is farthest from all obstacles.
  Point2 bestPlace(int cell) { return window_.centerOf(window_.squareOf(cell, judgement(cell) & 0xf)); }
  /// To which of its eight neighbours the footprint can go from a cell, best place to best place: a bit each,
  /// counter-clockwise from the neighbour along x. 0 at the border of the window.
  std::uint8_t exits(int cell);
  /// Whether the straight path is a passage at least that good.
  bool isFree(const Point2& from, const Point2& to, Passage passage) const;

 private:
  static constexpr int kSide = ObstacleWindow::kSide;
  static constexpr std::uint8_t kUnknown = 0xff;
  /// The judgement of a cell far from everything: its best square is one of the four in the middle.
  static constexpr std::uint8_t kNothingNear =
      static_cast<std::uint8_t>(static_cast<int>(Passage::kRoomy) << 4 | (kSide / 2 * kSide + kSide / 2));

  void outdateAt(const Point2& place);
  void outdate(int cell);
  void outdateAll();
  std::uint8_t judgement(int cell) {
    std::uint8_t& judged = judged_[static_cast<std::size_t>(cell)];
    if (judged == kUnknown) {
      judged = judge(cell);
    }
    return judged;
  }
  bool isAnythingNear(int cell, int reach) const;
  bool isBlockNear(int cell, int reach) const;
  std::uint8_t judge(int cell);
  std::uint8_t judgeExits(int cell);
  /// The occupied squares within so many cells of a cell, into nearby_.
  void collectNearby(int cell, int reach);
  /// m^2 from the middle of a square to that of the nearest of nearby_, or to a blocked place.
  double squaredClearance(const Square& square) const;
  /// Of the straight line from one square to another, among nearby_.
  bool isLineFree(const Square& from, const Square& to) const;
  bool isGapFree(const Point2& position, double radius) const;

  /// What a path from best place to best place must keep to obstacles in between, m: squares round places by half a
  /// square.
  double onThePath(double radius) const { return radius - 0.5 * window_.resolution(); }

  ObstacleWindow window_;
  double footprint_radius_;    ///< m
  double tight_clearance_;     ///< m
  double tight_radius_ = 0.0;  ///< m from the middle of the footprint to the middle of an occupied square
  double narrow_radius_;       ///< m
  double roomy_radius_;        ///< m
  int near_cells_;
  std::vector<std::uint8_t> judged_;  ///< exits known (bit 6), passage (2 bits), best square (4 bits)
  std::vector<std::uint8_t> exits_;
  std::vector<Point2> blocks_;
  std::vector<Square> nearby_;
};

}  // namespace lstm_planner
