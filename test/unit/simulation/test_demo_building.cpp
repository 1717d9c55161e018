// The demo is of no use when nobody could drive it.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <string>

#include "lstm_planner/grid/distance_field.hpp"
#include "lstm_planner/grid/map_server_map.hpp"

namespace lstm_planner::test_demo_building {
namespace {

const std::string kConfig = LSTM_PLANNER_SOURCE_DIR "/config/";

class DemoBuilding : public ::testing::Test {
 protected:
  CellIndex cellOf(double x, double y) const { return map_.cellAt({x, y}); }

  const OccupancyGrid map_ = readMapServerMap(kConfig + "demo_building.yaml");
  const DistanceField distances_{map_, true};
  const YAML::Node scenario_ = YAML::LoadFile(kConfig + "demo_goals.yaml");
  const YAML::Node start_ = scenario_["start"];
};

TEST_F(DemoBuilding, LetsTheRobotReachEveryGoalFromItsStart) {
  ASSERT_EQ(scenario_["frame"].as<std::string>(), "map");
  ASSERT_EQ(scenario_["goals"].size(), 5u);
  GeodesicField::Options robot;
  robot.clearance = 0.3485 / 2.0 + 0.1;  // its radius, and room to steer
  for (const YAML::Node& goal : scenario_["goals"]) {
    const GeodesicField paths(map_, distances_, cellOf(goal["x"].as<double>(), goal["y"].as<double>()), robot);
    const double length = paths.at(cellOf(start_[0].as<double>(), start_[1].as<double>()));
    EXPECT_TRUE(std::isfinite(length)) << goal["name"].as<std::string>();
    EXPECT_GT(length, 5.0) << goal["name"].as<std::string>() << " is in another room";
  }
}

TEST_F(DemoBuilding, IsClosedToTheOutside) {
  for (int column = 0; column < map_.columns(); ++column) {
    EXPECT_EQ(map_.at({column, 0}), Cell::kOccupied);
    EXPECT_EQ(map_.at({column, map_.rows() - 1}), Cell::kOccupied);
  }
  for (int row = 0; row < map_.rows(); ++row) {
    EXPECT_EQ(map_.at({0, row}), Cell::kOccupied);
    EXPECT_EQ(map_.at({map_.columns() - 1, row}), Cell::kOccupied);
  }
}

}  // namespace
}  // namespace lstm_planner::test_demo_building
