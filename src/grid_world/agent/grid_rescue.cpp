#include "lstm_planner/grid_world/agent/grid_rescue.hpp"

#include "lstm_planner/base/common/parameter_check.hpp"

namespace lstm_planner {

GridRescue::GridRescue(const GridRescueParameters& parameters)
    : parameters_(parameters), greedy_(parameters.corner_cutting) {
  checkParameter(parameters.patience >= 1, "patience", parameters.patience, "at least one step");
  checkParameter(parameters.long_patience >= 1, "long_patience", parameters.long_patience, "at least one step");
  checkParameter(parameters.most_detour >= 0.0, "most_detour", parameters.most_detour, "a number that is not negative");
  checkParameter(parameters.most_steps_without_path >= 0, "most_steps_without_path", parameters.most_steps_without_path,
                 "a number that is not negative");
  parameters_.area.corner_cutting = parameters.corner_cutting;
  parameters_.last_resort.boundary.corner_cutting = parameters.corner_cutting;
  checkParameter(parameters.most_times_planned >= 0.0, "most_times_planned", parameters.most_times_planned,
                 "a number that is not negative");
  checkParameter(parameters.most_steps_more >= 0, "most_steps_more", parameters.most_steps_more,
                 "a number that is not negative");
  AreaPlanner{parameters_.area};
  GridEscape{parameters_.last_resort};
}

void GridRescue::start(CellIndex start) {
  area_.reset();
  last_resort_.reset();
  watch_.start();
  start_ = start;
}

bool GridRescue::isNeeded(const GridObservation& observation, bool new_place, double detour) {
  watch_.observe(observation, new_place);
  return detour > parameters_.most_detour || watch_.isExhausted(parameters_.patience, parameters_.long_patience);
}

void GridRescue::takeOver(const GridObservation& observation, const RollingGrid* walls) {
  area_ = std::make_unique<AreaPlanner>(parameters_.area);
  area_->restart(observation.cell, start_);
  if (walls != nullptr) area_->takeWalls(*walls);
  steps_without_path_ = 0;
}

void GridRescue::observe(const GridObservation& observation) {
  area_->observe(observation);
  if (!last_resort_) {
    last_resort_ = std::make_unique<GridEscape>(parameters_.last_resort);
    last_resort_->start();
  }
  last_resort_->observe(observation, area_->sawSomethingNew());
  if (!last_resort_->active()) followArea(observation);
  if (!last_resort_->active()) return;
  direction_ = last_resort_->decide();
  leader_ = GridLeader::kBoundary;
}

void GridRescue::followArea(const GridObservation& observation) {
  direction_ = area_->plan();
  // The shield: whatever is remembered, nothing is entered that the rays show to be blocked.
  if (direction_ != kNoPath && !movePossible(observation.ranges, direction_, parameters_.corner_cutting)) {
    direction_ = kNoPath;
  }
  leader_ = GridLeader::kSearch;
  if (isStuck()) {
    last_resort_->takeOver(observation);
  } else if (direction_ == kNoPath) {
    greedy_.observe(observation);
    direction_ = greedy_.decide();
    leader_ = GridLeader::kGreedy;
  }
}

bool GridRescue::isStuck() {
  steps_without_path_ += direction_ == kNoPath ? 1 : 0;
  if (area_->sawSomethingNew()) {
    steps_left_ = parameters_.most_times_planned * area_->length() + parameters_.most_steps_more;
  }
  steps_left_ -= 1.0;
  if (steps_left_ > 0.0 && steps_without_path_ <= parameters_.most_steps_without_path) return false;
  steps_without_path_ = 0;
  steps_left_ = parameters_.most_times_planned * area_->length() + parameters_.most_steps_more;
  return true;
}

std::size_t GridRescue::bytes() const {
  return (area_ ? area_->bytes() : 0) + (last_resort_ ? last_resort_->peakBytes() : 0);
}

}  // namespace lstm_planner
