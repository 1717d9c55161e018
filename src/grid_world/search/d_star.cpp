#include "grid_world/search/d_star.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "grid_world/search/possible_moves.hpp"

// The names h, k, b, X (here x), Y (here y), k_old and the states' tags are the paper's. Where the thesis's print
// differs, the paper's conditions stand here:
// - Algorithm 2 ends when PROCESS-STATE does not return -1; the paper goes on until k_min reaches the robot's h.
// - Algorithm 6, lines 6 and 35: GET-MIN is GET-KMIN.
// - Algorithm 6, line 30 repeats the condition of line 28, h(y) > h(x) + c(x, y); the paper has h(x) > h(y) + c(y, x).
// - Algorithm 7, line 4 repeats t(x) = NEW; it is t(x) = OPEN.
// - The text calls x a LOWER state if k(x) > h(x), which cannot be; it is k(x) = h(x).

namespace lstm_planner {

struct DStar::Later {
  bool operator()(const Open& a, const Open& b) const { return a.k > b.k; }
};

DStar::DStar(int columns, int rows, CellIndex goal, CornerCutting corner_cutting)
    : columns_(columns), rows_(rows), corner_cutting_(corner_cutting) {
  if (!contains(goal)) {
    throw std::invalid_argument("the goal (column " + std::to_string(goal.column) + ", row " +
                                std::to_string(goal.row) + ") is outside the map of " + std::to_string(columns) +
                                " x " + std::to_string(rows) + " cells");
  }
  tile_columns_ = (static_cast<std::size_t>(columns) + kTileSide - 1) / kTileSide;
  tiles_.resize(tile_columns_ * ((static_cast<std::size_t>(rows) + kTileSide - 1) / kTileSide));
  insert(goal, state(goal), 0);
}

const DStar::State* DStar::find(CellIndex cell) const {
  if (!contains(cell)) return nullptr;
  const Tile* tile = tiles_[tileOf(cell)].get();
  return tile == nullptr ? nullptr : &(*tile)[placeInTile(cell)];
}

DStar::State& DStar::state(CellIndex cell) {
  std::unique_ptr<Tile>& tile = tiles_[tileOf(cell)];
  if (tile == nullptr) {
    tile = std::make_unique<Tile>();
    ++tile_count_;
  }
  return (*tile)[placeInTile(cell)];
}

bool DStar::passable(CellIndex cell) const {
  const State* known = find(cell);
  return known == nullptr ? contains(cell) : known->passable;
}

MoveCost DStar::costToGoal(CellIndex cell) const {
  const State* known = find(cell);
  return known == nullptr ? kUnreachable : known->h;
}

bool DStar::movePossible(CellIndex cell, int direction) const {
  if (!passable(cell) || !passable(cellBeside(cell, direction))) return false;
  if (direction % 2 == 0 || corner_cutting_ == CornerCutting::kAllowed) return true;
  return passable(cellBeside(cell, direction - 1)) && passable(cellBeside(cell, (direction + 1) % kGridMoveCount));
}

DStar::Neighbours DStar::neighboursOf(CellIndex cell) {
  Neighbours neighbours;
  std::array<bool, kGridMoveCount> passable_around{};
  for (std::size_t i = 0; i < kGridMoveCount; ++i) {
    const CellIndex beside = cellBeside(cell, static_cast<int>(i));
    if (!contains(beside)) continue;
    neighbours.states[i] = &state(beside);
    passable_around[i] = neighbours.states[i]->passable;
  }
  const bool enterable = state(cell).passable;
  const std::array<bool, kGridMoveCount> possible = possibleMoves(passable_around, corner_cutting_);
  for (std::size_t i = 0; i < kGridMoveCount; ++i) {
    neighbours.costs[i] = enterable && possible[i] ? moveCost(static_cast<int>(i)) : kUnreachable;
  }
  return neighbours;
}

/// Algorithm 7. States without a path have nothing to tell their neighbours, and stay off the list.
void DStar::insert(CellIndex cell, State& x, MoveCost h_new) {
  MoveCost k = h_new;
  if (x.tag == Tag::kOpen) k = std::min(x.k, h_new);
  if (x.tag == Tag::kClosed) k = std::min(x.h, h_new);
  if (k >= kUnreachable) return;
  const bool listed = x.tag == Tag::kOpen && x.k == k;
  x.h = h_new;
  x.k = k;
  x.tag = Tag::kOpen;
  if (listed) return;
  open_.push_back({k, cell});
  std::push_heap(open_.begin(), open_.end(), Later{});
  most_open_ = std::max(most_open_, open_.size());
}

/// The second half of Algorithm 3.
void DStar::insertAgain(CellIndex cell) {
  if (!contains(cell)) return;
  State& x = state(cell);
  if (x.tag == Tag::kClosed) insert(cell, x, x.h);
}

void DStar::setPassable(CellIndex cell, bool passable) {
  if (this->passable(cell) == passable) return;
  struct Move {
    CellIndex from;
    int direction;
    bool was_possible;
  };
  std::array<Move, kGridMoveCount + kGridMoveCount / 2> moves;
  std::size_t count = 0;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    moves[count++] = {cell, direction, movePossible(cell, direction)};
    if (direction % 2 != 0) continue;
    // The diagonal move from one straight neighbour to the next passes the cell.
    const CellIndex beside = cellBeside(cell, direction);
    const int past = (direction + 3) % kGridMoveCount;
    moves[count++] = {beside, past, movePossible(beside, past)};
  }
  state(cell).passable = passable;
  for (const Move& move : moves) {
    if (movePossible(move.from, move.direction) == move.was_possible) continue;
    insertAgain(move.from);
    insertAgain(cellBeside(move.from, move.direction));
  }
}

