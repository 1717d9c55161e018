#include "lstm_planner/grid_world/agent/area_planner.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstdlib>

#include "grid_world/agent/moves_between.hpp"
#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {
namespace {

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
  bool isTarget(CellIndex place) const { return goal_inside ? place == goal_in_window : Search::atEdge(place); }
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
      move(direction, costOf(passage, diagonal ? kDiagonalFifths : kStraightFifths, weight));
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
      move(direction, direction % 2 != 0 ? kDiagonalFifths : kStraightFifths);
    }
  }
};

AreaPlanner::AreaPlanner(const AreaPlannerParameters& parameters) : parameters_(parameters) {
  static_assert(SeenGrid::kSide == Search::kSide && BlockGraph::kSide == Search::kSide, "one search serves both");
  const auto checkNotNegative = [](const char* name, double value) {
    checkParameter(value >= 0.0, name, value, "a number that is not negative");
  };
  checkNotNegative("far_weight", parameters.far_weight);
  checkParameter(parameters.most_far_weight >= 0.0 && parameters.most_far_weight <= 30.0, "most_far_weight",
                 parameters.most_far_weight, "a number from 0 to 30");
  checkParameter(parameters.doubtful_cost >= 0.0 && parameters.doubtful_cost <= 150.0, "doubtful_cost",
                 parameters.doubtful_cost, "a number from 0 to 150");
  path_.reserve(kLongestPath);
  blocks_.reserve(kMostBlocks);
}

void AreaPlanner::restart(CellIndex agent, CellIndex start) {
  seen_.restart(agent);
  graph_.restart(agent);
  search_.resetCounter();
  start_ = start;
  path_.clear();
  path_step_ = 0;
  steps_since_blocks_ = kStepsOfPlan;
}

void AreaPlanner::takeWalls(const RollingGrid& walls) {
  seen_.takeWalls(walls);
  graph_.learn(seen_);
}

void AreaPlanner::observe(const GridObservation& observation) {
  now_ = observation;
  seen_.observe(observation);
  graph_.update(seen_, observation.cell, observation.goal);
}

int AreaPlanner::plan() {
  ++steps_since_plan_;
  ++steps_since_blocks_;
  const bool follows = path_step_ < path_.size() && expected_ == now_.cell && steps_since_plan_ < kStepsOfPlan;
  if (!follows || !isPathFree()) planAnew();
  if (path_step_ >= path_.size()) return kNoPath;
  const int direction = path_[path_step_++];
  expected_ = cellBeside(now_.cell, direction);
  return direction;
}

bool AreaPlanner::isBlocked(CellIndex cell) const {
  const SeenGrid::Cell is = seen_.at(cell);
  return is == SeenGrid::Cell::kWall || (is == SeenGrid::Cell::kDoubtful && !path_is_doubtful_);
}

bool AreaPlanner::isPathFree() const {
  CellIndex cell = now_.cell;
  for (std::size_t step = path_step_; step < path_.size(); ++step) {
    const CellIndex next = cellBeside(cell, path_[step]);
    if (isBlocked(next)) return false;
    if (parameters_.corner_cutting == CornerCutting::kForbidden &&
        (isBlocked({next.column, cell.row}) || isBlocked({cell.column, next.row}))) {
      return false;
    }
    cell = next;
  }
  return true;
}

void AreaPlanner::planAnew() {
  path_.clear();
  path_step_ = 0;
  steps_since_plan_ = 0;
  for (std::size_t direction = 0; direction < kGridRayCount; direction += 2) {
    from_agent_[direction] = graph_.passageFrom(seen_, now_.cell, direction);
  }
  if (keepBlocks()) planCells();
  if (!path_.empty()) return;
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

/// `along`: so many of the blocks are not to be left; 0 where it may go anywhere.
bool AreaPlanner::planCellsTo(CellIndex block, bool through_doubtful, std::size_t along) {
  const bool at_goal = block == blockOf(now_.goal);
  const CellIndex first = firstCellOf(block);
  unsigned piece = graph_.pieceOf(seen_, block, through_doubtful);
  if (at_goal) piece = 1u << ((now_.goal.row - first.row) * kBlockSide + now_.goal.column - first.column);
  CellWorld world{seen_, parameters_.corner_cutting, through_doubtful, block, piece == 0 ? 0xffffu : piece};
  world.anywhere = along == 0;
  CellIndex allowed = blockOf(now_.cell);
  world.allowAround(allowed);
  for (std::size_t i = 0; i < along; ++i) {
    allowed = blockBehind(allowed, blocks_[i]);
    world.allowAround(allowed);
  }
  if (!search_.find(world, inWindow(now_.cell, seen_.origin()))) return false;
  search_.path(kLongestPath, &path_);
  path_is_doubtful_ = through_doubtful;
  return !path_.empty();
}

std::size_t AreaPlanner::bytes() const {
  return sizeof(*this) + seen_.bytes() + BlockGraph::bytes() + Search::bytes() + kLongestPath + kMostBlocks;
}

}  // namespace lstm_planner
