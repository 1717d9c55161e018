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
      : distances_(distances), to_goal_(to_goal), grid_(grid), clearance_(clearance) {
    const std::size_t cells = static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.rows());
    lengths_.assign(cells, static_cast<float>(kUnreachable));
    parents_.resize(cells);
    closed_.assign(cells, 0);
  }

  /// In cells.
  double search(CellIndex start, CellIndex goal) {
    lengths_[offset(start)] = 0.0f;
    parents_[offset(start)] = start;
    push(start);
    while (!open_.empty()) {
      const CellIndex here = cellAt(open_.top().second);
      open_.pop();
      if (closed_[offset(here)] != 0) continue;
      makeSure(here);
      closed_[offset(here)] = 1;
      if (here == goal) return lengths_[offset(here)];
      expand(here);
    }
    return kUnreachable;
  }

 private:
  std::size_t offset(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(grid_.columns()) +
           static_cast<std::size_t>(cell.column);
  }
  CellIndex cellAt(std::size_t offset) const {
    const auto columns = static_cast<std::size_t>(grid_.columns());
    return {static_cast<int>(offset % columns), static_cast<int>(offset / columns)};
  }
  bool isFree(CellIndex cell) const {
    const float distance = distances_.at(cell);
    return distance > 0.0f && distance >= clearance_;
  }
  static double distance(CellIndex a, CellIndex b) { return std::hypot(a.column - b.column, a.row - b.row); }

  void push(CellIndex cell) {
    const double left = to_goal_.at(cell) / grid_.resolution() / kDetour;
    open_.push({lengths_[offset(cell)] + left, offset(cell)});
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
    if (isVisible(parents_[offset(cell)], cell)) return;
    double best = kUnreachable;
    forNeighbours(cell, [&](CellIndex neighbour) {
      if (closed_[offset(neighbour)] == 0) return;
      const double length = lengths_[offset(neighbour)] + distance(neighbour, cell);
      if (length >= best) return;
      best = length;
      parents_[offset(cell)] = neighbour;
    });
    lengths_[offset(cell)] = static_cast<float>(best);
  }

  void expand(CellIndex cell) {
    const CellIndex parent = parents_[offset(cell)];
    forNeighbours(cell, [&](CellIndex neighbour) {
      if (closed_[offset(neighbour)] != 0) return;
      const auto length = static_cast<float>(lengths_[offset(parent)] + distance(parent, neighbour));
      if (length >= lengths_[offset(neighbour)]) return;
      lengths_[offset(neighbour)] = length;
      parents_[offset(neighbour)] = parent;
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
  const OccupancyGrid& grid_;
  double clearance_;
  std::vector<float> lengths_;  ///< cells, from the start
  std::vector<CellIndex> parents_;
  std::vector<char> closed_;
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
