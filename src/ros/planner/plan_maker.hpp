#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/time.h>
#include <tf2_ros/buffer.h>

#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/drive/decision/goal_changes.hpp"
#include "lstm_planner/drive/decision/goal_tracker.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/perception/correction_watch.hpp"
#include "lstm_planner/drive/perception/drift_correction.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/common/transform_listener.hpp"
#include "lstm_planner/ros/planner/decision_publisher.hpp"
#include "lstm_planner/ros/planner/marker_publisher.hpp"
#include "ros/common/costmap_reader.hpp"
#include "ros/common/frame_transformer.hpp"
#include "ros/common/goal_listener.hpp"
#include "ros/common/message_queue.hpp"
#include "ros/common/sensor_listener.hpp"
#include "ros/common/tf_check.hpp"
#include "ros/planner/arrival_publisher.hpp"

namespace lstm_planner {

/// No plan can be given; what() is the reason in one sentence.
class PlanRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Turns sensor readings and a goal into a plan: what LstmGlobalPlanner does once it is initialised. Not thread safe.
///
/// Where the global frame is one in which a localisation corrects odometry, the agent thinks in it: obstacles are
/// remembered where they truly are, and the goal stays where it is. Where it is the odometry's own, the agent thinks in
/// a frame that does not drift (DriftCorrection), and what it decides is moved to where that is in the global frame
/// now.
class PlanMaker {
 public:
  /// `name`: of the plugin; its topics live in "~/" + name. `global_frame`: the frame of the plans. `base_frame`: the
  /// robot's, where the odometry does not name it. `costmap`: in the global frame; null where there is none. Throws
  /// when a model that is to lead cannot be used with these parameters.
  PlanMaker(const std::string& name, const GlobalPlannerParameters& parameters, const std::string& global_frame,
            const std::string& base_frame, costmap_2d::Costmap2DROS* costmap = nullptr);

  /// A plan from the robot to the goal in the global frame, stamped now; overwrites `plan`, reusing its memory. Throws
  /// PlanRefused, SensorError, FrameError, UnusableScan or std::invalid_argument with the reason.
  void makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                std::vector<geometry_msgs::PoseStamped>* plan);

  /// From the next plan on, as NavigationAgent::change(), and trace_length. Throws std::invalid_argument, too, if the
  /// network is to lead and there is no model.
  void change(const GlobalPlannerParameters& parameters);
  const GlobalPlannerParameters& parameters() const { return parameters_; }

  /// What the goal of the last call was; none: it was refused before that was known.
  std::optional<GoalTracker::Verdict> verdict() const { return verdict_; }

  /// Says how the drive ended, once the executor reports the goal as reached; to be called now and then. `is_unasked`:
  /// nobody has asked for a plan for long, so that the drive is over in any case.
  void noteEnd(bool is_unasked);
  /// As ArrivalTeller.
  std::string besideGoal();
  /// A goal was set, and it is not known how it ended.
  bool isDriving() const { return is_driving_; }
  /// Of the last drive; none since a new goal.
  const std::optional<DriveEnd>& end() const { return end_; }

  /// How the drive is led.
  const NavigationAgent& agent() const { return agent_; }
  /// m, by which the odometry is wrong about where the robot is now, as the scans say; 0 where drift is not corrected.
  double drift() const { return distanceBetween(seen_.pose, agent_.situation().pose); }
  /// Why there is no model, which no network that leads needs; empty if there is one.
  const std::string& modelProblem() const { return model_problem_; }
  SensorListener& sensors() { return sensors_; }

 private:
  Pose2 robotOfAgent();
  void tellEnd(const DriveEnd& end);
  void makePlanFromWhatIsHeard(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal_message,
                               std::vector<geometry_msgs::PoseStamped>* plan);
  void checkStart(const geometry_msgs::PoseStamped& start, const Pose2& robot) const;
  void checkMotion();
  void perceive(const SensorReading& reading);
  void warnOfReturnsInside() const;
  void hearOfGoals(const GoalInFrame& asked);
  void ask(const GoalInFrame& goal, Pose2* goal_in_global_frame);
  GoalInFrame announcedIn(const std::string& frame, const AnnouncedGoal& announced) const;
  bool isDriftCorrected(const SensorReading& reading) const;
  const Decision& drive(const Pose2& goal, bool is_new);
  const Decision& preview(const Pose2& goal);
  void warnOfTheNetwork() const;
  void sayThatTheScannerIsTooShort();
  void sayWhoLeads(const Decision& decision);
  void sayWhereGoalSeems(const Decision& decision);
  void sayWhatIsInTheWay(const Decision& decision) const;
  std_msgs::Header header() const;
  void publish(const Decision& decision, const Pose2& goal, const std::vector<geometry_msgs::PoseStamped>& plan);

  GlobalPlannerParameters parameters_;
  std::string global_frame_;
  std::string model_problem_;  ///< empty if the model can be used
  NavigationAgent agent_;

  MessageQueue messages_;
  tf2_ros::Buffer tf_;
  TransformListener tf_listener_;
  FrameTransformer frames_;
  SensorListener sensors_;
  TfCheck tf_check_;
  CostmapReader costmap_;
  std::vector<Point2> known_;  ///< returns of this scan and of earlier ones, base frame, m
  GoalListener goals_;
  bool announces_each_plan_;                ///< the executor
  std::optional<AnnouncedGoal> announced_;  ///< last
  bool is_untransformed_ = false;           ///< that goal, by move_base
  GoalTracker tracker_;
  GoalChanges goal_changes_;
  MarkerPublisher markers_;
  DecisionPublisher decisions_;
  ArrivalPublisher arrival_;
  ros::Publisher plan_publisher_;

  ros::Time now_;                                ///< of the current call
  std::optional<GoalTracker::Verdict> verdict_;  ///< of the current call
  CorrectionWatch corrections_;
  DriftCorrection drift_;       ///< from the global frame to the agent's
  long jumps_ = 0;              ///< of odometry or localisation, so far
  Pose2 global_from_odometry_;  ///< of the current call
  Situation seen_;              ///< of the current call, global frame
  Decision preview_;            ///< of the last question
  std::vector<Pose2> plan_;     ///< of the current call, global frame
  Pose2 driven_goal_;           ///< global frame, as it was given
  bool is_driving_ = false;     ///< see isDriving()
  std::optional<DriveEnd> end_;
  std::optional<Leader> leader_;                ///< that was said last
  bool said_too_short_ = false;                 ///< of the scanner, that it is so for the network
  std::set<Decision::GoalSeems> said_of_goal_;  ///< since it was set
};

}  // namespace lstm_planner
