#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <tf2_ros/transform_listener.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ros/callback_thread.hpp"
#include "ros/fake_robot.hpp"
#include "ros/hand_made_model.hpp"
#include "ros/log_listener.hpp"
#include "ros/planner/lstm_global_planner.hpp"

namespace lstm_planner {

using Plan = std::vector<geometry_msgs::PoseStamped>;

inline geometry_msgs::PoseStamped stampedPose(const std::string& frame, const Pose2& pose) {
  geometry_msgs::PoseStamped stamped;
  stamped.header.frame_id = frame;
  stamped.pose = toMessage(pose);
  return stamped;
}

/// What a planner published on its topic `decision`.
class DecisionListener {
 public:
  explicit DecisionListener(const std::string& planner)
      : subscriber_(
            callbacks_.nodeHandle("~/" + planner).subscribe("decision", 10, &DecisionListener::onDecision, this)) {}

  /// The values of the newest decision by key, "source" among them; empty before the first.
  std::map<std::string, std::string> newest() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return newest_;
  }
  bool connected() const { return subscriber_.getNumPublishers() > 0; }
  int count() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return count_;
  }

 private:
  void onDecision(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_.clear();
    newest_["source"] = message->status.at(0).message;
    for (const auto& entry : message->status.at(0).values) {
      newest_[entry.key] = entry.value;
    }
    ++count_;
  }

  std::mutex mutex_;
  std::map<std::string, std::string> newest_;
  int count_ = 0;
  CallbackThread callbacks_;
  ros::Subscriber subscriber_;
};

/// A robot with sensors, and planners made as move_base makes them.
class PlannerTest : public testing::Test {
 protected:
  PlannerTest() : tf_listener_(tf_), model_(untaughtModel()) {
    ros::param::set("~/LstmGlobalPlanner/model", model_.path());
    ros::param::set("~/LstmGlobalPlanner/leader", "network");
    ros::param::set("~/planner_frequency", 5.0);
    goal_publisher_ = ros::NodeHandle("~").advertise<geometry_msgs::PoseStamped>("current_goal", 1);
    useGlobalFrame("odom");
  }
  ~PlannerTest() override {
    ros::param::del("~/LstmGlobalPlanner");
    ros::param::del("~/planner_frequency");
    ros::param::del("~/costmap/footprint");
  }

  void useGlobalFrame(const std::string& frame) {
    ros::param::set("~/costmap/global_frame", frame);
    ros::param::set("~/costmap/robot_base_frame", "base_footprint");
    ros::param::set("~/costmap/rolling_window", true);
    ros::param::set("~/costmap/update_frequency", 0.0);
    ros::param::set("~/costmap/plugins", std::vector<std::string>());
    EXPECT_TRUE(eventually([&] {
      robot_.again();
      return tf_.canTransform(frame, "base_footprint", ros::Time(0));
    }));
    costmap_ = std::make_unique<costmap_2d::Costmap2DROS>("costmap", tf_);
  }

  /// The costmap has an obstacle from there to there (m, its own frame), and nothing else.
  void markInCostmap(const Point2& low, const Point2& high) {
    constexpr double kResolution = 0.05;
    constexpr unsigned int kSide = 400;
    constexpr double kCorner = -10.0;
    costmap_2d::Costmap2D& costmap = *costmap_->getCostmap();
    const std::lock_guard<costmap_2d::Costmap2D::mutex_t> lock(*costmap.getMutex());
    costmap.resizeMap(kSide, kSide, kResolution, kCorner, kCorner);
    const auto index = [&](double position) { return static_cast<unsigned int>((position - kCorner) / kResolution); };
    for (unsigned int x = index(low.x); x < index(high.x); ++x) {
      for (unsigned int y = index(low.y); y < index(high.y); ++y) costmap.setCost(x, y, 254);
    }
  }

  /// A rectangle from there to there (m, the robot's frame) is what move_base knows of the robot's shape.
  void useFootprint(const Point2& low, const Point2& high) {
    ros::param::set("~/costmap/footprint", "[]");  // somebody has set it
    std::vector<geometry_msgs::Point> corners(4);
    for (std::size_t i = 0; i < 4; ++i) {
      corners[i].x = i == 0 || i == 3 ? low.x : high.x;
      corners[i].y = i < 2 ? low.y : high.y;
    }
    costmap_->setUnpaddedRobotFootprint(corners);
  }

  /// An initialised planner that has heard scan and odometry; null when it does not plan.
  std::unique_ptr<LstmGlobalPlanner> makePlanner(const std::string& name = "LstmGlobalPlanner") {
    auto planner = std::make_unique<LstmGlobalPlanner>();
    planner->initialize(name, costmap_.get());
    const bool plans = eventually([&] {
      robot_.again();
      return preview(planner.get());
    });
    EXPECT_TRUE(plans);
    return plans ? std::move(planner) : nullptr;
  }

