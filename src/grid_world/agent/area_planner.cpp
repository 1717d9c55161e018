#include "lstm_planner/grid_world/agent/area_planner.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/grid/passable_grid.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {
namespace {

/// The moves that walls beside a cell leave, both with bit d for direction d.
unsigned movesBetween(unsigned walls, CornerCutting corner_cutting) {
  constexpr unsigned kDiagonals = 0xaa;
  unsigned blocked = walls;
  if (corner_cutting == CornerCutting::kForbidden) {
    blocked |= (walls << 1 | walls >> 7 | walls >> 1 | walls << 7) & kDiagonals;
  }
  return ~blocked & 0xff;
}

using Passage = BlockGraph::Passage;

// Costs are in fifths of a block, or of a cell.
constexpr int kClosedCost = 100;     ///< what looks closed is tried last
constexpr double kShortPath = 40.0;  ///< cells; a shorter path from start to goal counts as one of this length
constexpr int kSight = 48;           ///< cells ahead that are planned from cell to cell
constexpr int kStepsOfPlan = 24;     ///< after which it is made anew
constexpr std::size_t kLongestPath = 64;
constexpr std::size_t kMostBlocks = 64;
constexpr std::size_t kBlocksBehind = 12;  ///< that are tried where the nearest cannot be reached

/// Counted from there.
CellIndex inWindow(CellIndex place, CellIndex origin) { return {place.column - origin.column, place.row - origin.row}; }
CellIndex outOfWindow(CellIndex place, CellIndex origin) {
  return {origin.column + place.column, origin.row + place.row};
}

int costOfMove(std::size_t direction) { return direction % 2 != 0 ? kDiagonalFifths : kStraightFifths; }

double crowFlight(CellIndex a, CellIndex b) { return octileDistance(a, b).length(); }

/// On a path of blocks: the direction to the next one, and the passage as it was when the path was planned.
std::uint8_t blockMove(std::size_t direction, Passage passage) {
  return static_cast<std::uint8_t>(direction | static_cast<std::size_t>(passage) << 3);
}
std::size_t directionOf(std::uint8_t move) { return move & 7u; }
Passage passageOf(std::uint8_t move) { return static_cast<Passage>(move >> 3); }
CellIndex blockBehind(CellIndex block, std::uint8_t move) {
  return cellBeside(block, static_cast<int>(directionOf(move)));
}

bool isWorse(Passage now, Passage before) { return now > Passage::kFree && now > before; }

CellIndex middleOf(CellIndex block) {
  const CellIndex first = firstCellOf(block);
  return {first.column + kBlockSide / 2, first.row + kBlockSide / 2};
}

}  // namespace

/// From block to block.
struct AreaPlanner::BlockWorld {
  const BlockGraph& graph;
  const AreaPlannerParameters& parameters;
  std::array<Passage, kGridRayCount> from_agent;  ///< in the straight directions
  CellIndex agent_block;
  CellIndex start;
  CellIndex goal;
  bool through_closed;
  double straight_length = std::max(kShortPath, crowFlight(start, goal));
  CellIndex goal_block = blockOf(goal);
  bool goal_inside = graph.contains(goal_block);

  CellIndex goal_in_window = inWindow(goal_block, graph.origin());

  int estimate(CellIndex place) const {
    return octileFifths(goal_in_window.column - place.column, goal_in_window.row - place.row);
  }
  bool isTarget(CellIndex place) const { return goal_inside ? place == goal_in_window : BoundedSearch::atEdge(place); }
  /// Of a block that was never seen, against one that was.
  double weightOf(CellIndex block) const {
    const CellIndex cell = middleOf(block);
    const double detour = (crowFlight(start, cell) + crowFlight(cell, goal)) / straight_length - 1.0;
    return 1.0 + std::clamp(parameters.far_weight * detour, 0.0, parameters.most_far_weight);
  }
  int costOf(Passage passage, int length, double weight) const {
    if (passage == Passage::kFree) return length;
    if (passage == Passage::kUnknown) return static_cast<int>(length * weight);
    if (passage == Passage::kClosed) return length + kClosedCost;
    return length + static_cast<int>(parameters.doubtful_cost * kStraightFifths / kBlockSide);
  }
  /// Of the passages around the corner, all of which have to be open.
  static Passage passageOnDiagonal(const BlockGraph::Surroundings& around, std::size_t direction) {
    const Passage first = around.out[direction - 1];
    const Passage then = around.then[direction];
    const Passage instead = around.out[(direction + 1) % kGridRayCount];
    const Passage afterwards = around.afterwards[direction];
    const Passage worst = std::max({first, then, instead, afterwards});
    if (worst > Passage::kFree) return Passage::kClosed;
    const bool free = (first == Passage::kFree && then == Passage::kFree) ||
                      (instead == Passage::kFree && afterwards == Passage::kFree);
    return free ? Passage::kFree : Passage::kUnknown;
  }
  BlockGraph::Surroundings around(CellIndex block) const {
    BlockGraph::Surroundings all = graph.around(block);
    if (block == agent_block) all.out = from_agent;
    return all;
  }
  static Passage passageTo(const BlockGraph::Surroundings& around, std::size_t direction) {
    return direction % 2 != 0 ? passageOnDiagonal(around, direction) : around.out[direction];
  }
  template <typename Move>
  void expand(CellIndex place, const Move& move) const {
    const CellIndex block = outOfWindow(place, graph.origin());
    const BlockGraph::Surroundings around_it = around(block);
    double weight = 0.0;  // worked out where it is needed
    for (std::size_t direction = 0; direction < kGridRayCount; ++direction) {
      const CellIndex next = cellBeside(block, static_cast<int>(direction));
      // Rows and columns of maps count from 0.
      if (next.column < 0 || next.row < 0) continue;
      const bool diagonal = direction % 2 != 0;
      const Passage passage = passageTo(around_it, direction);
      if (passage == Passage::kClosed && (diagonal || !through_closed)) continue;
      if (passage == Passage::kUnknown && weight == 0.0) weight = weightOf(block);
      move(direction, costOf(passage, costOfMove(direction), weight));
    }
  }
};

