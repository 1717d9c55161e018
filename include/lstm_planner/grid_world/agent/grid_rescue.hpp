#pragma once

#include <cstddef>
#include <memory>

#include "lstm_planner/grid_world/agent/area_planner.hpp"
#include "lstm_planner/grid_world/agent/greedy_agent.hpp"
#include "lstm_planner/grid_world/agent/grid_escape.hpp"
#include "lstm_planner/grid_world/agent/grid_progress_watch.hpp"

namespace lstm_planner {

/// When the rescue takes over, and when boundaries are followed instead.
struct GridRescueParameters {
  CornerCutting corner_cutting = CornerCutting::kForbidden;
  /// Steps without having got nearer to the goal than ever, nor to a place never seen, before the rescue takes over.
  int patience = 150;
  /// The same, new places or not.
  int long_patience = 2000;
  /// Cells by which the path between the remembered walls may be longer than the crow flies.
  double most_detour = 15.0;
  AreaPlannerParameters area;
  /// Steps for which the area planner may find no path at all, before boundaries are followed.
  int most_steps_without_path = 50;
  /// And the steps for which it may lead without anything new to see: so many times the path that it planned when it
  /// saw something new, and so many more.
  double most_times_planned = 2.0;
  int most_steps_more = 200;
  /// Of the boundary following. Here a place is new where something is seen for the first time.
  GridEscapeParameters last_resort = {{}, 3000, 50000, 40.0};
};

/// Brings an agent to the goal that has got into difficulties: it takes over when the agent makes no progress, or when
/// the path round what it remembers is long, and leads until the end.
///
/// It searches in a memory of the whole area (AreaPlanner), which is certain to arrive only where that memory is right:
/// where it is not, boundary following takes over (GridEscape), and so the two together arrive wherever there is a
/// path.
///
/// Its memory is needed from the moment when it takes over: an agent that drops its own memory at that moment needs no
/// more than the larger of the two.
class GridRescue {
 public:
  /// Throws std::invalid_argument for parameters out of range.
  explicit GridRescue(const GridRescueParameters& parameters = {});

  /// A new episode; the rescue does not lead.
  void start(CellIndex start);

  /// Before each step while the agent leads: whether the rescue should take over. `detour`: cells by which the path
  /// that the agent knows is longer than the crow flies, 0 where it knows none.
  bool isNeeded(const GridObservation& observation, bool new_place, double detour);

  /// From now on it leads. `walls`: what the agent remembers of them, or null.
  void takeOver(const GridObservation& observation, const RollingGrid* walls);

  bool active() const { return area_ != nullptr; }

  /// Before each step after takeOver().
  void observe(const GridObservation& observation);
  /// The direction to move in, or kNoPath when the goal cannot be reached. Only while active.
  int decide() const { return direction_; }
  GridLeader leader() const { return leader_; }

  std::size_t expandedCells() const { return area_ ? area_->expandedCells() : 0; }
  /// Besides the object itself.
  std::size_t bytes() const;

 private:
  void followArea(const GridObservation& observation);
  bool isStuck();

  GridRescueParameters parameters_;
  GridProgressWatch watch_;
  CellIndex start_;
  std::unique_ptr<AreaPlanner> area_;
  std::unique_ptr<GridEscape> last_resort_;
  GreedyAgent greedy_;
  int steps_without_path_ = 0;
  double steps_left_ = 0.0;  ///< without anything new to see
  int direction_ = kNoPath;
  GridLeader leader_ = GridLeader::kSearch;
};

}  // namespace lstm_planner
