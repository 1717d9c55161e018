#include "lstm_planner/drive/local_map/route_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "drive/local_map/bounded_rounding.hpp"

namespace lstm_planner {

namespace {

/// Corners are pulled straight this far from the start, m: the rest is a guess that will be made anew anyway.
constexpr double kStraightened = 8.0;
constexpr std::size_t kLongestPull = 24;  ///< cells

constexpr double kWidestDetour = 3.0;  ///< times the tolerance

/// The square nearest to `position` that the footprint fits on, at most `tolerance` away; false when there is none.
bool nearestPlace(LocalMap& memory, const Point2& position, double tolerance, Point2* place) {
  const int cell = memory.cellAt(position);
  const int reach = static_cast<int>(std::ceil(tolerance / memory.cellSize()));
  const double square_size = memory.cellSize() / LocalMap::kSide;
  constexpr double kMiddleSquare = 0.5 * (LocalMap::kSide - 1);
  double nearest = tolerance;
  bool found = false;
  const auto lookInto = [&](int other) {
    const Point2 middle = memory.centerOf(other);
    for (int square = 0; square < LocalMap::kCellSquares; ++square) {
      // Of two squares as near the last bit decides: rounded otherwise, trained networks would not come out the same.
      const Point2 at{middle.x + (square % LocalMap::kSide - kMiddleSquare) * square_size,
                      middle.y + (square / LocalMap::kSide - kMiddleSquare) * square_size};
      const double distance = distanceBetween(at, position);
      if (distance <= nearest && memory.isFree(at, at, LocalMap::Passage::kTight)) {
        nearest = distance;
        *place = at;
        found = true;
      }
    }
  };
  // Ring by ring, until no nearer one can come.
  for (int ring = 0; ring <= reach && (ring - 1) * memory.cellSize() <= nearest; ++ring) {
    for (int rows = -ring; rows <= ring; ++rows) {
      for (int columns = -ring; columns <= ring; columns += std::abs(rows) == ring ? 1 : std::max(1, 2 * ring)) {
        const int column = cell % memory.side() + columns;
        const int row = cell / memory.side() + rows;
        const bool inside = column >= 0 && column < memory.side() && row >= 0 && row < memory.side();
        if (inside && memory.passage(row * memory.side() + column) != LocalMap::Passage::kBlocked) {
          lookInto(row * memory.side() + column);
        }
      }
    }
  }
  return found;
}

}  // namespace

double lengthOf(const std::vector<Point2>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    length += distanceBetween(points[i - 1], points[i]);
  }
  return length;
}

RouteFinder::RouteFinder(double tightness) : tightness_(tightness), cost_to_go_(tightness) {}

bool RouteFinder::isDetour(double distance, double length, double tolerance) {
  return distance <= tolerance && length > kWidestDetour * tolerance;
}

bool RouteFinder::find(LocalMap& memory, const Point2& start, const Point2& goal, double tolerance, Route* route) {
  const int first = memory.cellAt(start);
  if (first < 0) {
    return false;
  }
  const int goal_cell = memory.cellAt(goal);
  // A cell that the footprint fits on somewhere may have places that it does not fit on.
  const bool blocked = goal_cell >= 0 && (memory.passage(goal_cell) == LocalMap::Passage::kBlocked ||
                                          !memory.isFree(goal, goal, LocalMap::Passage::kTight));
  Point2 end_point = goal;
  const bool fits = !blocked || nearestPlace(memory, goal, tolerance, &end_point);
  if (fits && search(memory, first, end_point, 0.0)) {
    follow(memory, start, route);
    // Who is near enough already does not make a long detour for a place that is hardly nearer: more likely odometry
    // has put it behind the wall.
    if (!isDetour(distanceBetween(start, goal), route->length, tolerance)) return true;
  }
  if (!search(memory, first, goal, tolerance)) {
    return false;
  }
  follow(memory, start, route);
  return true;
}

bool RouteFinder::findFrom(LocalMap& memory, const Point2& start, Route* route) {
  const int first = memory.cellAt(start);
  if (first < 0 || !cost_to_go_.searchOn(memory, first, end_column_, end_row_)) return false;
  follow(memory, start, route);
  return true;
}

