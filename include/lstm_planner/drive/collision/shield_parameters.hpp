#pragma once

#include <string>

#include "lstm_planner/common/footprint.hpp"

namespace lstm_planner {

/// What the shield lets through. What each means: visitShieldParameters().
struct ShieldParameters {
  double footprint_radius = 0.17425;
  std::string footprint = "";
  double clearance = 0.07;
  double tight_clearance = 0.03;
  double shortest_step = 0.15;
  double reach = 6.0;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitShieldParameters(Parameters& shield, const Visitor& visit) {
  visit("shield/footprint_radius", shield.footprint_radius, {0.02, 5.0}, "m",
        "radius of the circle around all parts of the robot (half the Create 2's diameter); not used if "
        "shield/footprint is set");
  visit("shield/footprint", shield.footprint, {}, "m",
        "corners [[x, y], ...] of a robot that is not round, around the origin of its base frame; empty: it is round");
  visit("shield/clearance", shield.clearance, {0.0, 5.0}, "m",
        "distance kept between the footprint and every return if there is room; more drives more smoothly, less fits "
        "through narrower doors");
  visit("shield/tight_clearance", shield.tight_clearance, {0.0, 5.0}, "m",
        "distance kept if no path has shield/clearance; at least the controller's safety_margin");
  visit("shield/shortest_step", shield.shortest_step, {0.002, 5.0}, "m",
        "an action with less free space than this is removed");
  visit(
      "shield/reach", shield.reach, {0.1, 100.0}, "m",
      "returns farther away are ignored; a larger value takes more time, a smaller one follows boundaries for longer");
}

/// The robot that the shield is for. Throws std::invalid_argument as footprintOf() for two parameters.
inline Footprint footprintOf(const ShieldParameters& shield) {
  return footprintOf("shield/footprint", shield.footprint_radius, shield.footprint);
}

}  // namespace lstm_planner
