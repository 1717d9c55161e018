#pragma once

#include <vector>

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/drive/perception/situation.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"
#include "lstm_planner/simulation/drive.hpp"

namespace lstm_planner::test {

/// A policy that always has these preferences (right to left, five) and whose hidden state changes at every step.
DrivePolicy policyPreferring(const std::vector<float>& preferences);
/// Its network, for the thesis's inputs.
LayerStack layersPreferring(const std::vector<float>& preferences);

/// Default parameters, but that the path through what is remembered leads.
AgentParameters routeLed();

/// Goes straight on wherever it may, and rather a little aside than back.
DrivePolicy straightAheadPolicy();

/// What the agent knows at a place where it sees these points (base frame, m).
Situation situationAt(const Pose2& pose, double time = 0.0, const std::vector<Point2>& obstacles = {});

/// Points of a wall from `start` to `end`, 1 cm apart.
std::vector<Point2> wall(const Point2& begin, const Point2& end);

/// Points all around the origin, a degree apart.
std::vector<Point2> ring(double radius);

/// A free map with a wall along the outside, and walls drawn with fillBox().
OccupancyGrid emptyHall(double width, double height, double resolution = 0.05);

/// Occupies all cells whose centres lie in the box (m).
void fillBox(double left, double bottom, double right, double top, OccupancyGrid* grid);

/// A hall of 7.2 x 6.4 m with a spiral of walls around (3.4, 3), whose corridors are 0.8 m wide.
OccupancyGrid spiral();

/// Default parameters but with a third of the beams, which makes drives three times as fast.
DriveParameters quickDrive(double time_limit);

}  // namespace lstm_planner::test
