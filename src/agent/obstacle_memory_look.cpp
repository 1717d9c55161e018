// What a scan adds to what is remembered, and what it takes away.

#include <algorithm>
#include <cmath>

#include "agent/whole_numbers.hpp"
#include "lstm_planner/agent/obstacle_memory.hpp"
#include "perception/lanes.hpp"

namespace lstm_planner {

namespace {

constexpr std::uint32_t kTile = 64;  ///< squares a side of the tile that returned_ covers

/// Places in single precision, so many at a time.
template <std::size_t kMost>
struct Batch {
  float x[kMost];
  float y[kMost];
  std::uint32_t what[kMost];
  std::uint8_t answer[kMost];
  std::size_t count = 0;
  bool full() const { return count == kMost; }
};

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
  returns_.resize(obstacles.size() + kLanes);
  returned_.fill(0);
  std::size_t count = 0;
  std::uint32_t last = ~std::uint32_t{0};
  const auto take = [&](const Point2* four) {
    const auto lane = [&](int i) { return static_cast<float>(four[i].x); };
    const auto other = [&](int i) { return static_cast<float>(four[i].y); };
    const Floats x{lane(0), lane(1), lane(2), lane(3)};
    const Floats y{other(0), other(1), other(2), other(3)};
    const Ints columns = toInts(cosine * x - sine * y + x_here) + allOf(first.column);
    const Ints rows = toInts(sine * x + cosine * y + y_here) + allOf(first.row);
    const Ints inside = (x * x + y * y <= reach) & (columns >= Ints{}) & (columns < sides) & (rows >= Ints{}) &
                        (rows < sides);
    const Ints keys = ((rows << 16) | columns) | ~inside;
    std::uint32_t key[kLanes];
    std::memcpy(key, &keys, sizeof(key));
    for (const std::uint32_t next : key) {
      // Written in any case, and kept when it is inside and not the same as the last.
      returns_[count] = next;
      count += next != last && next != ~std::uint32_t{0} ? 1 : 0;
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
  for (const std::uint32_t key : returns_) {
    returned_[(key >> 16) % kTile] |= std::uint64_t{1} << (key % kTile);
  }
}

bool ObstacleMemory::isReturned(std::uint32_t key) const {
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

  Batch<128> squares;
  const auto lookAtSquares = [&] {
    sight_.looksThrough(squares.x, squares.y, squares.count, squares.answer);
    for (std::size_t i = 0; i < squares.count; ++i) {
      if (squares.answer[i] != 0 && !isReturned(squares.what[i])) {
        seen_through_.push_back(squares.what[i]);
      }
    }
    squares.count = 0;
  };
  Batch<128> cells;
  const auto lookAtCells = [&] {
    sight_.mayLookThrough(cells.x, cells.y, cells.count, cells.answer);
    for (std::size_t i = 0; i < cells.count; ++i) {
      if (cells.answer[i] == 0) {
        continue;
      }
      const Square first = squareOf(cells.what[i]);
      for (int row = first.row; row < first.row + kSide; ++row) {
        std::uint64_t bits = squares_.from(first.column, row) & lowestBits(kSide);
        for (; bits != 0; bits &= bits - 1) {
          const Square square{first.column + lowestBit(bits), row};
          squares.x[squares.count] = left + static_cast<float>(square.column) * resolution;
          squares.y[squares.count] = bottom + static_cast<float>(square.row) * resolution;
          squares.what[squares.count] = keyOf(square);
          ++squares.count;
          if (squares.full()) lookAtSquares();
        }
      }
    }
    cells.count = 0;
  };

  constexpr float kMiddle = 0.5f * (kSide - 1);
  const int first_column = std::max(0, middle_column - reach);
  const int last_column = std::min(side_ - 1, middle_column + reach);
  for (int row = std::max(0, middle_row - reach); row <= std::min(side_ - 1, middle_row + reach); ++row) {
    const float y = bottom + (static_cast<float>(row * kSide) + kMiddle) * resolution;
    for (int column = first_column; column <= last_column; column += 64) {
      std::uint64_t bits = cells_.from(column, row) & lowestBits(std::min(64, last_column + 1 - column));
      for (; bits != 0; bits &= bits - 1) {
        const Square first{(column + lowestBit(bits)) * kSide, row * kSide};
        cells.x[cells.count] = left + (static_cast<float>(first.column) + kMiddle) * resolution;
        cells.y[cells.count] = y;
        cells.what[cells.count] = keyOf(first);
        ++cells.count;
        if (cells.full()) lookAtCells();
      }
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
