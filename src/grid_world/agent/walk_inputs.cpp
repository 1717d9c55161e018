#include "lstm_planner/grid_world/agent/walk_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid_world/agent/along_ray.hpp"

namespace lstm_planner {
namespace {

constexpr float kDetourScale = 32.0f;  ///< cells; an opening with a longer one counts as none
constexpr float kCompareScale = 16.0f;
constexpr float kMostLogCells = 10.0f;  ///< log2 of the longest walk that is told apart

float logarithmic(float cells) { return std::min(1.0f, std::log2(1.0f + std::max(0.0f, cells)) / kMostLogCells); }

/// Which of two is the longer one, where there are both; infinite: there is none.
float compared(float behind, float ahead) {
  if (!std::isfinite(ahead)) return std::isfinite(behind) ? -1.0f : 0.0f;
  return std::isfinite(behind) ? std::tanh((behind - ahead) / kCompareScale) : 1.0f;
}

}  // namespace

WalkInputs::WalkInputs(const WalkMemory& memory, const GridObservation& observation, int previous_direction) {
  noteHands(observation.ranges, previous_direction);
  const float ahead = noteRays(memory);
  float behind = std::numeric_limits<float>::infinity();
  float walk = 0.0f;
  if (const auto& best = memory.openings.bestBehind()) {
    const CellIndex place{best->column, best->row};
    walk = memory.openings.walkTo(*best);
    behind = walk + octileCells(place, observation.goal) - octileCells(observation.cell, observation.goal);
    const float columns = static_cast<float>(place.column - observation.cell.column);
    const float rows = static_cast<float>(place.row - observation.cell.row);
    const float length = std::max(1.0f, std::hypot(columns, rows));
    behind_cos = columns / length;
    behind_sin = rows / length;
  }
  scalars = {logarithmic(memory.start_distance.here()), logarithmic(ahead), logarithmic(behind), logarithmic(walk),
             compared(behind, ahead)};
}

/// Returns the least detour through an opening that a ray shows.
float WalkInputs::noteRays(const WalkMemory& memory) {
  const float here = memory.start_distance.here();
  const auto nearer = [here](const std::optional<float>& distance, int scale) {
    return distance ? std::clamp((here - *distance) / static_cast<float>(scale), -1.0f, 1.0f) : 0.0f;
  };
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t ray = 0; ray < kGridRayCount; ++ray) {
    const StartDistance::Ray& seen = memory.start_distance.rays()[ray];
    const std::optional<float>& detour = memory.openings.detours()[ray];
    rays[kNearer][ray] = nearer(seen.near, StartDistance::kNearProbe);
    rays[kNearerFar][ray] = nearer(seen.far, StartDistance::kFarProbe);
    rays[kOpening][ray] = detour ? 1.0f - std::clamp(*detour / kDetourScale, 0.0f, 1.0f) : 0.0f;
    if (detour) least = std::min(least, *detour);
  }
  return least;
}

/// Beside an obstacle: the first possible move from the one hand's side, and from the other's.
void WalkInputs::noteHands(const GridRanges& ranges, int previous_direction) {
  const bool at_wall = std::any_of(ranges.begin(), ranges.end(), [](int range) { return range <= 1; });
  if (!at_wall || previous_direction < 0) return;
  constexpr int kTurnToHand = 3;  // eighths
  for (const int hand : {1, -1}) {
    for (int turn = kTurnToHand; turn > kTurnToHand - kGridMoveCount; --turn) {
      const int direction = (previous_direction + hand * turn) & 7;
      if (!movePossible(ranges, direction, CornerCutting::kForbidden)) continue;
      rays[hand > 0 ? kLeftHand : kRightHand][static_cast<std::size_t>(direction)] = 1.0f;
      break;
    }
  }
}

}  // namespace lstm_planner
