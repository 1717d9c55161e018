#pragma once

#include <cstddef>

#include "lstm_planner/common/parameter_check.hpp"
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
  explicit GridGuide(const GridGuideParameters& parameters = {})
      : parameters_(withCorners(parameters)),
        area_(parameters_.area),
        last_resort_(parameters_.last_resort),
        greedy_(parameters.corner_cutting) {
    checkNotNegative("most_steps_without_path", parameters.most_steps_without_path);
    checkNotNegative("most_times_planned", parameters.most_times_planned);
    checkNotNegative("most_steps_more", parameters.most_steps_more);
  }

  void start(CellIndex start, CellIndex /*goal*/) override {
    area_.restart(start);
    last_resort_.start();
    steps_without_path_ = 0;
    steps_left_ = 0.0;
  }
  /// To be called once before each step, also if something else decides the step.
  void observe(const GridObservation& observation) override {
    area_.observe(observation);
    last_resort_.observe(observation, area_.sawSomethingNew());
    if (!last_resort_.active()) followArea(observation);
    if (!last_resort_.active()) return;
    direction_ = last_resort_.decide();
    leader_ = GridLeader::kBoundary;
  }
  int decide() override { return direction_; }
  /// kSearch: the remembered path leads; kBoundary: boundary following; kGreedy: no path is known at the moment.
  GridLeader leader() const override { return leader_; }
  /// AreaPlanner::regretOf(); only while the remembered path leads.
  double regretOf(int direction) { return area_.regretOf(direction); }

  std::size_t peakBytes() const override {
    return sizeof(*this) - sizeof(area_) + area_.bytes() - sizeof(last_resort_) + last_resort_.peakBytes();
  }
  std::size_t expandedCells() const override { return area_.expandedCells(); }

 private:
  static GridGuideParameters withCorners(GridGuideParameters parameters) {
    parameters.area.corner_cutting = parameters.corner_cutting;
    parameters.last_resort.boundary.corner_cutting = parameters.corner_cutting;
    return parameters;
  }

  void followArea(const GridObservation& observation) {
    direction_ = area_.plan();
    // The shield: whatever is remembered, nothing is entered that the rays show to be blocked.
    if (direction_ != kNoPath && !movePossible(observation.ranges, direction_, parameters_.corner_cutting)) {
      direction_ = kNoPath;
    }
    leader_ = GridLeader::kSearch;
    if (isStuck()) {
      last_resort_.takeOver(observation);
    } else if (direction_ == kNoPath) {
      greedy_.observe(observation);
      direction_ = greedy_.decide();
      leader_ = GridLeader::kGreedy;
    }
  }
  bool isStuck() {
    steps_without_path_ += direction_ == kNoPath ? 1 : 0;
    const double most_steps = parameters_.most_times_planned * area_.length() + parameters_.most_steps_more;
    if (area_.sawSomethingNew()) steps_left_ = most_steps;
    steps_left_ -= 1.0;
    if (steps_left_ > 0.0 && steps_without_path_ <= parameters_.most_steps_without_path) return false;
    steps_without_path_ = 0;
    steps_left_ = most_steps;
    if (area_.searchesBlocks()) return true;
    area_.searchBlocks();
    return false;
  }

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
