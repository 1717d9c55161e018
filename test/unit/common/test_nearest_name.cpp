#include <gtest/gtest.h>

#include "lstm_planner/common/nearest_name.hpp"

namespace lstm_planner::test_nearest_name {
namespace {

const std::vector<std::string> kNames = {"goals", "walkers", "worlds", "iterations", "step/length", "step/turn"};

TEST(NearestName, IsTheOneWithTheFewestSlips) {
  EXPECT_EQ(nearestName("goal", kNames), "goals") << "a letter is missing";
  EXPECT_EQ(nearestName("goalss", kNames), "goals") << "a letter too many";
  EXPECT_EQ(nearestName("wolkers", kNames), "walkers") << "a wrong letter";
  EXPECT_EQ(nearestName("gaols", kNames), "goals") << "two are exchanged";
  EXPECT_EQ(nearestName("step/lenght", kNames), "step/length");
}

TEST(NearestName, IsTheOneThatBeginsAlike) { EXPECT_EQ(nearestName("iter", kNames), "iterations"); }

TEST(NearestName, OfWhatIsFarFromAllIsNone) {
  EXPECT_EQ(nearestName("temperature", kNames), "");
  EXPECT_EQ(nearestName("datset", {"rate"}), "") << "half of the letters are others";
  EXPECT_EQ(nearestName("", kNames), "");
  EXPECT_EQ(nearestName("goals", {}), "");
  EXPECT_EQ(nearestName(std::string(100000, 'a'), kNames), "");
}

TEST(NearestName, EndsASentence) {
  EXPECT_EQ(hintAt("gaols", kNames), "; the nearest is goals");
  EXPECT_EQ(hintAt("temperature", kNames), "");
}

}  // namespace
}  // namespace lstm_planner::test_nearest_name
