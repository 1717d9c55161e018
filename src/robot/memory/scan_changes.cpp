#include "lstm_planner/robot/memory/scan_changes.hpp"

#include <algorithm>
#include <cmath>

#include "robot/memory/bounded_rounding.hpp"
#include "robot/perception/scan_kernels.hpp"

namespace lstm_planner {

namespace {

constexpr int kSide = ObstacleWindow::kSide;
constexpr std::uint32_t kTile = 64;  ///< squares a side of the tile that returned_ covers

constexpr std::size_t kMostCells = 256;      ///< that are compared together
constexpr std::size_t kPadding = 16;         ///< of what ScanKernels write
constexpr std::size_t kUsualChanges = 1024;  ///< for which there is room from the first

/// From the middle of a cell to the middle of its corner squares, in squares.
const double kCorner = std::hypot(1.5, 1.5);

}  // namespace

ScanChanges::ScanChanges(double reach, double resolution) : reach_(reach), sight_(kCorner * resolution) {
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

  const std::vector<Point2>& obstacles = situation.obstacles;
  const std::size_t most = std::max(obstacles.size(), situation.profile.ranges.size()) + 2 * kPadding;
  if (returns_.size() < most) {
    returns_.resize(most);
    places_.resize(most);
  }
  returns_count_ = obstacles.empty() ? 0
                                     : scanKernels().squaresOf(frame, &obstacles.front().x, obstacles.size(),
                                                               places_.data(), returns_.data());
  returned_is_known_ = false;
}

void ScanChanges::findCleared(const RangeProfile& profile, const Pose2& pose, const ObstacleWindow& window) {
  sight_.show(profile, pose.yaw);
  if (sight_.isBlind()) {
    return;
  }
  const Point2 scanner = toParentFrame(pose, profile.origin);
  const int reach = static_cast<int>(reach_ / window.cellSize());
  const int middle_column = floorOf(scanner.x / window.cellSize()) - window.originColumn();
  const int middle_row = floorOf(scanner.y / window.cellSize()) - window.originRow();
  const Point2 corner = window.centerOf(Square{0, 0});
  const SquareGrid grid{static_cast<float>(corner.x - scanner.x), static_cast<float>(corner.y - scanner.y),
                        static_cast<float>(window.resolution())};

  std::uint32_t cells[kMostCells + kPadding];
  std::size_t count = 0;
  constexpr std::uint64_t kNone = std::uint64_t{1} << 63;
  const int last = window.side() - 1;
  const int first_column = std::max(0, middle_column - reach);
  const int last_column = std::min(last, middle_column + reach);
  for (int row = std::max(0, middle_row - reach); row <= std::min(last, middle_row + reach); ++row) {
    for (int column = first_column; column <= last_column; column += 64) {
      std::uint64_t bits = window.cells().from(column, row) & lowestBits(std::min(64, last_column + 1 - column));
      if (count + 64 > kMostCells) {
        findInCells(window.squares(), grid, cells, count);
        count = 0;
      }
      const std::uint32_t first = keyOf({column * kSide, row * kSide});
      do {  // most rows have one or none: no jump that cannot be foreseen
        cells[count] = first + static_cast<std::uint32_t>(lowestBit(bits | kNone) * kSide);
        count += bits != 0 ? 1 : 0;
        bits &= bits - 1;
      } while (bits != 0);
    }
  }
  findInCells(window.squares(), grid, cells, count);
}

void ScanChanges::findInCells(const BitRows& squares, const SquareGrid& grid, std::uint32_t* cells, std::size_t count) {
  const ScanKernels& kernels = scanKernels();
  const SightBeams beams = sight_.beams();
  float limits[kMostCells + kPadding];
  const std::size_t in_sight = kernels.cellsInSight(beams, grid, cells, count, limits);
  std::uint16_t occupied[kMostCells];
  for (std::size_t i = 0; i < in_sight; ++i) {
    const Square first = squareOf(cells[i]);
    std::uint64_t bits = 0;
    for (int row = kSide - 1; row >= 0; --row) {
      bits = bits << kSide | (squares.from(first.column, first.row + row) & lowestBits(kSide));
    }
    occupied[i] = static_cast<std::uint16_t>(bits);
  }
  std::uint32_t clear[kMostCells * ObstacleWindow::kCellSquares + kPadding];
  const std::size_t found = kernels.clearSquares(beams, grid, cells, limits, occupied, in_sight, clear);
  for (std::size_t i = 0; i < found; ++i) {
    if (!isReturned(clear[i])) {
      cleared_.push_back(clear[i]);
    }
  }
}

bool ScanChanges::isReturned(std::uint32_t key) {
  if (!returned_is_known_) {
    returned_.fill(0);
    for (std::size_t i = 0; i < returns_count_; ++i) {
      const std::uint32_t other = returns_[i];
      returned_[(other >> 16) % kTile] |= std::uint64_t{1} << (other % kTile);
    }
    returned_is_known_ = true;
  }
  const auto end = returns_.begin() + static_cast<std::ptrdiff_t>(returns_count_);
  return (returned_[(key >> 16) % kTile] >> (key % kTile) & 1) != 0 && std::find(returns_.begin(), end, key) != end;
}

}  // namespace lstm_planner
