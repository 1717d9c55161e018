#include "costmap_course.hpp"

#include <costmap_2d/cost_values.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "lstm_planner/simulation/floor_plan.hpp"

namespace lstm_planner {
namespace {

constexpr double kLongest = 60.0;  // s of a drive
constexpr double kNear = 5.0;      // m of path to the near goal

/// Cells in which the robot fits, with the length of the path there from the one in the middle.
struct Paths {
  explicit Paths(const GridWorld& world);
  std::vector<CellIndex> places;
  std::vector<double> lengths;  ///< m, by place; those that cannot be reached are left out
  CellIndex middle;
};

Paths::Paths(const GridWorld& world) {
  const ShieldParameters shield;
  const OccupancyGrid& grid = world.grid();
  GeodesicField::Options options;
  options.clearance = shield.footprint_radius + shield.clearance + 0.5 * kResolution;
  const Point2 center{0.5 * kResolution * grid.columns(), 0.5 * kResolution * grid.rows()};
  double nearest = std::numeric_limits<double>::infinity();
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const CellIndex cell{column, row};
      const double distance = distanceBetween(grid.centerOf(cell), center);
      if (world.distances().at(cell) < options.clearance || distance >= nearest) continue;
      nearest = distance;
      middle = cell;
    }
  }
  const GeodesicField from_middle(grid, world.distances(), middle, options);
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      if (!std::isfinite(from_middle.at({column, row}))) continue;
      places.push_back({column, row});
      lengths.push_back(from_middle.at({column, row}));
    }
  }
}

/// The near goal is `kNear` metres of path off, the far one as near to the costmap's upper right corner as can be.
DriveTask chooseTask(const GridWorld& world, Goal goal) {
  const Paths paths(world);
  const OccupancyGrid& grid = world.grid();
  std::size_t best = 0;
  const auto badness = [&](std::size_t i) {
    if (goal == kNearGoal) return std::abs(paths.lengths[i] - kNear);
    return std::hypot(grid.columns() - paths.places[i].column, grid.rows() - paths.places[i].row);
  };
  for (std::size_t i = 1; i < paths.places.size(); ++i) {
    if (badness(i) < badness(best)) best = i;
  }
  const Point2 start = grid.centerOf(paths.middle);
  return {{start.x, start.y, 0.0}, grid.centerOf(paths.places[best]), 0.0};
}

/// What obstacle and inflation layer would make of the world, with the parameters of costmaps.yaml.
std::unique_ptr<costmap_2d::Costmap2D> makeCostmap(const GridWorld& world) {
  constexpr double kRobotRadius = 0.175;
  constexpr double kInflationRadius = 0.5;
  constexpr double kScaling = 6.0;
  const OccupancyGrid& grid = world.grid();
  auto costmap = std::make_unique<costmap_2d::Costmap2D>(grid.columns(), grid.rows(), kResolution, 0.0, 0.0);
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const double distance = world.distances().at({column, row});
      unsigned char cost = costmap_2d::FREE_SPACE;
      if (distance <= 0.0) {
        cost = costmap_2d::LETHAL_OBSTACLE;
      } else if (distance <= kRobotRadius) {
        cost = costmap_2d::INSCRIBED_INFLATED_OBSTACLE;
      } else if (distance <= kInflationRadius) {
        cost = static_cast<unsigned char>((costmap_2d::INSCRIBED_INFLATED_OBSTACLE - 1) *
                                          std::exp(-kScaling * (distance - kRobotRadius)));
      }
      costmap->setCost(static_cast<unsigned>(column), static_cast<unsigned>(row), cost);
    }
  }
  return costmap;
}

}  // namespace

const Course& course(int size, Goal goal) {
  static Course course;
  if (course.size == size && course.goal == goal) return course;
  course = Course();
  course.size = size;
  course.goal = goal;
  FloorPlanParameters plan;
  plan.width = plan.height = kResolution * size;
  plan.resolution = kResolution;
  course.world = std::make_unique<GridWorld>(generateFloorPlan(plan, 1));
  course.task = chooseTask(*course.world, goal);
  course.costmap = makeCostmap(*course.world);
  course.drive = recordDrive("floor plan", *course.world, course.task, kLongest, 1);
  return course;
}

}  // namespace lstm_planner
