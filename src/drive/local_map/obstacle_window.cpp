#include "lstm_planner/drive/local_map/obstacle_window.hpp"

#include <algorithm>
#include <cmath>

#include "drive/local_map/bounded_rounding.hpp"

namespace lstm_planner {

ObstacleWindow::ObstacleWindow(double width, double resolution)
    : resolution_(resolution),
      side_(static_cast<int>(std::ceil(width / (kSide * resolution)))),
      cell_size_(kSide * resolution),
      squares_(kSide * side_, kSide * side_),
      cells_(side_, side_) {}

void ObstacleWindow::clear() {
  placed_ = false;
  squares_.clear();
  cells_.clear();
}

bool ObstacleWindow::moveTo(const Pose2& pose) {
  const int column = floorOf(pose.x / cell_size_) - side_ / 2;
  const int row = floorOf(pose.y / cell_size_) - side_ / 2;
  const int right = std::clamp(column - origin_column_, -side_, side_);
  const int up = std::clamp(row - origin_row_, -side_, side_);
  if (placed_ && std::max(std::abs(right), std::abs(up)) <= side_ / 8) {
    return false;
  }
  if (placed_) {
    squares_.move(kSide * right, kSide * up);
    cells_.move(right, up);
  }
  origin_column_ = column;
  origin_row_ = row;
  placed_ = true;
  return true;
}

int ObstacleWindow::cellAt(const Point2& position) const {
  const int column = floorOf(position.x / cell_size_) - origin_column_;
  const int row = floorOf(position.y / cell_size_) - origin_row_;
  return column < 0 || row < 0 || column >= side_ || row >= side_ ? -1 : row * side_ + column;
}

Point2 ObstacleWindow::centerOf(int cell) const {
  return {(origin_column_ + cell % side_ + 0.5) * cell_size_, (origin_row_ + cell / side_ + 0.5) * cell_size_};
}

Square ObstacleWindow::squareAt(const Point2& position) const {
  // The difference first: 1e7 m are more of the smallest squares than floorOf() tells apart.
  return {floorOf(std::floor(position.x / resolution_) - origin().column),
          floorOf(std::floor(position.y / resolution_) - origin().row)};
}

std::vector<Point2> ObstacleWindow::occupied() const {
  std::vector<Point2> places;
  visitOccupied({0, 0}, {squares_.columns(), squares_.rows()}, [&](const Square& square) {
    places.push_back(centerOf(square));
    return false;
  });
  return places;
}

int ObstacleWindow::set(const Square& square, bool occupied) {
  const int column = square.column / kSide;
  const int row = square.row / kSide;
  if (occupied) {
    squares_.set(square.column, square.row);
    cells_.set(column, row);
  } else {
    squares_.reset(square.column, square.row);
    std::uint64_t others = 0;
    for (int r = row * kSide; r < (row + 1) * kSide; ++r) others |= squares_.from(column * kSide, r);
    if ((others & lowestBits(kSide)) == 0) {
      cells_.reset(column, row);
    }
  }
  return row * side_ + column;
}

}  // namespace lstm_planner
