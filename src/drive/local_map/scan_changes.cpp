#include "lstm_planner/drive/local_map/scan_changes.hpp"

#include <algorithm>
#include <cmath>

#include "drive/local_map/bounded_rounding.hpp"
#include "drive/local_map/return_squares.hpp"

namespace lstm_planner {

namespace {

constexpr int kSide = ObstacleWindow::kSide;
constexpr std::uint32_t kTile = 64;  ///< squares a side of the tile that returned_ covers

constexpr std::size_t kUsualChanges = 1024;  ///< for which there is room from the first

/// From the middle of a cell to the middle of its corner squares, in squares.
const double kCorner = std::hypot(1.5, 1.5);

}  // namespace

/// Where the middles of squares lie from the scanner.
struct ScanChanges::SquareGrid {
  float left;  ///< m, of the first column
  float bottom;
  float resolution;  ///< m

  float xOf(int column) const { return static_cast<float>(column) * resolution + left; }
  float yOf(int row) const { return static_cast<float>(row) * resolution + bottom; }
};

/// Squares, or cells, that are looked at together.
struct ScanChanges::Batch {
  float x[ScanClearing::kMost] = {};  ///< m from the scanner
  float y[ScanClearing::kMost] = {};
  Square square[ScanClearing::kMost];  ///< or the first one of the cell
  std::size_t count = 0;

  bool hasRoomFor(std::size_t more) const { return count + more <= ScanClearing::kMost; }
  void add(float at_x, float at_y, const Square& what) {
    x[count] = at_x;
    y[count] = at_y;
    square[count++] = what;
  }
};

ScanChanges::ScanChanges(double reach, double resolution) : reach_(reach), scan_clearing_(kCorner * resolution) {
  cleared_.reserve(kUsualChanges);
}

void ScanChanges::find(const Situation& situation, const ObstacleWindow& window) {
  findReturns(situation, window);
  cleared_.clear();
  findCleared(situation.profile, situation.pose, window);
  for (const SecondView& view : situation.second) findCleared(view.profile, situation.pose, window);
}

void ScanChanges::findReturns(const Situation& situation, const ObstacleWindow& window) {
  const Pose2& pose = situation.pose;
  const double scale = 1.0 / window.resolution();
  // Squares are counted from one so far to the left of and below the robot that no return has a negative number.
  const int bias = static_cast<int>(std::ceil(reach_ * scale)) + 1;
  const Square here = window.squareAt({pose.x, pose.y});
  SquareFrame frame;
  frame.cosine = static_cast<float>(std::cos(pose.yaw) * scale);
  frame.sine = static_cast<float>(std::sin(pose.yaw) * scale);
  frame.x = static_cast<float>(pose.x * scale - here.column + bias);
  frame.y = static_cast<float>(pose.y * scale - here.row + bias);
  frame.first_column = here.column - bias - kSide * window.originColumn();
  frame.first_row = here.row - bias - kSide * window.originRow();
  frame.sides = window.squares().columns();
  frame.farthest = static_cast<float>(reach_ * reach_);

  returns_.reserve(std::max(situation.obstacles.size(), situation.profile.ranges.size()));
  findSquares(frame, situation.obstacles, &returns_);
  returned_is_known_ = false;
}

void ScanChanges::findCleared(const RangeProfile& profile, const Pose2& pose, const ObstacleWindow& window) {
  scan_clearing_.show(profile, pose.yaw);
  if (scan_clearing_.isBlind()) {
    return;
  }
  const Point2 scanner = toParentFrame(pose, profile.origin);
  const int reach = static_cast<int>(reach_ / window.cellSize());
  const int middle_column = floorOf(scanner.x / window.cellSize()) - window.originColumn();
  const int middle_row = floorOf(scanner.y / window.cellSize()) - window.originRow();
  const Point2 corner = window.centerOf(Square{0, 0});
  const SquareGrid grid{static_cast<float>(corner.x - scanner.x), static_cast<float>(corner.y - scanner.y),
                        static_cast<float>(window.resolution())};

  const float to_middle = 0.5f * (kSide - 1) * grid.resolution;
  Batch cells;
  const int last = window.side() - 1;
  const int first_column = std::max(0, middle_column - reach);
  const int last_column = std::min(last, middle_column + reach);
  for (int row = std::max(0, middle_row - reach); row <= std::min(last, middle_row + reach); ++row) {
    for (int column = first_column; column <= last_column; column += 64) {
      if (!cells.hasRoomFor(64)) findInCells(window.squares(), grid, &cells);
      std::uint64_t bits = window.cells().from(column, row) & lowestBits(std::min(64, last_column + 1 - column));
      for (; bits != 0; bits &= bits - 1) {
        const Square first{(column + lowestBit(bits)) * kSide, row * kSide};
        cells.add(grid.xOf(first.column) + to_middle, grid.yOf(first.row) + to_middle, first);
      }
    }
  }
  findInCells(window.squares(), grid, &cells);
}

void ScanChanges::findInCells(const BitRows& squares, const SquareGrid& grid, Batch* cells) {
  float limits[ScanClearing::kMost];
  scan_clearing_.findLimits(cells->x, cells->y, cells->count, limits);
  Batch occupied;
  for (std::size_t i = 0; i < cells->count; ++i) {
    if (!(limits[i] > 0.0f)) continue;
    if (!occupied.hasRoomFor(ObstacleWindow::kCellSquares)) findInSquares(&occupied);
    const Square& first = cells->square[i];
    for (int row = first.row; row < first.row + kSide; ++row) {
      const float y = grid.yOf(row);
      std::uint64_t bits = squares.from(first.column, row) & lowestBits(kSide);
      for (; bits != 0; bits &= bits - 1) {
        const int column = first.column + lowestBit(bits);
        const float x = grid.xOf(column);
        if (x * x + y * y < limits[i]) occupied.add(x, y, {column, row});
      }
    }
  }
  findInSquares(&occupied);
  cells->count = 0;
}

void ScanChanges::findInSquares(Batch* occupied) {
  std::uint8_t clear[ScanClearing::kMost];
  scan_clearing_.findClear(occupied->x, occupied->y, occupied->count, clear);
  for (std::size_t i = 0; i < occupied->count; ++i) {
    const std::uint32_t key = keyOf(occupied->square[i]);
    if (clear[i] != 0 && !isReturned(key)) cleared_.push_back(key);
  }
  occupied->count = 0;
}

bool ScanChanges::isReturned(std::uint32_t key) {
  if (!returned_is_known_) {
    returned_.fill(0);
    for (const std::uint32_t other : returns_) {
      returned_[(other >> 16) % kTile] |= std::uint64_t{1} << (other % kTile);
    }
    returned_is_known_ = true;
  }
  return (returned_[(key >> 16) % kTile] >> (key % kTile) & 1) != 0 &&
         std::find(returns_.begin(), returns_.end(), key) != returns_.end();
}

}  // namespace lstm_planner
