#include "lstm_planner/drive/local_map/kept_route.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/common/segment.hpp"
#include "lstm_planner/grid/bit_rows.hpp"

namespace lstm_planner {

namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Points of a route for which memory is reserved.
constexpr std::size_t kReserved = 256;

/// Cells a side of what shares a bit that tells whether a piece is near.
constexpr int kShare = 2;

/// A point this near to the robot is behind it, m.
constexpr double kPassed = 0.25;

/// Corners are cut within this distance, m, where there is room all the way: a search pulls straight what is near, and
/// not in one piece.
constexpr double kPulled = 8.0;

}  // namespace

KeptRoute::KeptRoute(const MemoryParameters& parameters, const ShieldParameters& shield)
    : reach_(reachOfChanges(parameters, shield)) {
  route_.points.reserve(kReserved);
  pieces_.reserve(kReserved);
}

double KeptRoute::reachOfChanges(const MemoryParameters& parameters, const ShieldParameters& shield) {
  const double comfort = std::max(parameters.comfort, shield.clearance + 0.5 * parameters.resolution);
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

void KeptRoute::swap(KeptRoute* other) {
  std::swap(route_, other->route_);
  std::swap(pieces_, other->pieces_);
  forgetMarks();
  other->forgetMarks();
}

void KeptRoute::moveEnd(const Point2& end) {
  route_.points.back() = end;
  pieces_.back().cost = kUnknown;
  pieces_.back().marked = false;
  measure();
}

void KeptRoute::measure() {
  pieces_.resize(route_.points.size(), {0.0f, 0.0f, kUnknown, false});
  double rest = 0.0;
  for (std::size_t i = route_.points.size(); i-- > 0;) {
    const double length = i == 0 ? 0.0 : distanceBetween(route_.points[i - 1], route_.points[i]);
    pieces_[i].rest = static_cast<float>(rest);
    pieces_[i].length = static_cast<float>(length);
    rest += length;
  }
  route_.length = rest;
}

void KeptRoute::advance(LocalMap& memory, const Point2& here) {
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
    if (to_next > kPassed && !memory.isFree(here, points[next + 1], LocalMap::Passage::kTight)) {
      break;
    }
    ++next;
  }
  while (next + 1 < points.size() && distanceBetween(here, points[next + 1]) < kPulled &&
         memory.isFree(here, points[next + 1], LocalMap::Passage::kRoomy)) {
    ++next;
  }
  points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(next - 1));
  pieces_.erase(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(next - 1));
  points.front() = here;
  const double length = distanceBetween(here, points[1]);
  pieces_[1].length = static_cast<float>(length);
  pieces_[1].cost = kUnknown;
  route_.length = length + pieces_[1].rest;
}

void KeptRoute::note(const LocalMap& memory, const LocalMap::Change& change) {
  markCosted(memory);
  const int cell = memory.cellAt(change.place);
  if (cell < 0 || beside_.empty()) {
    return;
  }
  const int share = cell / memory.side() / kShare * sharesASide(memory) + cell % memory.side() / kShare;
  const auto bit = static_cast<std::size_t>(share);
  if ((beside_[bit / 64] >> bit % 64 & 1) == 0) {
    return;
  }
  for (std::size_t i = 2; i < pieces_.size(); ++i) {
    if (!std::isnan(pieces_[i].cost) &&
        squaredDistanceToSegment(change.place, route_.points[i - 1], route_.points[i]) < reach_ * reach_) {
      pieces_[i].cost = kUnknown;
    }
  }
}

void KeptRoute::noteAll() {
  forgetMarks();
  for (Piece& piece : pieces_) {
    piece.cost = kUnknown;
  }
}

void KeptRoute::forgetMarks() {
  std::fill(beside_.begin(), beside_.end(), 0);
  for (Piece& piece : pieces_) {
    piece.marked = false;
  }
  all_are_marked_ = false;
}

double KeptRoute::cost(LocalMap& memory, const RouteFinder& finder, double distance) {
  double cost = 0.0;
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    if (distance <= 0.0) {
      return cost + pieces_[i].length + pieces_[i].rest;
    }
    Piece& piece = pieces_[i];
    if (std::isnan(piece.cost)) {
      piece.cost = static_cast<float>(finder.costOf(memory, route_.points[i - 1], route_.points[i]));
      all_are_marked_ = all_are_marked_ && (i == 1 || piece.marked);
    }
    cost += piece.cost;
    distance -= piece.length;
  }
  return cost;
}

/// Not before something has changed, as routes that are not taken need no marks.
void KeptRoute::markCosted(const LocalMap& memory) {
  if (all_are_marked_) {
    return;
  }
  // The first one is looked at anew each time.
  for (std::size_t i = 2; i < pieces_.size(); ++i) {
    if (!pieces_[i].marked && !std::isnan(pieces_[i].cost)) {
      mark(memory, route_.points[i - 1], route_.points[i]);
      pieces_[i].marked = true;
    }
  }
  all_are_marked_ = true;
}

void KeptRoute::mark(const LocalMap& memory, const Point2& from, const Point2& to) {
  const int shares = sharesASide(memory);
  beside_.resize((static_cast<std::size_t>(shares) * static_cast<std::size_t>(shares) + 63) / 64);
  const double share_size = kShare * memory.cellSize();
  const int reach = static_cast<int>(std::ceil(reach_ / share_size)) + 1;
  const int parts = 1 + static_cast<int>(distanceBetween(from, to) / share_size);
  for (int i = 0; i <= parts; ++i) {
    const double part = static_cast<double>(i) / parts;
    const int cell = memory.cellAt({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)});
    if (cell < 0) {
      continue;
    }
    const int column = cell % memory.side() / kShare;
    const int row = cell / memory.side() / kShare;
    for (int other = std::max(0, row - reach); other <= std::min(shares - 1, row + reach); ++other) {
      const int last = other * shares + std::min(shares - 1, column + reach);
      for (int bit = other * shares + std::max(0, column - reach); bit <= last;) {
        const int bits = std::min(64 - bit % 64, last + 1 - bit);
        beside_[static_cast<std::size_t>(bit / 64)] |= lowestBits(bits) << bit % 64;
        bit += bits;
      }
    }
  }
}

int KeptRoute::sharesASide(const LocalMap& memory) { return (memory.side() + kShare - 1) / kShare; }

}  // namespace lstm_planner
