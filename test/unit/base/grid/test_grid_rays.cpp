#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/base/grid/grid_rays.hpp"

namespace lstm_planner {
namespace {

TEST(GridRays, CountStepsToTheFirstBlockedCellInOrder) {
  OccupancyGrid grid(200, 200, 1.0);
  grid.set({101, 100}, Cell::kOccupied);  // east: the neighbour
  grid.set({103, 103}, Cell::kUnknown);   // north-east
  grid.set({100, 107}, Cell::kOccupied);  // north
  grid.set({90, 90}, Cell::kOccupied);    // south-west
  const auto rays = gridRays(grid, {100, 100});
  const double expected[] = {1.0, 3.0 * M_SQRT2, 7.0, 50.0 * M_SQRT2, 50.0, 10.0 * M_SQRT2, 50.0, 50.0 * M_SQRT2};
  for (std::size_t ray = 0; ray < rays.size(); ++ray) EXPECT_DOUBLE_EQ(rays[ray], expected[ray]) << ray;
}

TEST(GridRays, EndAtTheEdgeOfTheMap) {
  const auto rays = gridRays(OccupancyGrid(4, 3, 1.0), {0, 0});
  const double expected[] = {4.0, 3.0 * M_SQRT2, 3.0, M_SQRT2, 1.0, M_SQRT2, 1.0, M_SQRT2};
  for (std::size_t ray = 0; ray < rays.size(); ++ray) EXPECT_DOUBLE_EQ(rays[ray], expected[ray]) << ray;
}

TEST(GridRays, SeeNothingBeyondTheCap) {
  OccupancyGrid grid(200, 1, 1.0);
  grid.set({149, 0}, Cell::kOccupied);
  EXPECT_EQ(gridRays(grid, {100, 0})[0], 49.0);
  EXPECT_EQ(gridRays(grid, {99, 0})[0], 50.0);
  EXPECT_EQ(gridRays(grid, {98, 0})[0], 50.0);
}

}  // namespace
}  // namespace lstm_planner
