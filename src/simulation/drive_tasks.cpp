#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/simulation/drive.hpp"
#include "lstm_planner/simulation/standing_cells.hpp"
#include "simulation/shortest_path.hpp"

namespace lstm_planner {
namespace {

std::string robotText(double footprint_radius, double clearance, double needed) {
  std::ostringstream text;
  text << "a disc with a radius of " << needed << " m (robot " << footprint_radius << ", clearance " << clearance
       << ", half a cell)";
  return text.str();
}

/// Marks all places that a goal can be got to from, where no two of them are `shortest` (m) apart: by way of the goal
/// they are twice as far apart as the farthest from it, at the most.
void markNear(const GeodesicField& to_goal, const std::vector<CellIndex>& standing, double shortest,
              CellField<char>* near) {
  constexpr double kTwice = 2.0001;  // lengths are rounded
  double farthest = 0.0;
  for (const CellIndex cell : standing) {
    if (const double length = to_goal.at(cell); std::isfinite(length)) farthest = std::max(farthest, length);
  }
  if (kTwice * farthest >= shortest) return;
  for (const CellIndex cell : standing) {
    if (std::isfinite(to_goal.at(cell))) (*near)[cell] = 1;
  }
}

}  // namespace

std::vector<DriveTask> drawTasks(const GridWorld& world, int count, double footprint_radius, double clearance,
                                 double shortest, std::uint64_t seed) {
  const OccupancyGrid& grid = world.grid();
  const double needed = distanceNeeded(footprint_radius + clearance, grid);
  const DistanceField distances(grid, true);
  const std::vector<CellIndex> standing = standingCells(grid, distances, needed);
  if (standing.empty()) {
    throw std::invalid_argument("there is no place for " + robotText(footprint_radius, clearance, needed));
  }
  Random random(seed);
  std::vector<DriveTask> tasks;
  GeodesicField::Options options;
  options.clearance = needed;
  CellField<char> near(grid.columns(), grid.rows(), 0);  // goals that nothing is far enough away from
  // Where only few pairs of places are far enough apart, one takes some hundred draws.
  const int most_draws = 1000 + 100 * count;
  for (int draws = 0; static_cast<int>(tasks.size()) < count; ++draws) {
    if (draws > most_draws) {
      std::ostringstream message;
      message << "there are no two places at least " << shortest << " m apart that "
              << robotText(footprint_radius, clearance, needed) << " can get to from one another";
      throw std::invalid_argument(message.str());
    }
    const CellIndex goal = standing[uniformIndex(random, standing.size())];
    const CellIndex start = standing[uniformIndex(random, standing.size())];
    const double yaw = (2.0 * uniform(random) - 1.0) * M_PI;
    if (near[goal] != 0) continue;
    const GeodesicField to_goal(grid, distances, goal, options);
    if (!std::isfinite(to_goal.at(start)) || to_goal.at(start) < shortest) {
      markNear(to_goal, standing, shortest, &near);
      continue;
    }
    const double length = shortestPath(distances, to_goal, grid, start, goal, needed);
    if (length >= shortest) {
      const Point2 from = grid.centerOf(start);
      tasks.push_back({{from.x, from.y, yaw}, grid.centerOf(goal), length});
    }
  }
  return tasks;
}

}  // namespace lstm_planner
