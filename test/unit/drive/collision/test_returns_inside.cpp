#include <gtest/gtest.h>

#include "lstm_planner/drive/collision/returns_inside.hpp"

namespace lstm_planner::test_returns_inside {
namespace {

const Footprint kRobot({{-0.4, -0.3}, {0.1, -0.3}, {0.1, 0.3}, {-0.4, 0.3}});

TEST(ReturnsInside, NamesTheDeepestAndWhatToDo) {
  EXPECT_EQ(returnsInside({{1.0, 0.0}, {-0.3, 0.2}, {0.05, 0.0}}, kRobot),
            "returns of the scan are inside the footprint (2), the deepest 0.10 m, at (-0.30, 0.20) m in the robot's "
            "frame: if it is a part of the robot, filter these beams (package laser_filters) or raise the scanner's "
            "range_min");
  EXPECT_NE(returnsInside({{0.1, 0.0}}, Footprint(0.2)), "");
}

TEST(ReturnsInside, IsNothingOfWhatTouchesTheRobot) {
  EXPECT_EQ(returnsInside({{0.09, 0.0}, {-0.4, 0.1}, {0.5, 0.5}}, kRobot), "");
  EXPECT_EQ(returnsInside({}, kRobot), "");
}

}  // namespace
}  // namespace lstm_planner::test_returns_inside
