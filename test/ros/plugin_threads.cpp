// The plugins in a process with several threads: asked in one while messages arrive in others, loaded and unloaded
// meanwhile, and two of a kind at once. test/sanitize.sh runs it under the thread sanitizer.

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "ros/fixtures/diagnostics_listener.hpp"
#include "ros/fixtures/planner_fixture.hpp"
#include "ros/fixtures/plugin_loader.hpp"
#include "ros/fixtures/process_figures.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::plugin_threads {
namespace {

/// The robot's messages, sent without a pause by a thread of its own, as long as the object lives.
class Traffic {
 public:
  explicit Traffic(FakeRobot* robot)
      : thread_([this, robot] {
          while (!finished_) {
            robot->again();
            ros::WallDuration(0.0005).sleep();
          }
        }) {}
  ~Traffic() {
    finished_ = true;
    thread_.join();
  }
  Traffic(const Traffic&) = delete;
  Traffic& operator=(const Traffic&) = delete;

 private:
  std::atomic<bool> finished_{false};
  std::thread thread_;
};

class PluginThreads : public PlannerTest {
 protected:
  PluginThreads() : planners_(plannerLoader()), controllers_(controllerLoader()) {}
  ~PluginThreads() override { ros::param::del("~/second"); }

  boost::shared_ptr<nav_core::BaseGlobalPlanner> loadPlanner(const std::string& name) {
    const auto planner = planners_->createInstance("lstm_planner/LstmGlobalPlanner");
    planner->initialize(name, costmap_.get());
    return planner;
  }
  boost::shared_ptr<nav_core::BaseLocalPlanner> loadController() {
    const auto controller = controllers_->createInstance("lstm_planner/SteeringController");
    controller->initialize("SteeringController", &tf_, costmap_.get());
    return controller;
  }

  /// As move_base does without end: a plan, and a command for it. True when there were both.
  bool planAndFollow(nav_core::BaseGlobalPlanner* planner, nav_core::BaseLocalPlanner* controller, const Pose2& goal) {
    Plan plan;
    geometry_msgs::Twist velocity;
    return planner->makePlan(stampedPose("odom", {}), stampedPose("odom", goal), plan) && controller->setPlan(plan) &&
           controller->computeVelocityCommands(velocity) && !controller->isGoalReached();
  }

  std::unique_ptr<PlannerLoader> planners_;
  std::unique_ptr<ControllerLoader> controllers_;
};

TEST_F(PluginThreads, PlanAndFollowWhileMessagesArriveInOthers) {
  const auto planner = loadPlanner("LstmGlobalPlanner");
  const auto controller = loadController();
  const Traffic traffic(&robot_);
  ASSERT_TRUE(eventually([&] { return planAndFollow(planner.get(), controller.get(), {6.0, 1.0, 0.0}); }));
  // move_base answers make_plan in another thread than it plans in.
  std::atomic<bool> finished{false};
  std::thread questions([&] {
    Plan plan;
    for (int i = 0; !finished; ++i)
      planner->makePlan(stampedPose("odom", {}), stampedPose("odom", {-3.0, 0.1 * i, 0.0}), plan);
  });
  int driven = 0;
  for (int i = 0; i < 200; ++i) driven += planAndFollow(planner.get(), controller.get(), {6.0, 1.0, 0.0}) ? 1 : 0;
  finished = true;
  questions.join();
  // A computer that is too busy for its messages makes scans too old, not plans wrong.
  EXPECT_GT(driven, 0);
}

TEST_F(PluginThreads, SayHowTheyAreWhilePlansAndMessagesAreMade) {
  DiagnosticsListener of_planner("LstmGlobalPlanner");
  DiagnosticsListener of_controller("SteeringController");
  const Traffic traffic(&robot_);
  // Unloaded at any moment of the threads that make the diagnostics.
  for (int i = 0; i < 3; ++i) {
    const auto planner = loadPlanner("LstmGlobalPlanner");
    const auto controller = loadController();
    const std::string before =
        DiagnosticsListener::valueOf("age (s)", of_controller.task("SteeringController odometry"));
    EXPECT_TRUE(eventually([&] {
      planAndFollow(planner.get(), controller.get(), {6.0, 1.0, 0.0});
      return !of_planner.latched().message.empty() && !of_controller.latched().message.empty() &&
             !of_planner.task("LstmGlobalPlanner model").message.empty() &&
             DiagnosticsListener::valueOf("age (s)", of_controller.task("SteeringController odometry")) != before;
    }));
  }
}

TEST_F(PluginThreads, LoadAndUnloadUnderTraffic) {
  const int repetitions = ros::param::param("~repetitions", 20);
  const Traffic traffic(&robot_);
  int driven = 0;
  int threads = 0;
  int descriptors = 0;
  for (int i = 0; i < repetitions; ++i) {
    {
      const auto planner = loadPlanner("LstmGlobalPlanner");
      const auto controller = loadController();
      driven += eventually([&] { return planAndFollow(planner.get(), controller.get(), {6.0, 1.0, 0.0}); }) ? 1 : 0;
    }
    planners_ = plannerLoader();
    controllers_ = controllerLoader();
    if (i == repetitions / 2) {
      threads = countThreads();
      descriptors = countDescriptors();
    }
  }
  EXPECT_EQ(driven, repetitions);
  // Connections of the last instance may still be closing.
  EXPECT_TRUE(eventually([&] { return countThreads() <= threads && countDescriptors() <= descriptors; }))
      << threads << " threads have become " << countThreads() << ", " << descriptors << " descriptors "
      << countDescriptors();
}

TEST_F(PluginThreads, TwoPlannersInOneProcessDoNotKnowOfEachOther) {
  ros::param::set("~/second/model", model_.path());
  ros::param::set("~/second/leader", "route");
  const Pose2 goal{6.0, 1.0, 0.0};
  const Pose2 other_goal{-4.0, 2.0, 0.0};
  const auto sameAs = [](const Plan& a, const Plan& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
      return one.pose.position.x == other.pose.position.x && one.pose.position.y == other.pose.position.y;
    });
  };
  // What each plans while it is alone, and while the other one drives somewhere else in another thread.
  const auto planWith = [&](nav_core::BaseGlobalPlanner* planner, const Pose2& to) {
    Plan plan;
    EXPECT_TRUE(eventually([&] {
      robot_.again();
      return planner->makePlan(stampedPose("odom", {}), stampedPose("odom", to), plan);
    }));
    return plan;
  };
  const Plan alone = planWith(loadPlanner("LstmGlobalPlanner").get(), goal);
  const Plan other_alone = planWith(loadPlanner("second").get(), other_goal);

  const auto first = loadPlanner("LstmGlobalPlanner");
  const auto second = loadPlanner("second");
  planWith(first.get(), goal);
  planWith(second.get(), other_goal);
  const auto repeat = [&](nav_core::BaseGlobalPlanner* planner, const Pose2& to, const Plan& expected, int* different) {
    Plan plan;
    for (int i = 0; i < 200; ++i) {
      if (!planner->makePlan(stampedPose("odom", {}), stampedPose("odom", to), plan) || !sameAs(plan, expected)) {
        ++*different;
      }
    }
  };
  int different = 0;
  int other_different = 0;
  std::thread thread([&] { repeat(second.get(), other_goal, other_alone, &other_different); });
  repeat(first.get(), goal, alone, &different);
  thread.join();
  EXPECT_EQ(different, 0);
  EXPECT_EQ(other_different, 0);
}

const RosProgram program("plugin_threads", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::plugin_threads
