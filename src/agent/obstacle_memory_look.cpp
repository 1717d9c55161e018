// What a scan adds to what is remembered, and what it takes away.

#include <algorithm>
#include <cmath>

#include "agent/whole_numbers.hpp"
#include "lstm_planner/agent/obstacle_memory.hpp"
#include "perception/lanes.hpp"

namespace lstm_planner {

namespace {

constexpr std::uint32_t kTile = 64;  ///< squares a side of the tile that returned_ covers

constexpr std::uint32_t kOutside = ~std::uint32_t{0};  ///< no square's key

/// Places in single precision, so many at a time.
struct Batch {
  static constexpr std::size_t kMost = 256;
  float x[kMost];
  float y[kMost];
  std::uint32_t what[kMost];
  std::size_t count = 0;

  void add(float at_x, float at_y, std::uint32_t key, bool counts) {
    x[count] = at_x;
    y[count] = at_y;
    what[count] = key;
    count += counts ? 1 : 0;
  }
};

/// A bit for each square of a cell whose distance squared is less than `limit`; (x, y) is the first square.
std::uint64_t nearerSquares(float x, float y, float resolution, float limit) {
  static_assert(ObstacleMemory::kSide == kLanes, "a row of squares side by side");
  const Floats dx = allOf(x) + allOf(resolution) * Floats{0.0f, 1.0f, 2.0f, 3.0f};
  const Floats squared = dx * dx;
  Ints bits = {};
  Ints weights = {1, 2, 4, 8};
  for (int row = 0; row < ObstacleMemory::kSide; ++row) {
    const float dy = y + static_cast<float>(row) * resolution;
    bits |= (squared < allOf(limit - dy * dy)) & weights;
    weights <<= ObstacleMemory::kSide;
  }
  return static_cast<std::uint64_t>(sumOfLanes(bits));
}

}  // namespace

void ObstacleMemory::look(const Situation& situation) {
  if (!isFinite(situation.pose)) {
    return;
  }
  moveWindow(situation.pose);
  outdated_ = -1;
  collectReturns(situation);
  forgetSeenThrough(situation);
  markReturns();
  // Where the robot stands nothing else can be.
  forgetUnderneath(situation.pose);
}

void ObstacleMemory::collectReturns(const Situation& situation) {
  const Pose2& pose = situation.pose;
  const double scale = 1.0 / parameters_.resolution;
  // Squares are counted from one so far to the left of and below the robot that no return has a negative number.
  const int bias = static_cast<int>(std::ceil(parameters_.reach * scale)) + 1;
  const Square here = squareAt({pose.x, pose.y});
  const Square first{here.column - bias - kSide * origin_column_, here.row - bias - kSide * origin_row_};
  const Floats cosine = allOf(static_cast<float>(std::cos(pose.yaw) * scale));
  const Floats sine = allOf(static_cast<float>(std::sin(pose.yaw) * scale));
  const Floats x_here = allOf(static_cast<float>(pose.x * scale - here.column + bias));
  const Floats y_here = allOf(static_cast<float>(pose.y * scale - here.row + bias));
  const Floats reach = allOf(static_cast<float>(parameters_.reach * parameters_.reach));
  const Ints sides = allOf(squares_.columns());

  const std::vector<Point2>& obstacles = situation.obstacles;
  returns_.reserve(std::max(obstacles.size(), situation.profile.ranges.size()) + kLanes);
  returns_.resize(obstacles.size() + kLanes);
  std::size_t count = 0;
  std::uint32_t last = kOutside;
  const auto take = [&](const Point2* four) {
    Floats x;
    Floats y;
    splitPairs(&four->x, &x, &y);
    const Ints columns = toInts(cosine * x - sine * y + x_here) + allOf(first.column);
    const Ints rows = toInts(sine * x + cosine * y + y_here) + allOf(first.row);
    const Ints outside = (x * x + y * y > reach) | (columns < Ints{}) | (columns >= sides) | (rows < Ints{}) |
                         (rows >= sides);
    const Ints keys = ((rows << 16) | columns) | outside;
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto next = static_cast<std::uint32_t>(keys[lane]);
      // Written in any case, and kept when it is inside and not the same as the last.
      returns_[count] = next;
      count += static_cast<std::size_t>(next != last) & static_cast<std::size_t>(next != kOutside);
      last = next;
    }
  };
  std::size_t i = 0;
  for (; i + kLanes <= obstacles.size(); i += kLanes) take(&obstacles[i]);
  if (i < obstacles.size()) {
    Point2 rest[kLanes];
    for (Point2& place : rest) place = obstacles[std::min(i++, obstacles.size() - 1)];
    take(rest);
  }
  returns_.resize(count);
  returned_is_known_ = false;
}

