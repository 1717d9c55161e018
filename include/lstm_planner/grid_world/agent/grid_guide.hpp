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
  /// Steps for which there may be no path at all in what is remembered, before boundaries are followed.
  int most_steps_without_path = 50;
  /// And the steps that may pass without anything new to see: so many times the path that was planned when something
  /// new was seen, and so many more.
  double most_times_planned = 2.0;
  int most_steps_more = 200;
  /// Of the boundary following. Here a place is new where something is seen for the first time.
  GridEscapeParameters last_resort = {{}, 3000, 50000, 40.0};
};

/// Knows the way to the goal: the path between what is remembered of the walls (AreaPlanner), which is certain to
/// arrive only where that memory is right; where it is not, boundary following (GridEscape). So whoever follows it, or
/// strays from it by a bounded length, arrives wherever there is a path. It is an agent by itself: all that the shipped
/// one has but for its network.
class GridGuide : public GridAgent {
 public:
  /// Throws std::invalid_argument for parameters out of range.
  explicit GridGuide(const GridGuideParameters& parameters = {});

  void start(CellIndex start, CellIndex goal) override;
  /// Once before each step, whoever makes it.
  void observe(const GridObservation& observation) override;
  int decide() override { return direction_; }
  /// kSearch: the remembered path leads; kBoundary; kGreedy where no path is known for a while.
  GridLeader leader() const override { return leader_; }
  /// AreaPlanner::regretOf(), where the remembered path leads.
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
