#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/grid/distance_field.hpp"
#include "lstm_planner/simulation/floor_plan.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_floor_plan {
namespace {

constexpr double kRobotRadius = 0.175;

std::vector<CellIndex> cellsWhere(const OccupancyGrid& grid, Cell cell) {
  std::vector<CellIndex> cells;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      if (grid.at({column, row}) == cell) cells.push_back({column, row});
    }
  }
  return cells;
}

/// Cells in which the robot fits but to which it finds no path from the first one in which it fits.
int unreachableCells(const OccupancyGrid& grid) {
  const DistanceField distances(grid, true);
  const double clearance = kRobotRadius + grid.resolution() * M_SQRT1_2;
  std::vector<CellIndex> fitting;
  for (const CellIndex& cell : cellsWhere(grid, Cell::kFree)) {
    if (distances.at(cell) >= clearance) fitting.push_back(cell);
  }
  if (fitting.empty()) return -1;
  const GeodesicField paths(grid, distances, fitting.front(), {clearance, 0.0, 0.0});
  int unreachable = 0;
  for (const CellIndex& cell : fitting) unreachable += std::isinf(paths.at(cell)) ? 1 : 0;
  return unreachable;
}

TEST(FloorPlan, CanBeReachedEverywhere) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    EXPECT_EQ(unreachableCells(generateFloorPlan({}, seed)), 0) << seed;
  }
}

TEST(FloorPlan, CanBeReachedEverywhereWithCrowdedFurniture) {
  // Gaps of 0.2 m are narrower than the robot: furniture that cuts something off has to go.
  FloorPlanParameters parameters;
  parameters.width = 12.0;
  parameters.height = 9.0;
  parameters.furniture = 0.4;
  parameters.smallest_gap = 0.2;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    EXPECT_EQ(unreachableCells(generateFloorPlan(parameters, seed)), 0) << seed;
  }
}

TEST(FloorPlan, CanBeReachedEverywhereAtOtherScales) {
  for (const double resolution : {0.02, 0.1, 0.2}) {
    FloorPlanParameters parameters;
    parameters.resolution = resolution;
    parameters.wall_thickness = 0.2;
    parameters.door_width = 0.6;
    EXPECT_EQ(unreachableCells(generateFloorPlan(parameters, 1)), 0) << resolution;
  }
  FloorPlanParameters large;
  large.width = 60.0;
  large.height = 40.0;
  EXPECT_EQ(unreachableCells(generateFloorPlan(large, 1)), 0);
}

TEST(FloorPlan, HasAClosedOuterWall) {
  const OccupancyGrid grid = generateFloorPlan({}, 3);
  ASSERT_EQ(grid.columns(), 400);
  ASSERT_EQ(grid.rows(), 280);
  for (const CellIndex& cell : cellsWhere(grid, Cell::kFree)) {
    ASSERT_TRUE(cell.column >= 3 && cell.row >= 3 && cell.column < 397 && cell.row < 277)
        << "0.15 m of wall are three cells";
  }
}

TEST(FloorPlan, IsTheSameForTheSameSeed) {
  // The sum fixes the plan for all machines: it changes only when the generator is changed on purpose.
  const auto fingerprint = [](std::uint64_t seed) {
    std::uint64_t sum = 14695981039346656037ull;
    for (const CellIndex& cell : cellsWhere(generateFloorPlan({}, seed), Cell::kOccupied)) {
      sum = (sum ^ static_cast<std::uint64_t>(cell.row * 400 + cell.column)) * 1099511628211ull;
    }
    return sum;
  };
  EXPECT_EQ(fingerprint(1), fingerprint(1));
  EXPECT_NE(fingerprint(1), fingerprint(2));
  EXPECT_EQ(fingerprint(1), 16655078195545323151ull);
}

TEST(FloorPlan, CoversTheShareOfTheFloorWithFurniture) {
  FloorPlanParameters empty;
  empty.furniture = 0.0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const double floor = static_cast<double>(cellsWhere(generateFloorPlan(empty, seed), Cell::kFree).size());
    const double free = static_cast<double>(cellsWhere(generateFloorPlan({}, seed), Cell::kFree).size());
    // Not more than the share and one piece of 1.8 m x 0.9 m; rooms may be too small for all of it.
    EXPECT_LE(1.0 - free / floor, 0.06 + 1.8 * 0.9 / (floor * 0.05 * 0.05)) << seed;
    EXPECT_GE(1.0 - free / floor, 0.03) << seed;
  }
}

TEST(FloorPlan, StandsFurnitureFlushOrAGapAwayFromWalls) {
  FloorPlanParameters empty;
  empty.furniture = 0.0;
  const OccupancyGrid walls = generateFloorPlan(empty, 4);
  const OccupancyGrid furnished = generateFloorPlan({}, 4);
  const DistanceField to_walls(walls, true);
  cv::Mat furniture = cv::Mat::zeros(walls.rows(), walls.columns(), CV_8U);
  for (const CellIndex& cell : cellsWhere(furnished, Cell::kOccupied)) {
    furniture.at<std::uint8_t>(cell.row, cell.column) = walls.at(cell) == Cell::kOccupied ? 0 : 1;
  }
  cv::Mat labels;
  const int pieces = cv::connectedComponents(furniture, labels, 8);
  std::vector<float> nearest(static_cast<std::size_t>(pieces), HUGE_VALF);
  for (const CellIndex& cell : cellsWhere(furnished, Cell::kOccupied)) {
    float& distance = nearest[static_cast<std::size_t>(labels.at<int>(cell.row, cell.column))];
    distance = std::min(distance, to_walls.at(cell));
  }
  ASSERT_GT(pieces, 10);
  for (std::size_t piece = 1; piece < nearest.size(); ++piece) {
    // From centre to centre, that is one cell more than from edge to edge.
    const bool flush = nearest[piece] < 0.05 + 1e-5;
    EXPECT_TRUE(flush || nearest[piece] > 0.7 + 0.05 - 1e-5) << piece << ": " << nearest[piece];
  }
}

TEST(FloorPlan, NamesImpossibleParameters) {
  const auto refusal = [](double FloorPlanParameters::*field, double value) -> std::string {
    FloorPlanParameters parameters;
    parameters.*field = value;
    return test::refusalOf<std::invalid_argument>([&] { generateFloorPlan(parameters, 1); });
  };
  EXPECT_NE(refusal(&FloorPlanParameters::width, 2.0).find("width is 2, expected"), std::string::npos);
  EXPECT_NE(refusal(&FloorPlanParameters::height, HUGE_VAL).find("height is inf"), std::string::npos);
  EXPECT_NE(refusal(&FloorPlanParameters::resolution, 0.0).find("resolution"), std::string::npos);
  EXPECT_NE(refusal(&FloorPlanParameters::door_width, 0.3).find("door_width"), std::string::npos);
  EXPECT_NE(refusal(&FloorPlanParameters::smallest_room, 1.0).find("smallest_room"), std::string::npos);
  EXPECT_NE(refusal(&FloorPlanParameters::furniture, std::nan("")).find("furniture"), std::string::npos);
  EXPECT_NE(refusal(&FloorPlanParameters::extra_doors, 1.1).find("extra_doors"), std::string::npos);
}

}  // namespace
}  // namespace lstm_planner::test_floor_plan
