#pragma once

#include <optional>

#include "lstm_planner/drive/decision/decision.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"

namespace lstm_planner {

/// The decision of an agent with the start of its path bent away from the remembered obstacles, so that the footprint
/// keeps the distance `clearance` (m) if there is room. Of a decision for one step only the path behind the waypoint is
/// bent. None if the decision neither follows the remembered path nor leads to a goal in sight, if the bent path would
/// not be passable, or if the clearance is 0.
///
/// It is an elastic band (S. Quinlan and O. Khatib, "Elastic bands: connecting path planning and control", 1993): a
/// chain of points along the path. Each point is pulled to the middle between its neighbours, and pushed away from the
/// nearest obstacle on each side. The shortest path touches corners and door posts; the bent one goes round a corner in
/// an arc, and through the middle of a door. For controllers that cut corners.
std::optional<Decision> bentAway(const NavigationAgent& agent, const Pose2& robot, const Decision& decision,
                                 double clearance);

}  // namespace lstm_planner
