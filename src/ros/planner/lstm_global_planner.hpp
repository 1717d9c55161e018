#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <geometry_msgs/PoseStamped.h>
#include <nav_core/base_global_planner.h>
#include <ros/time.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ros/common/arrival_teller.hpp"

namespace diagnostic_updater {
class DiagnosticStatusWrapper;
}

namespace lstm_planner {

class PlanMaker;
class PluginDiagnostics;

/// The global planner plugin for move_base: plans from the laser scan, the odometry and a recurrent network, without a
/// map.
///
/// A plan starts at the robot, goes through the waypoint that the network chose for the current step, on through what
/// the scan shows free, and ends at the goal. Most of it is a guess that is replaced while the robot drives, so
/// move_base's planner_frequency must be above 0. Obstacles of the costmap that the scan does not show count, too
/// (CostmapReader).
///
/// Subscribes scan, odom (topics are parameters), and what GoalListener does. Publishes, in "~/" +
/// name: plan (nav_msgs/Path), markers (visualization_msgs/MarkerArray), decision
/// (diagnostic_msgs/DiagnosticArray), status (latched: who leads, or why there is no plan;
/// diagnostic_msgs/DiagnosticStatus), arrival (latched: how the last drive ended; the same type); and /diagnostics.
/// Parameters: GlobalPlannerParameters; some may change while it drives (dynamic_reconfigure). Thread safe; nothing is
/// ever thrown out of it.
class LstmGlobalPlanner : public nav_core::BaseGlobalPlanner, public ArrivalTeller {
 public:
  LstmGlobalPlanner();
  ~LstmGlobalPlanner() override;

  /// On bad parameters or a bad model: logs FATAL with the reason; the planner then refuses every plan.
  void initialize(std::string name, costmap_2d::Costmap2DROS* costmap_ros) override;

  using nav_core::BaseGlobalPlanner::makePlan;
  /// False, with a throttled line that says why, when no plan can be given now.
  bool makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                std::vector<geometry_msgs::PoseStamped>& plan) override;

  std::string besideGoal() override;

 private:
  /// What was answered last about the goal that the robot drives to, and when.
  struct Answer {
    std::string refusal;      ///< empty: there was a plan
    bool is_decided = false;  ///< the decision is of that moment, too: the answer was not refused before
    ros::SteadyTime time;
    double duration = 0.0;  ///< s
    double longest = 0.0;   ///< s, of all so far
  };

  void setUp(const std::string& name, costmap_2d::Costmap2DROS* costmap_ros);
  void refuse(const std::string& name, const std::string& reason);
  void note(const std::string& refusal, const ros::SteadyTime& begin);
  void startDiagnostics(const std::string& name);
  bool isAsked() const;
  void describeState(diagnostic_updater::DiagnosticStatusWrapper* status) const;
  void describeFigures(diagnostic_updater::DiagnosticStatusWrapper* status) const;
  void describeModel(diagnostic_updater::DiagnosticStatusWrapper* status) const;

  /// Null until initialised, or if not used. Its mutex is taken before the other one.
  std::atomic<costmap_2d::Costmap2DROS*> costmap_{nullptr};
  std::mutex mutex_;
  std::unique_ptr<PlanMaker> plan_maker_;                          ///< null until initialised
  std::string why_unusable_ = "initialize() has not been called";  ///< as long as it is not
  std::string model_;                                              ///< path
  Answer answer_;
  // Last: they ask for what is above.
  std::unique_ptr<PluginDiagnostics> diagnostics_;
  std::shared_ptr<void> reconfigure_;  ///< see serveReconfiguration()
};

}  // namespace lstm_planner