/// From cell to cell, into a piece of a block.
struct AreaPlanner::CellWorld {
  static constexpr int kBlocks = SeenGrid::kSide / kBlockSide + 1;
  using Blocks = std::bitset<static_cast<std::size_t>(kBlocks* kBlocks)>;

  const SeenGrid& seen;
  CornerCutting corner_cutting;
  bool through_doubtful;
  CellIndex block;
  unsigned piece;
  bool anywhere = false;
  Blocks along{};  ///< the blocks that it keeps to, unless anywhere

  std::size_t indexOf(CellIndex place) const {
    const CellIndex first = blockOf(seen.origin());
    return static_cast<std::size_t>((place.row - first.row) * kBlocks + place.column - first.column);
  }
  void allowAround(CellIndex middle) {
    const CellIndex first = blockOf(seen.origin());
    for (int row = middle.row - 1; row <= middle.row + 1; ++row) {
      for (int column = middle.column - 1; column <= middle.column + 1; ++column) {
        const bool inside =
            column >= first.column && row >= first.row && column < first.column + kBlocks && row < first.row + kBlocks;
        if (inside) along.set(indexOf({column, row}));
      }
    }
  }
  CellIndex target = inWindow(firstCellOf(block), seen.origin());

  int estimate(CellIndex place) const {
    const auto beside = [](int x, int low) { return std::max({0, low - x, x - low - (kBlockSide - 1)}); };
    return octileFifths(beside(place.column, target.column), beside(place.row, target.row));
  }
  bool isTarget(CellIndex place) const {
    const int column = place.column - target.column;
    const int row = place.row - target.row;
    if (column < 0 || row < 0 || column >= kBlockSide || row >= kBlockSide) return false;
    return (piece >> (row * kBlockSide + column) & 1u) != 0;
  }
  template <typename Move>
  void expand(CellIndex place, const Move& move) const {
    const CellIndex cell = outOfWindow(place, seen.origin());
    const unsigned moves = movesBetween(seen.wallsBeside(cell, through_doubtful), corner_cutting);
    for (std::size_t direction = 0; direction < kGridRayCount; ++direction) {
      if ((moves >> direction & 1u) == 0) continue;
      if (!anywhere && !along[indexOf(blockOf(cellBeside(cell, static_cast<int>(direction))))]) continue;
      move(direction, costOfMove(direction));
    }
  }
};

/// From cell to cell, to the goal or the edge of the window.
struct AreaPlanner::NearWorld {
  const SeenGrid& seen;
  CornerCutting corner_cutting;
  CellIndex goal;

  int estimate(CellIndex place) const { return octileFifths(goal.column - place.column, goal.row - place.row); }
  bool isTarget(CellIndex place) const { return BoundedSearch::atEdge(place) || place == goal; }
  template <typename Move>
  void expand(CellIndex place, const Move& move) const {
    const unsigned moves = movesBetween(seen.wallsBeside(outOfWindow(place, seen.origin()), true), corner_cutting);
    for (std::size_t direction = 0; direction < kGridRayCount; ++direction) {
      if ((moves >> direction & 1u) != 0) move(direction, costOfMove(direction));
    }
  }
};

void AreaPlanner::Plan::goOn() {
  const std::size_t direction = moves[step++];
  from = cellBeside(from, static_cast<int>(direction));
  cost -= costOfMove(direction);
}

