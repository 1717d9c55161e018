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

/// Where the footprint fits through the obstacles of a window, and through places that are blocked although nothing was
/// seen there.
///
/// Whether it fits into a cell is decided at the best of its 16 squares, and whether it fits through to a neighbour on
/// the straight line between the best squares of both. Answers are kept until they are outdated. The window is not the
/// object's own: it is handed to each question.
class Clearance {
 public:
  Clearance(const MemoryParameters& parameters, const ShieldParameters& shield, const ObstacleWindow& window);

  /// Nothing is blocked, and everything has changed.
  void forget();

  /// A place is blocked from now on. Of too many the oldest gives way.
  void block(const ObstacleWindow& window, const Point2& place);

  /// Whether places count as passable that seem too narrow by not more than the error of noise and squares.
  void relaxClearance(bool on);

  /// Something has changed in a cell. After questions were asked, startChanges() must be called first.
  void outdate(int cell);
  /// Everything has changed.
  void outdateAll();
  /// Changes follow: what was asked since the last ones is outdated by them, too.
  void startChanges() { outdated_ = -1; }

  int nearCells() const { return near_cells_; }  ///< within which an obstacle matters
  Passage passage(const ObstacleWindow& window, int cell) {
    return static_cast<Passage>(judgement(window, cell) >> 4 & 3);
  }
  /// The place in a cell that is farthest from all obstacles.
  Point2 bestPlace(const ObstacleWindow& window, int cell) {
    return window.centerOf(window.squareOf(cell, judgement(window, cell) & 0xf));
  }
  /// To which of its eight neighbours the footprint can go from a cell, best place to best place: a bit each,
  /// counter-clockwise from the neighbour along x. 0 at the border of the window.
  std::uint8_t exits(const ObstacleWindow& window, int cell);
  /// Whether the straight path is a passage at least that good.
  bool isFree(const ObstacleWindow& window, const Point2& from, const Point2& to, Passage passage) const;

 private:
  static constexpr int kSide = ObstacleWindow::kSide;
  static constexpr std::uint8_t kUnknown = 0xff;
  /// The judgement of a cell far from everything: its best square is one of the four in the middle.
  static constexpr std::uint8_t kNothingNear =
      static_cast<std::uint8_t>(static_cast<int>(Passage::kRoomy) << 4 | (kSide / 2 * kSide + kSide / 2));

  std::uint8_t judgement(const ObstacleWindow& window, int cell) {
    std::uint8_t& judged = judged_[static_cast<std::size_t>(cell)];
    if (judged == kUnknown) {
      judged = judge(window, cell);
    }
    return judged;
  }
  bool isAnythingNear(const ObstacleWindow& window, int cell, int reach) const;
  bool isBlockNear(const ObstacleWindow& window, int cell, int reach) const;
  std::uint8_t judge(const ObstacleWindow& window, int cell);
  std::uint8_t judgeExits(const ObstacleWindow& window, int cell);
  /// The occupied squares within so many cells of a cell, into nearby_.
  void collectNearby(const ObstacleWindow& window, int cell, int reach);
  /// m^2 from the middle of a square to that of the nearest of nearby_, or to a blocked place.
  double squaredClearance(const ObstacleWindow& window, const Square& square) const;
  /// Of the straight line from one square to another, among nearby_.
  bool isLineFree(const ObstacleWindow& window, const Square& from, const Square& to) const;
  bool isGapFree(const ObstacleWindow& window, const Point2& position, double radius) const;

  /// What a path from best place to best place must keep to obstacles in between, m: squares round places by half a
  /// square.
  double onThePath(double radius) const { return radius - 0.5 * resolution_; }

  double resolution_;          ///< m, of the window
  int side_;                   ///< cells, of the window
  double cell_size_;           ///< m, of the window
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
  int outdated_ = -1;  ///< the cell that was outdated last, if nothing was judged since
};

}  // namespace lstm_planner
