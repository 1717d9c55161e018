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
    const GeodesicField to_goal(grid, distances, goal, options);
    if (!std::isfinite(to_goal.at(start)) || to_goal.at(start) < shortest) continue;
    const double length = shortestPath(distances, to_goal, grid, start, goal, needed);
    if (length >= shortest) {
      const Point2 from = grid.centerOf(start);
      tasks.push_back({{from.x, from.y, yaw}, grid.centerOf(goal), length});
    }
  }
  return tasks;
}

}  // namespace lstm_planner
