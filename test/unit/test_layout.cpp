// The arrows of the layout, and that the libraries know no ROS.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <regex>
#include <string>
#include <vector>

namespace lstm_planner::test_layout {
namespace {

namespace fs = std::filesystem;

/// Calls visit(file, what is included) for every include of the sources and headers of a library's folder.
template <typename Visitor>
int visitIncludes(const std::string& folder, const Visitor& visit) {
  static const std::regex kInclude(R"rx(^#include [<"]([^>"]+)[>"])rx");
  int files = 0;
  for (const std::string& top : {std::string("/src/"), std::string("/include/lstm_planner/")}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(LSTM_PLANNER_SOURCE_DIR + top + folder)) {
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

/// The folders of a library, and those of the libraries that it stands on.
struct Library {
  const char* name;
  std::vector<std::string> folders;
  std::vector<std::string> stands_on;
};
std::ostream& operator<<(std::ostream& out, const Library& library) { return out << library.name; }

const std::vector<std::string> kCore = {"common", "grid", "network"};
const Library kLibraries[] = {
    {"core", kCore, {}},
    {"drive", {"drive"}, kCore},
    {"training", {"training"}, kCore},
    {"simulation", {"simulation"}, {"common", "grid", "network", "drive"}},
    {"dataset", {"dataset"}, {"common", "grid", "network", "drive"}},
    {"practice", {"practice"}, {"common", "grid", "network", "drive", "simulation", "dataset", "training"}},
    {"grid_world", {"grid_world"}, {"common", "grid", "network", "training"}},
};

class LayoutTest : public testing::TestWithParam<Library> {};

TEST_P(LayoutTest, NoHeaderOfRosIsIncluded) {
  // Where ROS comes from the distribution its headers lie in /usr/include, and would be found.
  const std::regex ros(
      "^(ros|tf|tf2|tf2_ros|tf2_geometry_msgs|rosbag|rosgraph|pluginlib|actionlib|nav_core|costmap_2d|"
      "[a-z0-9_]+_(msgs|srvs))/");
  int files = 0;
  for (const std::string& folder : GetParam().folders) {
    files += visitIncludes(folder, [&](const std::string& file, const std::string& included) {
      EXPECT_FALSE(std::regex_search(included, ros)) << file << " includes " << included;
    });
  }
  EXPECT_GT(files, 30);
}

TEST_P(LayoutTest, NothingIsIncludedButWhatItStandsOn) {
  const std::regex any(
      "^(?:lstm_planner/)?(common|grid|network|drive|simulation|dataset|training|practice|grid_world|ros|"
      "tools|compat)/");
  std::vector<std::string> allowed = GetParam().stands_on;
  allowed.insert(allowed.end(), GetParam().folders.begin(), GetParam().folders.end());
  for (const std::string& folder : GetParam().folders) {
    visitIncludes(folder, [&](const std::string& file, const std::string& included) {
      std::smatch match;
      if (!std::regex_search(included, match, any)) return;
      EXPECT_NE(std::find(allowed.begin(), allowed.end(), match[1].str()), allowed.end())
          << file << " includes " << included;
    });
  }
}

/// The rooms of the drive library, each stands on those before it.
TEST(DriveLayout, NothingIsIncludedFromARoomThatStandsOnThisOne) {
  const std::vector<std::string> rooms = {"perception", "collision", "local_map", "decision", "motion"};
  const std::regex room("^(?:lstm_planner/)?drive/([a-z_]+)/");
  for (auto here = rooms.begin(); here != rooms.end(); ++here) {
    const int files = visitIncludes("drive/" + *here, [&](const std::string& file, const std::string& included) {
      std::smatch match;
      if (!std::regex_search(included, match, room)) return;
      EXPECT_NE(std::find(rooms.begin(), here + 1, match[1].str()), here + 1) << file << " includes " << included;
    });
    EXPECT_GT(files, 4) << *here;
  }
}

INSTANTIATE_TEST_SUITE_P(Libraries, LayoutTest, testing::ValuesIn(kLibraries),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace lstm_planner::test_layout