AreaPlanner::AreaPlanner(const AreaPlannerParameters& parameters) : parameters_(parameters) {
  static_assert(SeenGrid::kSide == BoundedSearch::kSide && BlockGraph::kSide == BoundedSearch::kSide,
                "one search serves both");
  checkNotNegative("far_weight", parameters.far_weight);
  checkParameter(parameters.most_far_weight >= 0.0 && parameters.most_far_weight <= 30.0, "most_far_weight",
                 parameters.most_far_weight, "a number from 0 to 30");
  checkParameter(parameters.doubtful_cost >= 0.0 && parameters.doubtful_cost <= 150.0, "doubtful_cost",
                 parameters.doubtful_cost, "a number from 0 to 150");
  checkNotNegative("most_detour", parameters.most_detour);
  plan_.moves.reserve(kLongestPath);
  other_.moves.reserve(kLongestPath);
  blocks_.reserve(kMostBlocks);
}

void AreaPlanner::restart(CellIndex start) {
  seen_.restart(start);
  graph_.restart(seen_, start);
  search_.resetCounter();
  start_ = start;
  plan_.clear();
  other_.clear();
  searches_blocks_ = false;
  through_doubtful_ = true;
}

void AreaPlanner::searchBlocks() {
  searches_blocks_ = true;
  steps_since_blocks_ = kStepsOfPlan;
  plan_.clear();
  other_.clear();
}

void AreaPlanner::observe(const GridObservation& observation) {
  now_ = observation;
  seen_.observe(observation);
  graph_.update(seen_, observation.cell, observation.goal);
}

int AreaPlanner::plan() {
  ++steps_since_plan_;
  ++steps_since_blocks_;
  followAgent();
  const bool is_recent = !searches_blocks_ || steps_since_plan_ < kStepsOfPlan;
  if (plan_.empty() || !is_recent || !isPathFree()) planAnew();
  if (!searches_blocks_ && isLong()) {
    searchBlocks();
    planAnew();
  }
  return plan_.empty() ? kNoPath : plan_.moves[plan_.step];
}

/// Keeps the path that starts where the agent has gone.
void AreaPlanner::followAgent() {
  if (!plan_.empty() && now_.cell != plan_.from) plan_.goOn();
  if (now_.cell != plan_.from) std::swap(plan_, other_);
  if (now_.cell != plan_.from) plan_.clear();
  other_.clear();
}

double AreaPlanner::regretOf(int direction) {
  if (plan_.empty()) return std::numeric_limits<double>::infinity();
  if (direction == plan_.moves[plan_.step]) return 0.0;
  const CellIndex next = cellBeside(now_.cell, direction);
  if (!findCells(next, &other_)) return std::numeric_limits<double>::infinity();
  const int longer = costOfMove(static_cast<std::size_t>(direction)) + other_.cost - plan_.cost;
  return static_cast<double>(std::max(0, longer)) / kStraightFifths;
}

bool AreaPlanner::isBlocked(CellIndex cell) const {
  const SeenGrid::Cell is = seen_.at(cell);
  return is == SeenGrid::Cell::kWall || (is == SeenGrid::Cell::kDoubtful && !through_doubtful_);
}

bool AreaPlanner::isPathFree() const {
  CellIndex cell = now_.cell;
  for (std::size_t step = plan_.step; step < plan_.moves.size(); ++step) {
    const CellIndex next = cellBeside(cell, plan_.moves[step]);
    if (isBlocked(next)) return false;
    if (parameters_.corner_cutting == CornerCutting::kForbidden &&
        (isBlocked({next.column, cell.row}) || isBlocked({cell.column, next.row}))) {
      return false;
    }
    cell = next;
  }
  return true;
}

/// The path among the near cells, or there is none.
bool AreaPlanner::isLong() const {
  const double detour = static_cast<double>(plan_.cost) / kStraightFifths - crowFlight(now_.cell, now_.goal);
  return plan_.empty() || detour > parameters_.most_detour;
}

void AreaPlanner::planAnew() {
  plan_.clear();
  steps_since_plan_ = 0;
  if (!searches_blocks_) {
    if (findCells(now_.cell, &plan_)) length_ = static_cast<double>(plan_.cost) / kStraightFifths;
    return;
  }
  for (std::size_t direction = 0; direction < kGridRayCount; direction += 2) {
    from_agent_[direction] = graph_.passageFrom(seen_, now_.cell, direction);
  }
  if (keepBlocks()) planCells();
  if (!plan_.empty()) return;
  if (planBlocks(false) || planBlocks(true)) planCells();
}

AreaPlanner::BlockWorld AreaPlanner::blockWorld(bool through_closed) const {
  return {graph_, parameters_, from_agent_, blockOf(now_.cell), start_, now_.goal, through_closed};
}

