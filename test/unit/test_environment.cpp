// launch/environment.sh: which ROS it finds, and what it asks apt for. Nothing is installed here.

#include <gtest/gtest.h>

#include <string>

#include "support/folder_test.hpp"
#include "support/shell.hpp"

namespace lstm_planner::test_environment {
namespace {

class Environment : public test::FolderTest {
 protected:
  /// What `commands` print with the script's functions, where apt could install `packages` and the folder of the test
  /// stands for /opt/ros.
  std::string says(const std::string& commands, const std::string& packages = "", const std::string& distro = "") {
    const std::string apt = "installable() { grep -xF -e none " + packages + "; }; ";
    const std::string script = "unset ROS_DISTRO; " + (distro.empty() ? "" : "ROS_DISTRO=" + distro + "; ") +
                               "source '" LSTM_PLANNER_SOURCE_DIR "/launch/environment.sh'; ros_folder='" + folder_ +
                               "'; workspace='" + folder_ + "'; " + apt + commands;
    return test::runShell("bash -c \"" + script + "\"").output;
  }
  bool has(const std::string& text, const std::string& line) {
    return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
  }
};

TEST_F(Environment, FindsTheRosThatIsInstalled) {
  scratch_.write("one/setup.bash", "");
  EXPECT_EQ(says("find_ros_flavour"), "one\n");
  scratch_.write("noetic/setup.bash", "");
  EXPECT_EQ(says("find_ros_flavour"), "noetic\n");
  EXPECT_EQ(says("find_ros_flavour", "", "one"), "one\n") << "the shell's";
  scratch_.write("humble/setup.bash", "");
  EXPECT_EQ(says("find_ros_flavour", "", "humble"), "noetic\n") << "that is ROS 2";
}

TEST_F(Environment, FindsTheRosThatAptHas) {
  EXPECT_EQ(says("find_ros_flavour", "-e ros-one-catkin"), "one\n");
  EXPECT_EQ(says("find_ros_flavour", "-e ros-noetic-catkin"), "noetic\n");
}

TEST_F(Environment, AsksAptForThePackagesOfRosOne) {
  const std::string required = says("required_packages one");
  EXPECT_TRUE(has(required, "ros-one-roscpp")) << required;
  EXPECT_FALSE(has(required, "ros-one-move-base")) << "it builds without";
  EXPECT_EQ(required.find("noetic"), std::string::npos);
  EXPECT_TRUE(has(says("optional_packages one"), "ros-one-move-base"));
  EXPECT_TRUE(has(says("required_packages noetic"), "ros-noetic-move-base"));
}

TEST_F(Environment, SaysLoudlyThatTheStandInTookThePlaceOfMoveBase) {
  EXPECT_EQ(says("say_which_move_base one"), "");
  scratch_.write("devel/lib/lstm_planner/standalone_move_base", "");
  says("chmod +x " + folder_ + "/devel/lib/lstm_planner/standalone_move_base");
  const std::string said = says("say_which_move_base one");
  EXPECT_NE(said.find("ATTENTION: the navigation stack is not installed."), std::string::npos) << said;
  EXPECT_NE(said.find("ros-one-move-base ros-one-nav-core"), std::string::npos) << said;
  EXPECT_EQ(says("say_which_move_base distribution"), "") << "Debian has no other";
}

}  // namespace
}  // namespace lstm_planner::test_environment