  /// Where the robot is, in the costmap's global frame.
  geometry_msgs::PoseStamped start() const {
    const std::string& frame = costmap_->getGlobalFrameID();
    return stampedPose(frame, frame == "odom" ? robot_.pose() : compose(robot_.odometryInMap(), robot_.pose()));
  }

  bool plan(LstmGlobalPlanner* planner, const geometry_msgs::PoseStamped& goal) {
    return planner->makePlan(start(), goal, plan_);
  }

  /// Asks for a goal that was never asked for before: changes nothing.
  bool preview(LstmGlobalPlanner* planner) {
    never_asked_ += 0.01;
    return plan(planner, stampedPose("odom", {never_asked_, 50.0, 0.0}));
  }

  /// Expects that the planner refuses the goal, and that the log says why. Before each attempt the robot stands for as
  /// long as the planner keeps silent about the same reason, and publishes all it senses.
  void expectNoPlan(LstmGlobalPlanner* planner, const geometry_msgs::PoseStamped& goal, const std::string& reason) {
    log_.expectRefusal([&] { return plan(planner, goal); }, "no plan: " + reason, [&] { stand(kLogPeriod); });
    EXPECT_TRUE(plan_.empty());
  }
  /// Expects that a planner with the parameters as they are is refused at its start, for that reason, and never plans.
  void expectUnusable(const std::string& reason) {
    const auto lines = [&](const std::string& text) {
      log_.flush();
      return log_.count(text);
    };
    const std::string refused = "LstmGlobalPlanner cannot be used: ";
    const int before = lines(refused);
    LstmGlobalPlanner planner;
    EXPECT_NO_THROW(planner.initialize("LstmGlobalPlanner", costmap_.get()));
    EXPECT_EQ(lines(refused), before + 1);
    EXPECT_GT(log_.count(reason), 0) << reason;
    EXPECT_FALSE(preview(&planner)) << reason;
  }
  void stand(double seconds) { robot_.moveTo(robot_.pose(), seconds); }

  /// Moves the robot, and waits until the planner has heard of it.
  void moveTo(LstmGlobalPlanner* planner, const Pose2& pose, double seconds) {
    robot_.moveTo(pose, seconds);
    EXPECT_TRUE(eventually([&] {
      return preview(planner) && std::abs(plan_.front().pose.position.x - pose.x) < 1e-6 &&
             std::abs(plan_.front().pose.position.y - pose.y) < 1e-6;
    }));
  }

  /// move_base accepts a goal; returns when the planner has heard of it.
  void announce(const geometry_msgs::PoseStamped& goal, LstmGlobalPlanner* planner, DecisionListener* decisions) {
    EXPECT_TRUE(eventually([&] { return goal_publisher_.getNumSubscribers() > 0 && decisions->connected(); }));
    const int before = decisions->count();
    goal_publisher_.publish(goal);
    // Only a driven goal's decision is published; a goal that is asked for once would be a question otherwise.
    EXPECT_TRUE(eventually([&] {
      preview(planner);
      return plan(planner, goal) && decisions->count() > before;
    }));
  }

  /// Asks for a plan to the driven goal (in odom) and returns the decision behind it. Decisions of earlier calls may
  /// still be on their way: those made elsewhere are told apart by their distance to the goal.
  std::map<std::string, std::string> decide(LstmGlobalPlanner* planner, const geometry_msgs::PoseStamped& goal,
                                            DecisionListener* decisions) {
    const int before = decisions->count();
    const double distance = distanceBetween(robot_.pose(), goal.pose.position);
    EXPECT_TRUE(plan(planner, goal));
    std::map<std::string, std::string> decision;
    EXPECT_TRUE(eventually([&] {
      decision = decisions->newest();
      return decisions->count() > before && std::abs(std::stod(decision.at("goal_distance")) - distance) < 1e-3;
    })) << "not taken for the driven goal";
    return decision;
  }

  static constexpr double kLogPeriod = 2.05;  ///< s, after which the plugins repeat a line

  FakeRobot robot_;
  LogListener log_;
  tf2_ros::Buffer tf_;
  tf2_ros::TransformListener tf_listener_;
  TemporaryModelFile model_;
  std::unique_ptr<costmap_2d::Costmap2DROS> costmap_;
  ros::Publisher goal_publisher_;
  Plan plan_;

 private:
  double never_asked_ = 50.0;
};

}  // namespace lstm_planner