bool AreaPlanner::planBlocks(bool through_closed) {
  const BlockWorld world = blockWorld(through_closed);
  blocks_.clear();
  if (!search_.find(world, inWindow(blockOf(now_.cell), graph_.origin()))) return false;
  steps_since_blocks_ = 0;
  length_ = static_cast<double>(search_.cost()) * kBlockSide / kStraightFifths;
  search_.path(kMostBlocks, &blocks_);
  blocks_from_ = blockOf(now_.cell);
  CellIndex block = blocks_from_;
  for (std::uint8_t& move : blocks_) {
    const std::size_t direction = move;
    move = blockMove(direction, BlockWorld::passageTo(world.around(block), direction));
    block = blockBehind(block, move);
  }
  return true;
}

/// Whether the rest of the blocks' path is still the best one as far as is known: the agent is on it, and no passage
/// on it has become worse. (No other becomes better but those that turn out to be free.)
bool AreaPlanner::keepBlocks() {
  if (steps_since_blocks_ >= kStepsOfPlan) return false;
  auto next = blocks_.begin();
  CellIndex block = blocks_from_;
  while (block != blockOf(now_.cell)) {
    if (next == blocks_.end()) return false;
    block = blockBehind(block, *next++);
  }
  blocks_from_ = block;
  blocks_.erase(blocks_.begin(), next);
  const BlockWorld world = blockWorld(true);
  for (const std::uint8_t move : blocks_) {
    if (isWorse(BlockWorld::passageTo(world.around(block), directionOf(move)), passageOf(move))) return false;
    block = blockBehind(block, move);
  }
  return true;
}

void AreaPlanner::planCells() {
  // Up to the first passage that is not certainly open; where that is the very first one, through it.
  CellIndex block = blockOf(now_.cell);
  std::size_t count = 0;
  bool through_doubtful = false;
  for (; count < blocks_.size(); ++count) {
    const std::size_t direction = directionOf(blocks_[count]);
    const CellIndex next = blockBehind(block, blocks_[count]);
    const CellIndex middle = middleOf(next);
    if (std::max(std::abs(middle.column - now_.cell.column), std::abs(middle.row - now_.cell.row)) > kSight) break;
    const BlockGraph::Passage passage = count == 0 ? from_agent_[direction] : graph_.passage(block, direction);
    const bool open = direction % 2 != 0 || passage <= Passage::kFree;
    through_doubtful = !open;
    if (!open && count > 0) break;
    block = next;
    if (!open) {
      ++count;
      break;
    }
  }
  through_doubtful = through_doubtful && count == 1;
  if (planCellsTo(block, through_doubtful, count)) return;
  if (!through_doubtful && planCellsTo(block, true, count)) return;
  if (planCellsTo(block, true, 0)) return;
  const std::size_t last = std::min(blocks_.size(), count + kBlocksBehind);
  for (std::size_t i = count; i < last; ++i) {
    block = blockBehind(block, blocks_[i]);
    if (planCellsTo(block, true, 0)) return;
  }
}

bool AreaPlanner::planCellsTo(CellIndex block, bool through_doubtful, std::size_t along) {
  target_ = block;
  through_doubtful_ = through_doubtful;
  along_ = along;
  return findCells(now_.cell, &plan_) && !plan_.empty();
}

bool AreaPlanner::findCells(CellIndex from, Plan* plan) {
  if (searches_blocks_) return find(cellWorld(from), from, plan);
  return find(NearWorld{seen_, parameters_.corner_cutting, inWindow(now_.goal, seen_.origin())}, from, plan);
}

AreaPlanner::CellWorld AreaPlanner::cellWorld(CellIndex from) const {
  const bool at_goal = target_ == blockOf(now_.goal);
  const CellIndex first = firstCellOf(target_);
  unsigned piece = graph_.pieceOf(seen_, target_, through_doubtful_);
  if (at_goal) piece = 1u << ((now_.goal.row - first.row) * kBlockSide + now_.goal.column - first.column);
  CellWorld world{seen_, parameters_.corner_cutting, through_doubtful_, target_, piece == 0 ? 0xffffu : piece};
  world.anywhere = along_ == 0;
  world.allowAround(blockOf(from));
  CellIndex allowed = blocks_from_;
  world.allowAround(allowed);
  for (std::size_t i = 0; i < along_; ++i) {
    allowed = blockBehind(allowed, blocks_[i]);
    world.allowAround(allowed);
  }
  return world;
}

template <typename World>
bool AreaPlanner::find(const World& world, CellIndex from, Plan* plan) {
  plan->clear();
  if (!search_.find(world, inWindow(from, seen_.origin()))) return false;
  plan->from = from;
  plan->cost = search_.cost();
  plan->step = 0;
  search_.path(kLongestPath, &plan->moves);
  return true;
}

std::size_t AreaPlanner::bytes() const {
  return sizeof(*this) + seen_.bytes() + BlockGraph::bytes() + BoundedSearch::bytes() + 2 * kLongestPath + kMostBlocks;
}

}  // namespace lstm_planner
