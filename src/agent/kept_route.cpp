#include "lstm_planner/agent/kept_route.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lstm_planner {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Points of a route for which memory is reserved.
constexpr std::size_t kReserved = 512;

/// A point this near to the robot is behind it, m.
constexpr double kPassed = 0.25;

double squaredDistanceToPiece(const Point2& point, const Point2& from, const Point2& to) {
  const Point2 line{to.x - from.x, to.y - from.y};
  const Point2 off{point.x - from.x, point.y - from.y};
  const double length = line.x * line.x + line.y * line.y;
  const double share = length > 0.0 ? std::clamp((off.x * line.x + off.y * line.y) / length, 0.0, 1.0) : 0.0;
  const double dx = off.x - share * line.x;
  const double dy = off.y - share * line.y;
  return dx * dx + dy * dy;
}

}  // namespace

KeptRoute::KeptRoute(const AgentParameters& parameters) : reach_(reachOfChanges(parameters)) {
  route_.points.reserve(kReserved);
  pieces_.reserve(kReserved);
}

double KeptRoute::reachOfChanges(const AgentParameters& parameters) {
  const ShieldParameters& shield = parameters.shield;
  const double comfort = std::max(parameters.memory.comfort, shield.clearance + 0.5 * parameters.memory.resolution);
  return shield.footprint_radius + comfort;
}

void KeptRoute::clear() {
  route_.points.clear();
  pieces_.clear();
}

void KeptRoute::swap(Route* route) {
  std::swap(route_, *route);
  measure();
  noteAll();
}

void KeptRoute::moveEnd(const Point2& end) {
  route_.points.back() = end;
  pieces_.back().cost = kUnknown;
  measure();
}

void KeptRoute::measure() {
  pieces_.resize(route_.points.size(), {0.0, kUnknown, 0.0});
  double rest = 0.0;
  for (std::size_t i = route_.points.size(); i-- > 0;) {
    pieces_[i].rest = rest;
    pieces_[i].length = i == 0 ? 0.0 : distanceBetween(route_.points[i - 1], route_.points[i]);
    rest += pieces_[i].length;
  }
  route_.length = rest;
}

void KeptRoute::advance(ObstacleMemory& memory, const Point2& here) {
  std::vector<Point2>& points = route_.points;
  // The part that was driven: up to the point beyond which the rest leads away from the robot.
  std::size_t next = 1;
  while (next + 1 < points.size()) {
    const double to_next = distanceBetween(here, points[next]);
    const double piece = pieces_[next + 1].length;
    const double beyond = distanceBetween(here, points[next + 1]);
    if (to_next > kPassed && beyond * beyond > piece * piece + to_next * to_next) {
      break;
    }
    if (to_next > kPassed && !memory.isFree(here, points[next + 1], ObstacleMemory::Passage::kTight)) {
      break;
    }
    ++next;
  }
  points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(next - 1));
  pieces_.erase(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(next - 1));
  points.front() = here;
  pieces_[1].length = distanceBetween(here, points[1]);
  pieces_[1].cost = kUnknown;
  route_.length = pieces_[1].length + pieces_[1].rest;
}

void KeptRoute::note(const ObstacleMemory& memory, const ObstacleMemory::Change& change) {
  const int cell = memory.cellAt(change.place);
  const auto bit = static_cast<std::size_t>(std::max(0, cell));
  if (cell < 0 || bit / 64 >= beside_.size() || (beside_[bit / 64] >> bit % 64 & 1) == 0) {
    return;
  }
  for (std::size_t i = 2; i < pieces_.size(); ++i) {
    if (!std::isnan(pieces_[i].cost) &&
        squaredDistanceToPiece(change.place, route_.points[i - 1], route_.points[i]) < reach_ * reach_) {
      pieces_[i].cost = kUnknown;
    }
  }
}

void KeptRoute::noteAll() {
  std::fill(beside_.begin(), beside_.end(), 0);
  for (Piece& piece : pieces_) {
    piece.cost = kUnknown;
  }
}

double KeptRoute::cost(ObstacleMemory& memory, const RouteFinder& finder, double distance) {
  double cost = 0.0;
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    if (distance <= 0.0) {
      return cost + pieces_[i].length + pieces_[i].rest;
    }
    Piece& piece = pieces_[i];
    if (std::isnan(piece.cost)) {
      piece.cost = finder.costOf(memory, route_.points[i - 1], route_.points[i]);
      if (i > 1) {  // the first one is looked at anew each time
        mark(memory, route_.points[i - 1], route_.points[i]);
      }
    }
    cost += piece.cost;
    distance -= piece.length;
  }
  return cost;
}

void KeptRoute::mark(const ObstacleMemory& memory, const Point2& from, const Point2& to) {
  const int side = memory.side();
  beside_.resize((static_cast<std::size_t>(side) * static_cast<std::size_t>(side) + 63) / 64);
  const int reach = static_cast<int>(std::ceil(reach_ / memory.cellSize())) + 1;
  const int parts = 1 + static_cast<int>(distanceBetween(from, to) / memory.cellSize());
  for (int i = 0; i <= parts; ++i) {
    const double share = static_cast<double>(i) / parts;
    const int cell = memory.cellAt({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
    if (cell < 0) {
      continue;
    }
    for (int row = std::max(0, cell / side - reach); row <= std::min(side - 1, cell / side + reach); ++row) {
      const int last = std::min(side - 1, cell % side + reach);
      for (int column = std::max(0, cell % side - reach); column <= last; ++column) {
        const auto bit = static_cast<std::size_t>(row * side + column);
        beside_[bit / 64] |= std::uint64_t{1} << bit % 64;
      }
    }
  }
}

}  // namespace lstm_planner