bool ObstacleMemory::isReturned(std::uint32_t key) {
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

void ObstacleMemory::forgetSeenThrough(const Situation& situation) {
  sight_.show(situation.profile, situation.pose.yaw);
  seen_through_.clear();
  const Point2 scanner = toParentFrame(situation.pose, situation.profile.origin);
  const int reach = static_cast<int>(parameters_.reach / cell_size_);
  const int middle_column = floorOf(scanner.x / cell_size_) - origin_column_;
  const int middle_row = floorOf(scanner.y / cell_size_) - origin_row_;
  const Point2 corner = centerOf(Square{0, 0});
  const auto left = static_cast<float>(corner.x - scanner.x);
  const auto bottom = static_cast<float>(corner.y - scanner.y);
  const auto resolution = static_cast<float>(parameters_.resolution);

  constexpr float kMiddle = 0.5f * (kSide - 1);
  Batch squares;
  const auto lookAtSquares = [&] {
    std::uint8_t through[Batch::kMost];
    sight_.looksThrough(squares.x, squares.y, squares.count, through);
    for (std::size_t i = 0; i < squares.count; ++i) {
      if (through[i] != 0 && !isReturned(squares.what[i])) {
        seen_through_.push_back(squares.what[i]);
      }
    }
    squares.count = 0;
  };
  Batch cells;
  const auto lookAtCells = [&] {
    float limits[Batch::kMost];
    sight_.limits(cells.x, cells.y, cells.count, limits);
    for (std::size_t i = 0; i < cells.count; ++i) {
      if (limits[i] == 0.0f) {
        continue;
      }
      const Square first = squareOf(cells.what[i]);
      const float x = cells.x[i] - kMiddle * resolution;
      const float y = cells.y[i] - kMiddle * resolution;
      std::uint64_t bits = nearerSquares(x, y, resolution, limits[i]);
      std::uint64_t occupied = 0;
      for (int row = kSide - 1; row >= 0; --row) {
        occupied = occupied << kSide | (squares_.from(first.column, first.row + row) & lowestBits(kSide));
      }
      for (bits &= occupied; bits != 0; bits &= bits - 1) {
        const int bit = lowestBit(bits);
        const int column = bit % kSide;
        const int row = bit / kSide;
        squares.add(x + static_cast<float>(column) * resolution, y + static_cast<float>(row) * resolution,
                    keyOf({first.column + column, first.row + row}), true);
      }
      if (squares.count + kCellSquares > Batch::kMost) lookAtSquares();
    }
    cells.count = 0;
  };

  constexpr std::uint64_t kNone = std::uint64_t{1} << 63;
  const int first_column = std::max(0, middle_column - reach);
  const int last_column = std::min(side_ - 1, middle_column + reach);
  for (int row = std::max(0, middle_row - reach); row <= std::min(side_ - 1, middle_row + reach); ++row) {
    const float y = bottom + (static_cast<float>(row * kSide) + kMiddle) * resolution;
    for (int column = first_column; column <= last_column; column += 64) {
      std::uint64_t bits = cells_.from(column, row) & lowestBits(std::min(64, last_column + 1 - column));
      if (cells.count + 64 > Batch::kMost) lookAtCells();
      do {  // most rows have one or none: no jump that cannot be foreseen
        const Square first{(column + lowestBit(bits | kNone)) * kSide, row * kSide};
        const float x = left + (static_cast<float>(first.column) + kMiddle) * resolution;
        cells.add(x, y, keyOf(first), bits != 0);
        bits &= bits - 1;
      } while (bits != 0);
    }
  }
  lookAtCells();
  lookAtSquares();
  for (const std::uint32_t key : seen_through_) {
    set(squareOf(key), false);
  }
}

void ObstacleMemory::markReturns() {
  for (const std::uint32_t key : returns_) {
    const Square square = squareOf(key);
    if (!squares_.test(square.column, square.row)) {
      set(square, true);
    }
  }
}

}  // namespace lstm_planner
