#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "lstm_planner/grid/passable_grid.hpp"
#include "lstm_planner/grid_world/search/grid_path.hpp"

namespace lstm_planner {

/// D* (A. Stentz, Optimal and Efficient Path Planning for Partially-Known Environments, ICRA 1994; thesis 1.3.2,
/// Algorithms 2-8): shortest paths to one goal on a map that changes while the robot drives. It searches from the goal,
/// and a changed cell costs the repair of what depended on it.
///
/// Every cell is taken for passable until setPassable() says otherwise; cells outside never are. Memory is taken in
/// square tiles for the part of the map that the search has touched, and grows with it: at most 24 bytes a cell and
/// the open list.
class DStar {
 public:
  /// Of a size that PassableGrid allows. Throws std::invalid_argument for a goal outside.
  DStar(int columns, int rows, CellIndex goal, CornerCutting corner_cutting = CornerCutting::kForbidden);

  bool contains(CellIndex cell) const {
    return cell.column >= 0 && cell.row >= 0 && cell.column < columns_ && cell.row < rows_;
  }
  /// As far as the map is known.
  bool passable(CellIndex cell) const;

  /// What the robot has found out; MODIFY-COST for every move that depends on the cell. `cell` must be inside.
  void setPassable(CellIndex cell, bool passable);

  /// Repairs the paths that matter for a robot in this cell, which must be inside. Returns whether there is a path to
  /// the goal, with what is known.
  bool plan(CellIndex robot);

  /// The direction of the first move of the shortest path that plan() found from this cell, or along which it lies; -1
  /// at the goal and where there is no path.
  int firstMove(CellIndex robot) const;

  /// Calls of PROCESS-STATE that took a state from the open list.
  std::size_t processedStates() const { return processed_; }
  /// Tiles, their directory, and the open list at its longest.
  std::size_t peakBytes() const;

 private:
  /// Longer than any path, and two of them still add up without overflow.
  static constexpr MoveCost kUnreachable = std::numeric_limits<MoveCost>::max() / 4;
  static constexpr std::size_t kTileSide = 16;
  static constexpr std::int8_t kNoBack = -1;

  enum class Tag : std::uint8_t { kNew, kOpen, kClosed };

  struct State {
    MoveCost h = kUnreachable;   ///< cost of the path to the goal
    MoveCost k = kUnreachable;   ///< the least h since it was put on the open list
    std::int8_t back = kNoBack;  ///< b, the direction of the next cell on the path
    Tag tag = Tag::kNew;
    bool passable = true;
  };
  using Tile = std::array<State, kTileSide * kTileSide>;

  struct Open {
    MoveCost k;
    CellIndex cell;
  };
  struct Later;

  /// A cell's neighbours (nullptr outside) and what a move between the cell and each of them costs, either way.
  struct Neighbours {
    std::array<State*, kGridMoveCount> states{};
    std::array<MoveCost, kGridMoveCount> costs{};
  };

  std::size_t tileOf(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row) / kTileSide * tile_columns_ +
           static_cast<std::size_t>(cell.column) / kTileSide;
  }
  static std::size_t placeInTile(CellIndex cell) {
    return static_cast<std::size_t>(cell.row) % kTileSide * kTileSide +
           static_cast<std::size_t>(cell.column) % kTileSide;
  }
  const State* find(CellIndex cell) const;  ///< nullptr where the search has not been
  State& state(CellIndex cell);
  MoveCost costToGoal(CellIndex cell) const;
  bool movePossible(CellIndex cell, int direction) const;
  Neighbours neighboursOf(CellIndex cell);

  void insert(CellIndex cell, State& x, MoveCost h_new);
  void insertAgain(CellIndex cell);
  MoveCost leastKey();
  void processState();
  static void findBetterPath(State& x, const Neighbours& neighbours, MoveCost k_old);
  void lower(CellIndex cell, State& x, const Neighbours& neighbours);
  void raise(CellIndex cell, State& x, const Neighbours& neighbours, MoveCost k_old);

  int columns_;
  int rows_;
  CornerCutting corner_cutting_;
  std::size_t tile_columns_;
  std::vector<std::unique_ptr<Tile>> tiles_;
  std::vector<Open> open_;  ///< a heap; an entry whose state went on with another key stays until it comes up
  std::size_t tile_count_ = 0;
  std::size_t most_open_ = 0;
  std::size_t processed_ = 0;
};

}  // namespace lstm_planner
