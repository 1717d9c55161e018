// The arrows of the layout: robot and grid_world stand on base, never meet, and know no ROS.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

namespace lstm_planner::test_layout {
namespace {

namespace fs = std::filesystem;

/// Calls visit(file, what is included) for every include of the sources and headers of a wing.
template <typename Visitor>
int visitIncludes(const std::string& wing, const Visitor& visit) {
  static const std::regex kInclude(R"rx(^#include [<"]([^>"]+)[>"])rx");
  int files = 0;
  for (const std::string& top : {std::string("/src/"), std::string("/include/lstm_planner/")}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(LSTM_PLANNER_SOURCE_DIR + top + wing)) {
      const std::string kind = entry.path().extension();
      if (kind != ".cpp" && kind != ".hpp") continue;
      ++files;
      std::ifstream file(entry.path());
      std::smatch match;
      for (std::string line; std::getline(file, line);) {
        if (std::regex_search(line, match, kInclude)) visit(entry.path().string(), match[1].str());
      }
    }
  }
  return files;
}

class LayoutTest : public testing::TestWithParam<const char*> {};

TEST_P(LayoutTest, NoHeaderOfRosIsIncluded) {
  // Where ROS comes from the distribution its headers lie in /usr/include, and would be found.
  const std::regex ros(
      "^(ros|tf|tf2|tf2_ros|tf2_geometry_msgs|rosbag|rosgraph|pluginlib|actionlib|nav_core|costmap_2d|"
      "[a-z0-9_]+_(msgs|srvs))/");
  const int files = visitIncludes(GetParam(), [&](const std::string& file, const std::string& included) {
    EXPECT_FALSE(std::regex_search(included, ros)) << file << " includes " << included;
  });
  EXPECT_GT(files, 40);
}

TEST_P(LayoutTest, NothingButBaseAndItselfIsIncluded) {
  const std::string wing = GetParam();
  const std::regex others("^(lstm_planner/)?(robot|grid_world|ros|tools|compat)/");
  const std::regex own("^(lstm_planner/)?" + wing + "/");
  visitIncludes(wing, [&](const std::string& file, const std::string& included) {
    EXPECT_TRUE(!std::regex_search(included, others) || std::regex_search(included, own))
        << file << " includes " << included;
  });
}

INSTANTIATE_TEST_SUITE_P(Wings, LayoutTest, testing::Values("base", "robot", "grid_world"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace lstm_planner::test_layout
