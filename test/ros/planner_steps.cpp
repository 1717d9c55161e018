// When the hidden state advances, when it is forgotten, and when neither. The clock stands still unless a test moves
// it.

#include <actionlib/TestActionGoal.h>
#include <actionlib/TestActionResult.h>
#include <gtest/gtest.h>

#include <atomic>

#include "ros/fixtures/planner_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::planner_steps {
namespace {

const Pose2 kGoal{6.0, 1.0, 0.7};

TEST_F(PlannerTest, QuestionsLeaveTheHiddenStateAlone) {
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  const auto goal = stampedPose("odom", kGoal);
  announce(goal, planner.get(), &decisions);
  const auto first = decisions.newest();
  EXPECT_EQ(first.at("step"), "1");

  for (int i = 0; i < 50; ++i) {
    plan(planner.get(), stampedPose("odom", {5.0 + 0.15 * i, 2.0, 0.0}));
    plan(planner.get(), stampedPose("odom", {-3.0, 2.0, 0.0}));
  }
  EXPECT_EQ(decide(planner.get(), goal, &decisions), first) << "asking twice gives the same answer";
}

TEST_F(PlannerTest, StepsAreTheSameWithAndWithoutQuestionsInBetween) {
  const auto goal = stampedPose("odom", kGoal);
  std::map<std::string, std::string> with_questions;
  std::map<std::string, std::string> without;
  for (auto* result : {&with_questions, &without}) {
    robot_.moveTo({}, 0.1);
    DecisionListener decisions("LstmGlobalPlanner");
    auto planner = makePlanner();
    announce(goal, planner.get(), &decisions);
    for (int step = 1; step <= 5; ++step) {
      moveTo(planner.get(), {0.4 * step, 0.0, 0.0}, 1.0);
      for (int i = 0; result == &with_questions && i < 20; ++i) {
        plan(planner.get(), stampedPose("odom", {-3.0, 2.0 * i, 0.0}));
      }
      *result = decide(planner.get(), goal, &decisions);
    }
    robot_.moveTo({}, 10.0);
  }
  EXPECT_EQ(with_questions.at("step"), "6");
  EXPECT_EQ(with_questions, without);
}

TEST_F(PlannerTest, HiddenStateAdvancesOnceAStepHoweverOftenAPlanIsAskedFor) {
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  const auto goal = stampedPose("odom", kGoal);
  announce(goal, planner.get(), &decisions);
  for (int i = 1; i <= 4; ++i) {
    moveTo(planner.get(), {0.1 * i, 0.0, 0.0}, 0.1);
    // step/length is 0.4 m and step/period 0.5 s: the fourth move ends the step.
    EXPECT_EQ(decide(planner.get(), goal, &decisions).at("step"), i < 4 ? "1" : "2");
  }
}

TEST_F(PlannerTest, AnnouncementStartsTheGoalAnewEvenWhereItIsTheSame) {
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  const auto goal = stampedPose("odom", kGoal);
  announce(goal, planner.get(), &decisions);
  moveTo(planner.get(), {0.5, 0.0, 0.0}, 1.0);
  EXPECT_EQ(decide(planner.get(), goal, &decisions).at("step"), "2");
  goal_publisher_.publish(goal);
  EXPECT_TRUE(eventually([&] { return decide(planner.get(), goal, &decisions).at("step") == "1"; }));
}

TEST_F(PlannerTest, WithoutAnnouncementsANewGoalIsNoticedByItsPose) {
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  ASSERT_TRUE(eventually([&] { return decisions.connected(); }));
  const auto goal = stampedPose("odom", kGoal);
  plan(planner.get(), goal);
  EXPECT_EQ(decide(planner.get(), goal, &decisions).at("step"), "1");
  moveTo(planner.get(), {0.5, 0.0, 0.0}, 1.0);
  EXPECT_EQ(decide(planner.get(), goal, &decisions).at("step"), "2");

  const auto other = stampedPose("odom", {-4.0, 0.0, 0.0});
  int before = decisions.count();
  plan(planner.get(), other);
  for (int i = 0; i < 5; ++i) {
    robot_.again();
    plan(planner.get(), other);
  }
  decide(planner.get(), goal, &decisions);
  EXPECT_EQ(decisions.count(), before + 1) << "for a second it may still be a question";
  ++before;
  EXPECT_TRUE(eventually([&] {
    robot_.again();
    plan(planner.get(), other);
    return decisions.count() > before;
  }));
  EXPECT_EQ(decisions.newest().at("step"), "1");
}

/// move_base_flex announces a goal before each plan, as it was given, and asks for it in the costmap's frame.
TEST_F(PlannerTest, InMoveBaseFlexAGoalIsNewOnce) {
  ros::param::set("~/planners", std::vector<std::string>{"a list of planners"});
  DecisionListener decisions("LstmGlobalPlanner");
  for (const char* topic : {"planner_goal", "current_goal"}) {
    robot_.moveTo({}, 10.0);
    auto planner = makePlanner();
    ros::NodeHandle node("~");
    const auto goals = node.advertise<geometry_msgs::PoseStamped>(topic, 1);
    std::atomic<int> heard{0};
    const auto hear = [&](const geometry_msgs::PoseStamped::ConstPtr&) { ++heard; };
    const auto after_the_planner = node.subscribe<geometry_msgs::PoseStamped>(topic, 1, hear);
    ASSERT_TRUE(eventually([&] { return goals.getNumSubscribers() > 0 && decisions.connected(); }));
    const auto step = [&] {
      const int before = heard;
      goals.publish(stampedPose("map", compose(robot_.odometryInMap(), kGoal)));
      EXPECT_TRUE(eventually([&] { return heard > before; }));
      return decide(planner.get(), stampedPose("odom", kGoal), &decisions).at("step");
    };
    EXPECT_EQ(step(), "1");
    moveTo(planner.get(), {0.5, 0.0, 0.0}, 0.9);
    EXPECT_EQ(step(), "2");
    moveTo(planner.get(), {0.6, 0.0, 0.0}, 1.1);
    EXPECT_EQ(step(), "1") << "sent again";
  }
}

/// Exploration gives its goal anew, and moved by centimetres, every few seconds.
TEST_F(PlannerTest, AGoalThatIsGivenAnewNearByIsTheSameUntilItsDriveHasEnded) {
  using Status = actionlib_msgs::GoalStatus;
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  ros::NodeHandle node;
  const auto starts = node.advertise<actionlib::TestActionGoal>("move_base/goal", 1);
  const auto ends = node.advertise<actionlib::TestActionResult>("move_base/result", 1);
  std::atomic<int> heard{0};  // by the planner, too, which has subscribed before
  const auto hear_start = [&](const actionlib::TestActionGoal::ConstPtr&) { ++heard; };
  const auto hear_end = [&](const actionlib::TestActionResult::ConstPtr&) { ++heard; };
  const auto start_hearer = node.subscribe<actionlib::TestActionGoal>("move_base/goal", 1, hear_start);
  const auto end_hearer = node.subscribe<actionlib::TestActionResult>("move_base/result", 1, hear_end);
  ASSERT_TRUE(eventually([&] { return starts.getNumSubscribers() > 0 && ends.getNumSubscribers() > 0; }));
  const auto publish = [&](const ros::Publisher& publisher, const auto& message) {
    const int before = heard;
    publisher.publish(message);
    EXPECT_TRUE(eventually([&] { return heard > before; }));
  };
  const auto end = [&](Status::_status_type status, const char* text) {
    actionlib::TestActionResult result;
    result.status.status = status;
    result.status.text = text;
    publish(ends, result);
  };
  const auto give = [&](double x) {
    publish(starts, actionlib::TestActionGoal());
    const auto goal = stampedPose("odom", {x, 1.0, 0.7});
    announce(goal, planner.get(), &decisions);
    EXPECT_EQ(plan_.back().pose.position.x, x);
    return decide(planner.get(), goal, &decisions).at("step");
  };
  EXPECT_EQ(give(6.0), "1");
  moveTo(planner.get(), {0.5, 0.0, 0.0}, 1.0);
  end(Status::PREEMPTED, "This goal was canceled because another goal was recieved by the simple action server");
  EXPECT_EQ(give(6.02), "2");
  end(Status::ABORTED, "");
  EXPECT_EQ(give(6.02), "1");
}

/// move_base announces such a goal in each cycle, as tf refuses the slash.
TEST_F(PlannerTest, AGoalThatMoveBaseCannotTransformIsRefused) {
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  const auto goal = stampedPose("/map", compose(robot_.odometryInMap(), kGoal));
  ASSERT_TRUE(eventually([&] { return goal_publisher_.getNumSubscribers() > 0 && decisions.connected(); }));
  int attempts = 0;
  const auto ask = [&] {
    ++attempts;
    bool is_planned = false;
    for (int i = 0; i < 5; ++i) {
      goal_publisher_.publish(boost::make_shared<geometry_msgs::PoseStamped>(goal));
      robot_.wait(0.05);
      is_planned = plan(planner.get(), goal);
    }
    return is_planned;
  };
  log_.expectRefusal(ask, "no plan: move_base could not transform the goal from frame '/map' to odom: its log says why",
                     [&] { stand(kLogPeriod); });
  EXPECT_LE(log_.count("new goal ("), attempts) << "at most one of five announcements each time";
  const auto in_odom = stampedPose("odom", kGoal);
  announce(in_odom, planner.get(), &decisions);
  EXPECT_EQ(decide(planner.get(), in_odom, &decisions).at("step"), "1");
}

TEST_F(PlannerTest, OdometryJumpForgetsThePathAndKeepsTheGoal) {
  DecisionListener decisions("LstmGlobalPlanner");
  auto planner = makePlanner();
  const auto goal = stampedPose("odom", kGoal);
  announce(goal, planner.get(), &decisions);
  moveTo(planner.get(), {0.5, 0.0, 0.0}, 1.0);
  EXPECT_EQ(decide(planner.get(), goal, &decisions).at("step"), "2");
  moveTo(planner.get(), {3.0, -2.0, 1.0}, 0.1);  // 3.2 m in 0.1 s
  EXPECT_EQ(decide(planner.get(), goal, &decisions).at("step"), "1");
  EXPECT_NEAR(plan_.back().pose.position.x, kGoal.x, 1e-9);
}

TEST_F(PlannerTest, GoalSeekingModelOfTheLaunchFilesIsTheOneMadeByHand) {
  const Model file = readModelFile(LSTM_PLANNER_SOURCE_DIR "/test/models/goal_seeking.onnx");
  const Model hand_made = goalSeekingModel();
  ASSERT_EQ(file.layers.size(), 1u);
  EXPECT_EQ(std::get<DenseLayer>(file.layers[0]).weights, std::get<DenseLayer>(hand_made.layers[0]).weights);
  for (const auto& [key, value] : hand_made.metadata) {
    EXPECT_EQ(file.metadata.at(key), value);
  }
}

const RosProgram program("planner_steps", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::planner_steps
