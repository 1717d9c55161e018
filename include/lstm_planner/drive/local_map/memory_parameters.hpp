#pragma once

namespace lstm_planner {

/// What is remembered of the obstacles that were seen, and how paths through them are found.
/// What each means: visitMemoryParameters().
struct MemoryParameters {
  bool enabled = true;
  double width = 70.4;
  double resolution = 0.05;
  double reach = 12.0;
  double comfort = 0.12;
  double tightness = 3.0;
};

/// Largest distance, in squares of the memory, at which an obstacle matters to the middle of the footprint: the time
/// of an update grows with the square of it.
constexpr double kMostNearSquares = 16.0;
constexpr double kMostSquaresASide = 2000.0;  ///< of the memory

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitMemoryParameters(Parameters& memory, const Visitor& visit) {
  visit("memory/enabled", memory.enabled, {}, "",
        "false: no obstacles are remembered: nothing limits the network's detours, and without progress the robot "
        "follows boundaries (escape)");
  visit("memory/resolution", memory.resolution, {0.005, 1.0}, "m",
        "side of a square of the memory; at most 0.29 footprint radii, or paths would lead through walls");
  visit("memory/width", memory.width, {4.0, 1000.0}, "m",
        "side of the square around the robot in which obstacles are remembered; larger finds longer paths, and takes "
        "more memory and time; at most 2000 times the resolution");
  visit("memory/reach", memory.reach, {0.1, 100.0}, "m",
        "returns farther away are not remembered: they are too far apart to be walls");
  visit("memory/comfort", memory.comfort, {0.0, 5.0}, "m",
        "distance that paths keep between the footprint and obstacles where there is room; more suits controllers that "
        "follow paths less exactly, and takes more time");
  visit("memory/tightness", memory.tightness, {1.0, 100.0}, "",
        "factor on the length of a path where there is less room than shield/clearance; a larger value prefers longer "
        "paths around tight places");
}

}  // namespace lstm_planner
