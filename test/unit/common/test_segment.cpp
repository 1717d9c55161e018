#include <gtest/gtest.h>

#include "lstm_planner/common/segment.hpp"

namespace lstm_planner::test_segment {
namespace {

TEST(Segment, TheDistanceIsFromTheNearestPointOfIt) {
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({1.0, 2.0}, {0.0, 0.0}, {4.0, 0.0}), 4.0);
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({-3.0, 4.0}, {0.0, 0.0}, {4.0, 0.0}), 25.0) << "before its start";
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({5.0, -1.0}, {0.0, 0.0}, {4.0, 0.0}), 2.0) << "behind its end";
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({1.0, 1.0}, {0.0, 1.0}, {0.0, 1.0}), 1.0) << "a single point";
}

}  // namespace
}  // namespace lstm_planner::test_segment
