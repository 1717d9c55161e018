#pragma once

#include <cstddef>

#include "lstm_planner/grid_world/agent/area_planner.hpp"
#include "lstm_planner/grid_world/agent/greedy_agent.hpp"
#include "lstm_planner/grid_world/agent/grid_escape.hpp"

namespace lstm_planner {

/// How the remembered path is searched for, and when boundaries are followed instead.
struct GridGuideParameters {
  CornerCutting corner_cutting = CornerCutting::kForbidden;
  AreaPlannerParameters area;
  /// Steps, all together, with no path between the remembered walls, before boundaries are followed.
  int most_steps_without_path = 50;
  /// Steps without seeing anything new, before boundaries are followed: the length of the path that was planned when
  /// something new was last seen, times most_times_planned, plus most_steps_more.
  double most_times_planned = 2.0;
  int most_steps_more = 200;
  /// Of the boundary following. Here a place is new if something is seen there for the first time.
  GridEscapeParameters last_resort = {{}, 3000, 50000, 40.0};
};

/// Knows a way to the goal: the path between the remembered walls (AreaPlanner). That path is certain to arrive only if
/// the memory is right; if it is not, boundaries are followed (GridEscape). So an agent that follows it, or leaves it
/// for a bounded length, arrives if there is a path. It is an agent by itself: the shipped one without its network.
class GridGuide : public GridAgent {
 public:
  /// Throws std::invalid_argument for parameters out of range.
  explicit GridGuide(const GridGuideParameters& parameters = {});

  void start(CellIndex start, CellIndex goal) override;
  /// To be called once before each step, also if something else decides the step.
  void observe(const GridObservation& observation) override;
  int decide() override { return direction_; }
  /// kSearch: the remembered path leads; kBoundary: boundary following; kGreedy: no path is known at the moment.
  GridLeader leader() const override { return leader_; }
  /// AreaPlanner::regretOf(); only while the remembered path leads.
  double regretOf(int direction) { return area_.regretOf(direction); }

  std::size_t peakBytes() const override;
  std::size_t expandedCells() const override { return area_.expandedCells(); }

 private:
  void followArea(const GridObservation& observation);
  bool isStuck();

  GridGuideParameters parameters_;
  AreaPlanner area_;
  GridEscape last_resort_;
  GreedyAgent greedy_;
  int steps_without_path_ = 0;
  double steps_left_ = 0.0;  ///< without anything new to see
  int direction_ = kNoPath;
  GridLeader leader_ = GridLeader::kSearch;
};

}  // namespace lstm_planner
