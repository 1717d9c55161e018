#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "lstm_planner/drive/perception/costmap_obstacles.hpp"
#include "lstm_planner/drive/perception/situation.hpp"
#include "lstm_planner/simulation/generated_world.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"

namespace lstm_planner::costmap_bench {
namespace {

constexpr double kResolution = 0.05;  // m

/// A rolling costmap of an office, inflated as shipped, around a robot in it, and a zone of 1 m that no scan sees.
struct CostmapCourse {
  explicit CostmapCourse(double width) : world(generateWorld(WorldKind::kOffice, worldSeed(WorldUse::kJudging, 1, 0))) {
    const OccupancyGrid& office = world.grid();
    const Point2 middle{0.5 * office.columns() * office.resolution(), 0.5 * office.rows() * office.resolution()};
    double best = 0.0;
    for (int row = 0; row < office.rows(); ++row) {
      for (int column = 0; column < office.columns(); ++column) {
        const Point2 place = office.centerOf({column, row});
        const double room = world.distances().at({column, row}) - 0.1 * distanceBetween(place, middle);
        if (room > best) {
          best = room;
          robot = {place.x, place.y, 0.3};
        }
      }
    }
    const int side = static_cast<int>(width / kResolution);
    grid.columns = grid.rows = side;
    grid.resolution = kResolution;
    grid.origin = {robot.x - 0.5 * width, robot.y - 0.5 * width};
    grid.inscribed_radius = 0.175;
    costs.resize(static_cast<std::size_t>(side * side));
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column)
        costs[static_cast<std::size_t>(row * side + column)] = costAt(column, row);
    }
    grid.costs = costs.data();
    Hokuyo scanner(HokuyoParameters(), 1);
    LaserScan scan;
    scanner.scan(world, robot, 0.0, &scan);
    perceive(scan, {}, Hokuyo::rules(), 6.0, &situation);
  }

  unsigned char costAt(int column, int row) const {
    const Point2 place{grid.origin.x + (column + 0.5) * kResolution, grid.origin.y + (row + 0.5) * kResolution};
    if (std::abs(place.x - robot.x - 1.0) < 0.5 && std::abs(place.y - robot.y) < 0.5) return 254;
    const OccupancyGrid& office = world.grid();
    const auto index = [&](double position) { return static_cast<int>(std::floor(position / office.resolution())); };
    const CellIndex cell{index(place.x), index(place.y)};
    if (cell.column < 0 || cell.row < 0 || cell.column >= office.columns() || cell.row >= office.rows()) return 0;
    const double distance = world.distances().at(cell);
    if (distance < kResolution) return 254;
    if (distance < 0.175) return 253;
    return distance < 0.5 ? 100 : 0;
  }

  GridWorld world;
  Pose2 robot;
  CostGrid grid;
  std::vector<unsigned char> costs;
  Situation situation;
};

void findCostmapObstacles(benchmark::State& state, double width, double reach) {
  const CostmapCourse course(width);
  std::vector<Point2> found;
  for (auto _ : state) {
    found = costmapObstacles(course.grid, course.robot, course.situation.obstacles, reach);
    benchmark::DoNotOptimize(found.data());
  }
  state.counters["found"] = static_cast<double>(found.size());
}

BENCHMARK_CAPTURE(findCostmapObstacles, controller, 6.0, 2.0)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(findCostmapObstacles, planner, 6.0, 6.0)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(findCostmapObstacles, plannerLargeCostmap, 30.0, 6.0)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(findCostmapObstacles, plannerHugeCostmap, 100.0, 6.0)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lstm_planner::costmap_bench