bool RouteFinder::search(LocalMap& memory, int start, const Point2& end, double tolerance) {
  end_ = end;
  tolerance_ = tolerance;
  const int side = memory.side();
  const int end_cell = memory.cellAt(end);
  const Point2 origin = memory.centerOf(0);
  end_column_ = end_cell < 0 ? roundOf((end.x - origin.x) / memory.cellSize()) : end_cell % side;
  end_row_ = end_cell < 0 ? roundOf((end.y - origin.y) / memory.cellSize()) : end_cell / side;
  ends_.clear();
  if (end_cell < 0) {
    ending_ = Ending::kBorder;
    for (int i = 0; i < side; ++i) {
      addEnd(memory, i, 0);
      addEnd(memory, i, side - 1);
    }
    for (int i = 1; i < side - 1; ++i) {
      addEnd(memory, 0, i);
      addEnd(memory, side - 1, i);
    }
  } else if (tolerance > 0.0) {
    ending_ = Ending::kNear;
    const int reach = static_cast<int>(std::ceil(tolerance / memory.cellSize())) + 1;
    for (int row = std::max(0, end_row_ - reach); row <= std::min(side - 1, end_row_ + reach); ++row) {
      for (int column = std::max(0, end_column_ - reach); column <= std::min(side - 1, end_column_ + reach); ++column) {
        addEnd(memory, column, row);
      }
    }
  } else {
    ending_ = Ending::kAtCell;
    ends_.push_back({end_cell, 0});
  }
  return !ends_.empty() && cost_to_go_.search(memory, start, ends_, end_column_, end_row_);
}

void RouteFinder::addEnd(LocalMap& memory, int column, int row) {
  const int cell = row * memory.side() + column;
  if (isEnd(memory, cell)) {
    ends_.push_back({cell, CostToGo::octile(end_column_ - column, end_row_ - row)});
  }
}

bool RouteFinder::isEnd(LocalMap& memory, int cell) const {
  switch (ending_) {
    case Ending::kAtCell:
      return cell == end_row_ * memory.side() + end_column_;
    case Ending::kNear:
      return distanceBetween(memory.bestPlace(cell), end_) <= tolerance_;
    case Ending::kBorder:
      break;
  }
  return memory.isAtBorder(cell);
}

void RouteFinder::follow(LocalMap& memory, const Point2& start, Route* route) const {
  std::vector<Point2>& points = route->points;
  points.clear();
  points.push_back(start);
  const std::vector<int>& path = cost_to_go_.path();
  const int goal_cell = memory.cellAt(end_);
  std::size_t cells = 1;
  while (!isEnd(memory, path[cells - 1]) && cells < path.size()) {
    const int cell = path[cells++];
    if (cell != goal_cell) {
      points.push_back(memory.bestPlace(cell));
    }
  }
  const int last = path[cells - 1];
  route->cost = CostToGo::metres(cost_to_go_.cost(path.front()) - cost_to_go_.cost(last), memory.cellSize());
  if (goal_cell < 0) {
    route->cost += distanceBetween(points.back(), end_);
  }
  if (goal_cell == last || goal_cell < 0) {
    points.push_back(end_);
  }
  pullStraight(memory, route);
  route->length = lengthOf(points);
}

void RouteFinder::pullStraight(LocalMap& memory, Route* route) const {
  std::vector<Point2>& points = route->points;
  std::size_t pulled = 1;  // of the points, which are overwritten from the front
  double length = 0.0;
  std::size_t at = 0;
  while (at + 1 < points.size()) {
    std::size_t next = at + 1;
    if (length < kStraightened) {
      next = farthestInSight(memory, points, at);
      length += distanceBetween(points[at], points[next]);
    }
    points[pulled++] = points[next];
    at = next;
  }
  points.resize(pulled);
}

/// The straight path there has as much room as all the points in between. Looks twice as far each time, then between
/// the last two.
std::size_t RouteFinder::farthestInSight(LocalMap& memory, const std::vector<Point2>& points, std::size_t at) {
  const std::size_t most = std::min(kLongestPull, points.size() - 1 - at);
  std::array<LocalMap::Passage, kLongestPull + 1> passages;
  passages[0] = LocalMap::Passage::kRoomy;
  for (std::size_t i = 1; i <= most; ++i) {
    const int cell = at + i + 1 < points.size() ? memory.cellAt(points[at + i]) : -1;
    passages[i] = cell >= 0 ? std::min(passages[i - 1], memory.passage(cell)) : passages[i - 1];
  }
  const auto inSight = [&](std::size_t i) { return memory.isFree(points[at], points[at + i], passages[i]); };
  std::size_t seen = 1;
  std::size_t hidden = most + 1;
  while (seen < most && hidden > most) {
    const std::size_t farther = std::min(2 * seen, most);
    (inSight(farther) ? seen : hidden) = farther;
  }
  while (hidden - seen > 1) {
    const std::size_t middle = seen + (hidden - seen) / 2;
    (inSight(middle) ? seen : hidden) = middle;
  }
  return at + seen;
}

double RouteFinder::costOf(const LocalMap& memory, const Point2& from, const Point2& to) const {
  using Passage = LocalMap::Passage;
  const double length = distanceBetween(from, to);
  if (memory.cellAt(to) < 0 || memory.cellAt(from) < 0 || memory.isFree(from, to, Passage::kRoomy)) {
    return length;
  }
  if (memory.isFree(from, to, Passage::kNarrow)) {
    return CostToGo::narrowness(tightness_) * length;
  }
  return memory.isFree(from, to, Passage::kTight) ? tightness_ * length : std::numeric_limits<double>::infinity();
}

}  // namespace lstm_planner
