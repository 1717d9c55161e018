#include "lstm_planner/agent/route_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {

namespace {

constexpr std::uint16_t kFar = std::numeric_limits<std::uint16_t>::max();
constexpr int kStraight = 5;  ///< cost of a step; its diagonal is 7, 1 % less than the true ratio
constexpr int kDiagonal = 7;

/// Corners are pulled straight this far from the start, m: the rest is a guess that will be made anew anyway.
constexpr double kStraightened = 8.0;
constexpr std::size_t kLongestPull = 24;  ///< cells

constexpr double kDetour = 3.0;  ///< times the tolerance

/// Cost of the way between two cells if nothing is in between.
std::uint32_t octile(int columns, int rows) {
  const int longer = std::max(std::abs(columns), std::abs(rows));
  const int shorter = std::min(std::abs(columns), std::abs(rows));
  return static_cast<std::uint32_t>(kStraight * (longer - shorter) + kDiagonal * shorter);
}

/// The square nearest to `position` that the footprint fits on, at most `tolerance` away; false when there is none.
bool nearestPlace(ObstacleMemory& memory, const Point2& position, double tolerance, Point2* place) {
  const int cell = memory.cellAt(position);
  const int reach = static_cast<int>(std::ceil(tolerance / memory.cellSize()));
  const double square_size = memory.cellSize() / ObstacleMemory::kSide;
  constexpr double kMiddleSquare = 0.5 * (ObstacleMemory::kSide - 1);
  double nearest = tolerance;
  bool found = false;
  const auto lookInto = [&](int other) {
    const Point2 middle = memory.centerOf(other);
    for (int square = 0; square < ObstacleMemory::kCellSquares; ++square) {
      // Of two squares as near the last bit decides: rounded otherwise, trained networks would not come out the same.
      const Point2 at{middle.x + (square % ObstacleMemory::kSide - kMiddleSquare) * square_size,
                      middle.y + (square / ObstacleMemory::kSide - kMiddleSquare) * square_size};
      const double distance = distanceBetween(at, position);
      if (distance <= nearest && memory.isFree(at, at, ObstacleMemory::Passage::kTight)) {
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
        if (inside && memory.passage(row * memory.side() + column) != ObstacleMemory::Passage::kBlocked) {
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

RouteFinder::RouteFinder(double tightness) : tightness_(tightness) {}

bool RouteFinder::find(ObstacleMemory& memory, const Point2& start, const Point2& goal, double tolerance,
                       Route* route) {
  const int first = memory.cellAt(start);
  int end = -1;
  if (first < 0) {
    return false;
  }
  const int goal_cell = memory.cellAt(goal);
  // A cell that the footprint fits on somewhere may have places that it does not fit on.
  const bool blocked = goal_cell >= 0 && (memory.passage(goal_cell) == ObstacleMemory::Passage::kBlocked ||
                                          !memory.isFree(goal, goal, ObstacleMemory::Passage::kTight));
  Point2 end_point = goal;
  const bool fits = !blocked || nearestPlace(memory, goal, tolerance, &end_point);
  if (fits && search(memory, first, end_point, 0.0, &end) && trace(memory, start, end, end_point, route)) {
    // Who is near enough already does not make a long detour for a place that is hardly nearer: more likely odometry
    // has put it behind the wall.
    const bool near = distanceBetween(start, goal) <= tolerance;
    if (!near || route->length <= kDetour * tolerance) {
      return true;
    }
  }
  return search(memory, first, goal, tolerance, &end) && trace(memory, start, end, goal, route);
}

bool RouteFinder::trace(ObstacleMemory& memory, const Point2& start, int end, const Point2& goal, Route* route) {
  route->points.clear();
  const int first = memory.cellAt(start);
  const bool goal_is_free = memory.cellAt(goal) == end || memory.cellAt(goal) < 0;
  if (goal_is_free) {
    route->points.push_back(goal);
  }
  for (int cell = end; cell != first;) {
    if (memory.cellAt(goal) != cell) {
      route->points.push_back(memory.bestPlace(cell));
    }
    const CellIndex step = kGridRaySteps[from_[static_cast<std::size_t>(cell)]];
    cell -= step.row * memory.side() + step.column;
  }
  route->points.push_back(start);
  std::reverse(route->points.begin(), route->points.end());
  route->cost = costs_[static_cast<std::size_t>(end)] * memory.cellSize() / kStraight;
  if (memory.cellAt(goal) < 0) {
    route->cost += distanceBetween(route->points[route->points.size() - 2], goal);
  }
  pullStraight(memory, route);
  route->length = lengthOf(route->points);
  return true;
}

bool RouteFinder::search(ObstacleMemory& memory, int start, const Point2& goal, double tolerance, int* end) {
  using Passage = ObstacleMemory::Passage;
  const int side = memory.side();
  costs_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), kFar);
  from_.resize(costs_.size());
  open_.clear();
  const auto later = [](const Open& a, const Open& b) { return a.estimate > b.estimate; };

  const int goal_cell = memory.cellAt(goal);
  const Point2 origin = memory.centerOf(start);
  const int goal_column = start % side + static_cast<int>(std::lround((goal.x - origin.x) / memory.cellSize()));
  const int goal_row = start / side + static_cast<int>(std::lround((goal.y - origin.y) / memory.cellSize()));
  // In halves; blocked cells are never entered.
  const auto tight = static_cast<int>(std::lround(tightness_ * 2.0));
  const int factors[] = {tight, tight, static_cast<int>(std::lround(narrowness() * 2.0)), 2};

  costs_[static_cast<std::size_t>(start)] = 0;
  open_.push_back({octile(goal_column - start % side, goal_row - start / side), static_cast<std::uint32_t>(start)});
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), later);
    const Open next = open_.back();
    open_.pop_back();
    const int cell = static_cast<int>(next.cell);
    const int column = cell % side;
    const int row = cell / side;
    const int cost = costs_[next.cell];
    if (next.estimate != static_cast<std::uint32_t>(cost) + octile(goal_column - column, goal_row - row)) {
      continue;  // a cheaper way to it was found meanwhile
    }
    const bool at_border = column == 0 || row == 0 || column == side - 1 || row == side - 1;
    const bool near_enough = tolerance > 0.0 && distanceBetween(memory.bestPlace(cell), goal) <= tolerance;
    if (cell == goal_cell || near_enough || (goal_cell < 0 && at_border)) {
      *end = cell;
      return true;
    }
    const std::uint8_t exits = memory.exits(cell);
    for (std::size_t direction = 0; direction < kGridRaySteps.size(); ++direction) {
      if ((exits >> direction & 1) == 0) {
        continue;
      }
      const bool diagonal = direction % 2 != 0;
      const int neighbour = cell + kGridRaySteps[direction].row * side + kGridRaySteps[direction].column;
      const auto i = static_cast<std::size_t>(neighbour);
      const Passage passage = memory.passage(neighbour);
      const int step = diagonal ? kDiagonal : kStraight;
      const int sum = cost + step * factors[static_cast<int>(passage)] / 2;
      if (sum < costs_[i]) {
        costs_[i] = static_cast<std::uint16_t>(sum);
        from_[i] = static_cast<std::uint8_t>(direction);
        open_.push_back({static_cast<std::uint32_t>(sum) +
                             octile(goal_column - neighbour % side, goal_row - neighbour / side),
                         static_cast<std::uint32_t>(neighbour)});
        std::push_heap(open_.begin(), open_.end(), later);
      }
    }
  }
  return false;
}

void RouteFinder::pullStraight(ObstacleMemory& memory, Route* route) const {
  std::vector<Point2>& points = route->points;
  std::vector<Point2> pulled = {points.front()};
  double length = 0.0;
  std::size_t at = 0;
  while (at + 1 < points.size()) {
    std::size_t next = at + 1;
    if (length < kStraightened) {
      ObstacleMemory::Passage passage = ObstacleMemory::Passage::kRoomy;
      for (std::size_t to = at + 1; to < std::min(points.size(), at + 1 + kLongestPull); ++to) {
        const int cell = memory.cellAt(points[to]);
        if (cell >= 0 && to + 1 < points.size()) {
          passage = std::min(passage, memory.passage(cell));
        }
        if (to > at + 1 && !memory.isFree(points[at], points[to], passage)) {
          break;
        }
        next = to;
      }
    }
    length += distanceBetween(points[at], points[next]);
    pulled.push_back(points[next]);
    at = next;
  }
  points.swap(pulled);
}

double RouteFinder::costOf(ObstacleMemory& memory, const Route& route, double distance) const {
  double cost = 0.0;
  for (std::size_t i = 1; i < route.points.size(); ++i) {
    const Point2& from = route.points[i - 1];
    const Point2& to = route.points[i];
    const double length = distanceBetween(from, to);
    if (distance > 0.0 && memory.cellAt(to) >= 0 && memory.cellAt(from) >= 0) {
      using Passage = ObstacleMemory::Passage;
      if (!memory.isFree(from, to, Passage::kTight)) {
        return std::numeric_limits<double>::infinity();
      }
      cost += memory.isFree(from, to, Passage::kRoomy)    ? length
              : memory.isFree(from, to, Passage::kNarrow) ? narrowness() * length
                                                          : tightness_ * length;
    } else {
      cost += length;
    }
    distance -= length;
  }
  return cost;
}

}  // namespace lstm_planner
