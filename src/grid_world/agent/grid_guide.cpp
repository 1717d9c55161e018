#include "lstm_planner/grid_world/agent/grid_guide.hpp"

#include "lstm_planner/common/parameter_check.hpp"

namespace lstm_planner {
namespace {

GridGuideParameters withCorners(GridGuideParameters parameters) {
  parameters.area.corner_cutting = parameters.corner_cutting;
  parameters.last_resort.boundary.corner_cutting = parameters.corner_cutting;
  return parameters;
}

}  // namespace

GridGuide::GridGuide(const GridGuideParameters& parameters)
    : parameters_(withCorners(parameters)),
      area_(parameters_.area),
      last_resort_(parameters_.last_resort),
      greedy_(parameters.corner_cutting) {
  checkNotNegative("most_steps_without_path", parameters.most_steps_without_path);
  checkNotNegative("most_times_planned", parameters.most_times_planned);
  checkNotNegative("most_steps_more", parameters.most_steps_more);
}

void GridGuide::start(CellIndex start, CellIndex /*goal*/) {
  area_.restart(start);
  last_resort_.start();
  steps_without_path_ = 0;
  steps_left_ = 0.0;
}

void GridGuide::observe(const GridObservation& observation) {
  area_.observe(observation);
  last_resort_.observe(observation, area_.sawSomethingNew());
  if (!last_resort_.active()) followArea(observation);
  if (!last_resort_.active()) return;
  direction_ = last_resort_.decide();
  leader_ = GridLeader::kBoundary;
}

void GridGuide::followArea(const GridObservation& observation) {
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

bool GridGuide::isStuck() {
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

std::size_t GridGuide::peakBytes() const {
  return sizeof(*this) - sizeof(area_) + area_.bytes() - sizeof(last_resort_) + last_resort_.peakBytes();
}

}  // namespace lstm_planner
