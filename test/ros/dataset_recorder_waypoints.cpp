// Goals that the recorder picks itself.

#include <mutex>

#include "ros/fixtures/recorder_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::dataset_recorder_waypoints {
namespace {

/// Hears the goals like somebody who is to drive there.
class GoalWatcher {
 public:
  GoalWatcher()
      : subscriber_(callbacks_.nodeHandle().subscribe("dataset_recorder/goal", 10, &GoalWatcher::onGoal, this)) {}

  std::vector<geometry_msgs::PoseStamped> goals() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return goals_;
  }

 private:
  void onGoal(const geometry_msgs::PoseStamped::ConstPtr& goal) {
    const std::lock_guard<std::mutex> lock(mutex_);
    goals_.push_back(*goal);
  }

  std::mutex mutex_;
  std::vector<geometry_msgs::PoseStamped> goals_;
  CallbackThread callbacks_;
  ros::Subscriber subscriber_;
};

class RecorderWaypointTest : public RecorderTest {
 protected:
  void setWaypoints(const std::vector<double>& along_the_x_axis) {
    XmlRpc::XmlRpcValue list;
    for (std::size_t i = 0; i < along_the_x_axis.size(); ++i) {
      XmlRpc::XmlRpcValue& waypoint = list[static_cast<int>(i)];
      waypoint["name"] = "place " + std::to_string(i);
      waypoint["x"] = along_the_x_axis[i];
      waypoint["y"] = 0.0;
    }
    ros::param::set("/dataset_recorder/waypoints", list);
  }

  /// Drives to so many goals, one after another, and returns where they were.
  std::vector<double> follow(std::size_t count) {
    // Whoever drives may come late: the recorder is at work already.
    GoalWatcher watcher;
    std::vector<double> places;
    while (places.size() < count) {
      EXPECT_TRUE(eventually([&] {
        if (watcher.goals().size() > places.size()) return true;
        stand(kTick);
        return false;
      }));
      if (HasFailure()) break;
      const geometry_msgs::PoseStamped goal = watcher.goals().at(places.size());
      EXPECT_EQ(goal.header.frame_id, "odom");
      places.push_back(goal.pose.position.x);
      drive({places.back(), 0.0, 0.0}, 0.1 * std::round(10.0 * std::abs(places.back() - robot_.pose().x)) + kTick);
    }
    return places;
  }
};

TEST_F(RecorderWaypointTest, AreGivenOutOneAfterAnother) {
  setWaypoints({1.0, 2.0, 3.0});
  start();
  const std::vector<double> places = follow(6);
  for (std::size_t i = 1; i < places.size(); ++i) EXPECT_NE(places[i], places[i - 1]);
  stand(1.0);
  const Dataset dataset = finish();
  const std::vector<RecordedEpisode>& episodes = dataset.recordings.at(0).episodes;
  ASSERT_GE(episodes.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(episodes[i].episode.goal_source, "waypoints");
    EXPECT_DOUBLE_EQ(episodes[i].episode.goal.pose.x, places[i]);
    EXPECT_EQ(episodes[i].episode.end, EpisodeEnd::kArrived);
  }
}

TEST_F(RecorderWaypointTest, ComeInTheOrderOfTheSeed) {
  setWaypoints({1.0, 2.0, 3.0, 4.0, 5.0});
  start();
  const std::vector<double> places = follow(5);
  robot_.moveTo({0.0, 0.0, 0.0}, 10.0);
  start();
  EXPECT_EQ(follow(5), places);
  robot_.moveTo({0.0, 0.0, 0.0}, 10.0);
  start({"_seed:=2"});
  EXPECT_NE(follow(5), places);
}

TEST_F(RecorderWaypointTest, ANewOneIsGivenOutWhenOneIsCancelled) {
  setWaypoints({20.0, 30.0});
  start();
  GoalWatcher watcher;
  ASSERT_TRUE(eventually([&] { return watcher.goals().size() == 1; }));
  giveCancel("");
  ASSERT_TRUE(eventually([&] {
    stand(kTick);
    return watcher.goals().size() == 2;
  }));
  EXPECT_NE(watcher.goals()[1].pose.position.x, watcher.goals()[0].pose.position.x);
}

TEST_F(RecorderWaypointTest, GivePathToAGoalThatSomebodySets) {
  setWaypoints({20.0, 30.0});
  start();
  GoalWatcher watcher;
  giveGoal(goalAt(2.0, 0.0));
  drive({2.0, 0.0, 0.0}, 4.0);
  ASSERT_TRUE(eventually([&] {
    stand(kTick);
    return watcher.goals().size() == 2;
  })) << "the next one after arriving there";
  EXPECT_EQ(count("episodes arrived"), 1);
}

TEST_F(RecorderWaypointTest, AreAtLeastTwo) {
  setWaypoints({1.0});
  recorder_ = launch("dataset_recorder", {});
  EXPECT_EQ(recorder_->wait(), 1);
  EXPECT_NE(recorder_->printed().find("parameter waypoints is 1, expected a list of none or of at least two"),
            std::string::npos)
      << recorder_->printed();
}

const RosProgram program("dataset_recorder_waypoints", &runTests);

}  // namespace
}  // namespace lstm_planner::dataset_recorder_waypoints