/// Algorithms 4 and 5.
MoveCost DStar::leastKey() {
  while (!open_.empty()) {
    const State& x = state(open_.front().cell);
    if (x.tag == Tag::kOpen && x.k == open_.front().k) return x.k;
    std::pop_heap(open_.begin(), open_.end(), Later{});
    open_.pop_back();
  }
  return kUnreachable;
}

/// Algorithm 6, for a list that is not empty.
void DStar::processState() {
  const MoveCost k_old = leastKey();
  const CellIndex cell = open_.front().cell;
  State& x = state(cell);
  x.tag = Tag::kClosed;
  ++processed_;
  const Neighbours neighbours = neighboursOf(cell);
  if (k_old < x.h) findBetterPath(x, neighbours, k_old);
  if (k_old == x.h) {
    lower(cell, x, neighbours);
  } else {
    raise(cell, x, neighbours, k_old);
  }
}

/// Lines 8-15: neighbours whose paths are optimal already may lead x better than its own next cell.
void DStar::findBetterPath(State& x, const Neighbours& neighbours, MoveCost k_old) {
  for (std::size_t i = 0; i < kGridMoveCount; ++i) {
    const State* y = neighbours.states[i];
    if (y == nullptr || y->h > k_old || x.h <= y->h + neighbours.costs[i]) continue;
    x.back = static_cast<std::int8_t>(i);
    x.h = y->h + neighbours.costs[i];
  }
}

/// Lines 16-22: x's path is optimal; neighbours that go through it, or had better, take its cost.
void DStar::lower(CellIndex cell, State& x, const Neighbours& neighbours) {
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    State* y = neighbours.states[static_cast<std::size_t>(direction)];
    if (y == nullptr) continue;
    const MoveCost through_x = std::min(kUnreachable, x.h + neighbours.costs[static_cast<std::size_t>(direction)]);
    const bool follows = y->back == opposite(direction);
    if (y->tag != Tag::kNew && !(follows ? y->h != through_x : y->h > through_x)) continue;
    if (y->tag == Tag::kNew && through_x >= kUnreachable) continue;
    y->back = static_cast<std::int8_t>(opposite(direction));
    insert(cellBeside(cell, direction), *y, through_x);
  }
}

/// Lines 23-33: x's path has become longer. What goes through it learns so; what could be shortened by it, or could
/// shorten it, is put on the list and waits until its own path is known to be optimal.
void DStar::raise(CellIndex cell, State& x, const Neighbours& neighbours, MoveCost k_old) {
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    State* y = neighbours.states[static_cast<std::size_t>(direction)];
    if (y == nullptr) continue;
    const MoveCost cost = neighbours.costs[static_cast<std::size_t>(direction)];
    const MoveCost through_x = std::min(kUnreachable, x.h + cost);
    const bool follows = y->back == opposite(direction);
    if (y->tag == Tag::kNew ? through_x < kUnreachable : follows && y->h != through_x) {
      y->back = static_cast<std::int8_t>(opposite(direction));
      insert(cellBeside(cell, direction), *y, through_x);
    } else if (!follows && y->h > through_x) {
      insert(cell, x, x.h);
    } else if (!follows && x.h > y->h + cost && y->tag == Tag::kClosed && y->h > k_old) {
      insert(cellBeside(cell, direction), *y, y->h);
    }
  }
}

bool DStar::plan(CellIndex robot) {
  while (leastKey() < costToGoal(robot)) processState();
  return costToGoal(robot) < kUnreachable;
}

int DStar::firstMove(CellIndex robot) const { return costToGoal(robot) < kUnreachable ? find(robot)->back : kNoBack; }

std::size_t DStar::peakBytes() const {
  return tile_count_ * sizeof(Tile) + tiles_.size() * sizeof(tiles_.front()) + most_open_ * sizeof(Open);
}

}  // namespace lstm_planner
