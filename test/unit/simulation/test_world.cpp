#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner::test_world {
namespace {

double castOne(const World& world, const Point2& origin, double direction, double max_range = 1e3) {
  std::vector<double> ranges(1);
  world.castRays(origin, direction, 0.0, max_range, &ranges);
  return ranges[0];
}

/// Distance to a square by the intersection with its two slabs, all in cells: no walk over the grid.
double distanceToSquare(const Point2& origin, double direction, CellIndex cell) {
  const double start[] = {origin.x, origin.y};
  const double slope[] = {std::cos(direction), std::sin(direction)};
  const int low[] = {cell.column, cell.row};
  double enter = 0.0;
  double leave = HUGE_VAL;
  for (int axis = 0; axis < 2; ++axis) {
    const double a = (low[axis] - start[axis]) / slope[axis];
    const double b = (low[axis] + 1 - start[axis]) / slope[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : HUGE_VAL;
}

struct RandomGrid {
  RandomGrid(int columns, int rows, int blocked, double resolution, Pose2 origin, std::uint64_t seed)
      : grid(columns, rows, resolution, origin) {
    Random random(seed);
    for (int i = 0; i < blocked; ++i) {
      cells.push_back({static_cast<int>(uniformIndex(random, static_cast<std::size_t>(columns))),
                       static_cast<int>(uniformIndex(random, static_cast<std::size_t>(rows)))});
      grid.set(cells.back(), Cell::kOccupied);
    }
  }
  OccupancyGrid grid;
  std::vector<CellIndex> cells;
};

TEST(GridWorld, CastsTheSameRangesAsBruteForce) {
  // From crowded to nearly empty, so that steps and leaps are both taken; origins inside and outside of the map.
  for (const int blocked : {5, 60, 900}) {
    const RandomGrid map(70, 50, blocked, 0.05, {-1.0, 2.0, 0.6}, static_cast<std::uint64_t>(blocked));
    const GridWorld world(map.grid);
    Random random(7);
    for (int trial = 0; trial < 40; ++trial) {
      const Point2 cells{uniform(random, -10.0, 80.0), uniform(random, -10.0, 60.0)};
      const Point2 origin = toParentFrame(map.grid.origin(), {cells.x * 0.05, cells.y * 0.05});
      const double first = uniform(random, -4.0, 4.0);
      const double increment = uniform(random, -0.1, 0.1);
      std::vector<double> ranges(100);
      world.castRays(origin, first, increment, 2.5, &ranges);
      for (std::size_t beam = 0; beam < ranges.size(); ++beam) {
        const double direction = first + static_cast<double>(beam) * increment - 0.6;
        double expected = HUGE_VAL;
        for (const CellIndex& cell : map.cells) {
          expected = std::min(expected, 0.05 * distanceToSquare(cells, direction, cell));
        }
        if (expected > 2.5) expected = HUGE_VAL;
        if (std::isinf(expected)) {
          ASSERT_TRUE(std::isinf(ranges[beam])) << blocked << " " << trial << " " << beam << ": " << ranges[beam];
        } else {
          ASSERT_NEAR(ranges[beam], expected, 1e-9) << blocked << " " << trial << " " << beam;
        }
      }
    }
  }
}

TEST(GridWorld, MeasuresToTheNearBorderOfACell) {
  OccupancyGrid grid(100, 100, 0.5);
  grid.set({80, 10}, Cell::kOccupied);
  grid.set({5, 10}, Cell::kOccupied);
  grid.set({40, 90}, Cell::kOccupied);
  const GridWorld world(grid);
  const Point2 origin{20.25, 5.25};
  EXPECT_NEAR(castOne(world, origin, 0.0), 80 * 0.5 - 20.25, 1e-12);
  EXPECT_NEAR(castOne(world, origin, M_PI), 20.25 - 6 * 0.5, 1e-12);
  EXPECT_NEAR(castOne(world, origin, M_PI_2), 90 * 0.5 - 5.25, 1e-12);
  EXPECT_EQ(castOne(world, {40.1, 5.1}, 0.3), 0.0) << "inside an obstacle";
}

TEST(GridWorld, SeesNothingOutsideAndBeyondTheLimit) {
  OccupancyGrid grid(10, 10, 1.0, {}, Cell::kUnknown);
  grid.set({8, 5}, Cell::kOccupied);
  const GridWorld world(grid);
  EXPECT_TRUE(std::isinf(castOne(world, {1.5, 5.5}, M_PI)));
  EXPECT_NEAR(castOne(world, {1.5, 5.5}, 0.0), 6.5, 1e-12) << "unknown cells are not seen";
  EXPECT_NEAR(castOne(world, {1.5, 5.5}, 0.0, 6.5), 6.5, 1e-12);
  EXPECT_TRUE(std::isinf(castOne(world, {1.5, 5.5}, 0.0, 6.5 - 1e-9)));
  EXPECT_NEAR(castOne(world, {-2.0, 5.5}, 0.0), 10.0, 1e-12) << "from outside into the map";
  EXPECT_TRUE(std::isinf(castOne(world, {std::numeric_limits<double>::quiet_NaN(), 0.0}, 0.0)));
}

TEST(GridWorld, LetsNoRayThroughTwoCellsThatMeetAtACorner) {
  OccupancyGrid grid(10, 10, 1.0);
  grid.set({5, 4}, Cell::kOccupied);
  grid.set({4, 5}, Cell::kOccupied);
  const double range = castOne(GridWorld(grid), {2.5, 2.5}, M_PI_4);
  EXPECT_NEAR(range, 2.5 * M_SQRT2, 1e-9);
}

TEST(GridWorld, TouchesExactlyAtTheTangent) {
  OccupancyGrid grid(100, 100, 0.05, {-1.0, -2.0, 0.0});
  grid.set({60, 50}, Cell::kOccupied);  // [2.0, 2.05] x [0.5, 0.55]
  const GridWorld world(grid);
  constexpr double kRadius = 0.17425;
  EXPECT_TRUE(world.touches({2.0 - kRadius + 1e-6, 0.52}, kRadius));
  EXPECT_FALSE(world.touches({2.0 - kRadius - 1e-6, 0.52}, kRadius));
  EXPECT_TRUE(world.touches({2.02, 0.55 + kRadius - 1e-6}, kRadius));
  EXPECT_FALSE(world.touches({2.02, 0.55 + kRadius + 1e-6}, kRadius));
  const auto beyondCorner = [](double distance) {  // 30 degrees off the upper right corner
    return Point2{2.05 + distance * std::cos(M_PI / 6.0), 0.55 + distance * std::sin(M_PI / 6.0)};
  };
  EXPECT_TRUE(world.touches(beyondCorner(kRadius - 1e-6), kRadius));
  EXPECT_FALSE(world.touches(beyondCorner(kRadius + 1e-6), kRadius));
  EXPECT_TRUE(world.touches({2.02, 0.52}, 1e-3)) << "a disc smaller than the cell, inside it";
  EXPECT_FALSE(world.touches({1e6, -1e6}, kRadius));
  EXPECT_THROW(world.touches({HUGE_VAL, 0.0}, kRadius), std::invalid_argument);
}

TEST(CircleWorld, CastsTheSameRangesAsBruteForce) {
  Random random(11);
  std::vector<Circle> circles;
  for (int i = 0; i < 40; ++i) {
    circles.push_back({{uniform(random, -5.0, 5.0), uniform(random, -5.0, 5.0)}, uniform(random, 0.02, 0.4)});
  }
  const CircleWorld world(circles);
  for (const double increment : {0.00436332, -0.01, 0.05}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Point2 origin{uniform(random, -6.0, 6.0), uniform(random, -6.0, 6.0)};
      const double first = uniform(random, -10.0, 10.0);
      std::vector<double> ranges(1081);
      world.castRays(origin, first, increment, 7.0, &ranges);
      for (std::size_t beam = 0; beam < ranges.size(); ++beam) {
        const double direction = first + static_cast<double>(beam) * increment;
        double expected = HUGE_VAL;
        for (const Circle& circle : circles) {
          const Point2 center = toLocalFrame({origin.x, origin.y, direction}, circle.center);
          const double inside = circle.radius * circle.radius - center.y * center.y;
          if (std::hypot(center.x, center.y) <= circle.radius) {
            expected = 0.0;
          } else if (inside >= 0.0 && center.x > 0.0) {
            expected = std::min(expected, center.x - std::sqrt(inside));
          }
        }
        if (expected > 7.0) {
          ASSERT_TRUE(std::isinf(ranges[beam])) << increment << " " << trial << " " << beam;
        } else {
          // A grazing ray: its range moves with the root of what rounding does to its direction.
          ASSERT_NEAR(ranges[beam], expected, 1e-6) << increment << " " << trial << " " << beam;
        }
      }
    }
  }
}

TEST(CircleWorld, TouchesExactlyAtTheTangent) {
  const CircleWorld world({{{1.0, 2.0}, 0.075}});
  EXPECT_TRUE(world.touches({1.0 + 0.175 + 0.075 - 1e-6, 2.0}, 0.175));
  EXPECT_FALSE(world.touches({1.0 + 0.175 + 0.075 + 1e-6, 2.0}, 0.175));
  EXPECT_THROW(CircleWorld({{{0.0, 0.0}, -1.0}}), std::invalid_argument);
}

const Footprint& rectangle() {
  static const Footprint footprint({{0.3, 0.2}, {0.3, -0.2}, {-0.1, -0.2}, {-0.1, 0.2}});
  return footprint;
}

TEST(GridWorld, APolygonTouchesExactlyWhereItOverlapsACell) {
  OccupancyGrid grid(40, 40, 0.05);
  grid.set({20, 20}, Cell::kOccupied);  // from (1.0, 1.0) to (1.05, 1.05)
  const GridWorld world(grid);
  EXPECT_TRUE(world.touches(rectangle(), {0.7 + 1e-6, 1.0, 0.0})) << "its front";
  EXPECT_FALSE(world.touches(rectangle(), {0.7 - 1e-6, 1.0, 0.0}));
  EXPECT_TRUE(world.touches(rectangle(), {1.15 - 1e-6, 1.0, 0.0})) << "its back";
  EXPECT_FALSE(world.touches(rectangle(), {1.15 + 1e-6, 1.0, 0.0}));
  // Turned by 45 degrees the corner (0.3, 0.2) points to (0.1, 0.5) / sqrt(2) from its middle.
  const Point2 corner{0.1 * M_SQRT1_2, 0.5 * M_SQRT1_2};
  EXPECT_TRUE(world.touches(rectangle(), {1.025 - corner.x, 1.0 + 1e-6 - corner.y, M_PI_4}));
  EXPECT_FALSE(world.touches(rectangle(), {1.025 - corner.x, 1.0 - 1e-6 - corner.y, M_PI_4}));
  EXPECT_TRUE(world.touches(rectangle(), {1.025, 1.025, 0.2})) << "the cell lies inside it";
  EXPECT_TRUE(world.touches(Footprint(0.2), {0.8 + 1e-6, 1.02, 0.5})) << "a circle, as by its radius";
  EXPECT_FALSE(world.touches(Footprint(0.2), {0.8 - 1e-6, 1.02, 0.5}));
  EXPECT_THROW(world.touches(rectangle(), {HUGE_VAL, 0.0, 0.0}), std::invalid_argument);
}

TEST(CircleWorld, APolygonTouchesExactlyAtTheTangent) {
  const CircleWorld world({{{1.0, 0.0}, 0.1}});
  EXPECT_TRUE(world.touches(rectangle(), {0.6 + 1e-6, 0.0, 0.0}));
  EXPECT_FALSE(world.touches(rectangle(), {0.6 - 1e-6, 0.0, 0.0}));
  // Beside the corner (0.3, -0.2), 45 degrees off.
  const double aside = 0.1 * M_SQRT1_2;
  EXPECT_TRUE(world.touches(rectangle(), {0.7 - aside + 1e-6, 0.2 + aside, 0.0}));
  EXPECT_FALSE(world.touches(rectangle(), {0.7 - aside - 1e-6, 0.2 + aside, 0.0}));
}

}  // namespace
}  // namespace lstm_planner::test_world
