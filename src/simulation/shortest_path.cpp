#include "simulation/shortest_path.hpp"

#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace lstm_planner {
namespace {

constexpr double kUnreachable = std::numeric_limits<double>::infinity();
/// No path along the eight directions of a grid is longer than the straight one by more than this: 1 / cos(22.5 deg).
constexpr double kDetour = 1.0823922;

class LazyThetaStar {
 public:
  LazyThetaStar(const DistanceField& distances, const GeodesicField& to_goal, const OccupancyGrid& grid,
                double clearance)
      : distances_(distances),
        to_goal_(to_goal),
        resolution_(grid.resolution()),
        clearance_(clearance),
        lengths_(grid.columns(), grid.rows(), static_cast<float>(kUnreachable)),
        parents_(grid.columns(), grid.rows(), {}),
        closed_(grid.columns(), grid.rows(), 0) {}

  /// In cells.
  double search(CellIndex start, CellIndex goal) {
    lengths_[start] = 0.0f;
    parents_[start] = start;
    push(start);
    while (!open_.empty()) {
      const CellIndex here = lengths_.cellAt(open_.top().second);
      open_.pop();
      if (closed_[here] != 0) continue;
      makeSure(here);
      closed_[here] = 1;
      if (here == goal) return lengths_[here];
      expand(here);
    }
    return kUnreachable;
  }

 private:
  bool isFree(CellIndex cell) const {
    const float distance = distances_.at(cell);
    return distance > 0.0f && distance >= clearance_;
  }
  static double distance(CellIndex a, CellIndex b) { return std::hypot(a.column - b.column, a.row - b.row); }

  void push(CellIndex cell) {
    const double left = to_goal_.at(cell) / resolution_ / kDetour;
    open_.push({lengths_[cell] + left, lengths_.offset(cell)});
  }

  template <typename Visit>
  void forNeighbours(CellIndex cell, const Visit& visit) const {
    for (int up = -1; up <= 1; ++up) {
      for (int right = -1; right <= 1; ++right) {
        const CellIndex neighbour{cell.column + right, cell.row + up};
        if ((right == 0 && up == 0) || !isFree(neighbour)) continue;
        if (!isFree({neighbour.column, cell.row}) || !isFree({cell.column, neighbour.row})) continue;
        visit(neighbour);
      }
    }
  }

  /// Its path came straight from the parent of the cell before, on trust.
  void makeSure(CellIndex cell) {
    if (isVisible(parents_[cell], cell)) return;
    double best = kUnreachable;
    forNeighbours(cell, [&](CellIndex neighbour) {
      if (closed_[neighbour] == 0) return;
      const double length = lengths_[neighbour] + distance(neighbour, cell);
      if (length >= best) return;
      best = length;
      parents_[cell] = neighbour;
    });
    lengths_[cell] = static_cast<float>(best);
  }

  void expand(CellIndex cell) {
    const CellIndex parent = parents_[cell];
    forNeighbours(cell, [&](CellIndex neighbour) {
      if (closed_[neighbour] != 0) return;
      const auto length = static_cast<float>(lengths_[parent] + distance(parent, neighbour));
      if (length >= lengths_[neighbour]) return;
      lengths_[neighbour] = length;
      parents_[neighbour] = parent;
      push(neighbour);
    });
  }

  /// Whether all cells between the two middles are free, both cells beside a corner that the line meets included.
  bool isVisible(CellIndex from, CellIndex to) const {
    const long across = std::abs(to.column - from.column);
    const long up = std::abs(to.row - from.row);
    const int step_across = to.column > from.column ? 1 : -1;
    const int step_up = to.row > from.row ? 1 : -1;
    CellIndex cell = from;
    long columns = 0;
    long rows = 0;
    while (columns < across || rows < up) {
      // Which border is met first: of the next column at (2 columns + 1) / across of the path, of the next row
      // likewise.
      const long order = (2 * columns + 1) * up - (2 * rows + 1) * across;
      if (order == 0 &&
          (!isFree({cell.column + step_across, cell.row}) || !isFree({cell.column, cell.row + step_up}))) {
        return false;
      }
      if (order <= 0) {
        cell.column += step_across;
        ++columns;
      }
      if (order >= 0) {
        cell.row += step_up;
        ++rows;
      }
      if (!isFree(cell)) return false;
    }
    return true;
  }

  const DistanceField& distances_;
  const GeodesicField& to_goal_;
  double resolution_;
  double clearance_;
  CellField<float> lengths_;  ///< cells, from the start
  CellField<CellIndex> parents_;
  CellField<char> closed_;
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open_;
};

}  // namespace

double shortestPath(const DistanceField& distances, const GeodesicField& to_goal, const OccupancyGrid& grid,
                    CellIndex start, CellIndex goal, double clearance) {
  if (!std::isfinite(to_goal.at(start))) return kUnreachable;
  return LazyThetaStar(distances, to_goal, grid, clearance).search(start, goal) * grid.resolution();
}

}  // namespace lstm_planner
