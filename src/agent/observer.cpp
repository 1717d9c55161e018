#include "lstm_planner/agent/observer.hpp"

namespace lstm_planner {

Observation observe(const Situation& situation, const Point2& goal, double previous_action, double position_cell,
                    const RouteGuide* guide, double step_length, DriveTrace* trace) {
  Observation observation = observe(situation.sectors, situation.pose, goal, previous_action, position_cell);
  trace->look(situation.pose, &observation);
  if (guide != nullptr) {
    observation.route_bearing = guide->bearingAhead(situation.pose, step_length);
    observation.route_length = guide->route().length;
  }
  return observation;
}

void Observer::begin(const Point2& goal) {
  guide_.begin(goal);
  trace_.clear();
}

void Observer::forget() {
  guide_.forget();
  trace_.clear();
}

Observation Observer::look(const Situation& situation, const Point2& goal, double previous_action) {
  const bool knows_route =
      parameters_.memory.enabled && guide_.update(situation) == RouteGuide::Status::kRoute;
  return observe(situation, goal, previous_action, 0.0, knows_route ? &guide_ : nullptr, parameters_.step.length,
                 &trace_);
}

}  // namespace lstm_planner
