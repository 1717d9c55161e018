#include <gtest/gtest.h>

#include "lstm_planner/drive/plugin_parameters.hpp"

namespace lstm_planner::test_plugin_parameters {
namespace {

TEST(HintAtParameter, OfOtherLocalPlannersIsTheOneThatMeansTheSame) {
  EXPECT_EQ(hintAtParameter("max_vel_x", {"max_angular", "max_linear"}), "; here it is named max_linear");
  EXPECT_EQ(hintAtParameter("xy_goal_tolerance", {"goal_tolerance", "position_tolerance"}),
            "; here it is named position_tolerance")
      << "although the other is spelt more alike";
  EXPECT_EQ(hintAtParameter("xy_goal_tolerance", {"goal_tolerance"}), "; the nearest is goal_tolerance")
      << "only names that there are";
}

}  // namespace
}  // namespace lstm_planner::test_plugin_parameters
