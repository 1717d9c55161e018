#include "ros/planner/lstm_global_planner.hpp"

#include <ros/console.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>

#include "lstm_planner/drive/decision/decision_text.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "ros/common/costmap_footprint.hpp"
#include "ros/common/costmap_reader.hpp"
#include "ros/common/guarded.hpp"
#include "ros/common/plugin_diagnostics.hpp"
#include "ros/common/reconfigure_server.hpp"
#include "ros/common/timing.hpp"
#include "ros/planner/plan_maker.hpp"

PLUGINLIB_EXPORT_CLASS(lstm_planner::LstmGlobalPlanner, nav_core::BaseGlobalPlanner)

namespace lstm_planner {

namespace {

constexpr double kPlannerUnasked = 5.0;  // s; move_base may plan as rarely as every second

}  // namespace

LstmGlobalPlanner::LstmGlobalPlanner() = default;

// The costmap may be gone by now: nothing below may know it.
LstmGlobalPlanner::~LstmGlobalPlanner() = default;

void LstmGlobalPlanner::initialize(std::string name, costmap_2d::Costmap2DROS* costmap_ros) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (plan_maker_) {
      ROS_WARN("%s is already initialised, the second call is ignored", name.c_str());
      return;
    }
    guarded([&] { setUp(name, costmap_ros); }, [&](const std::string& why) { refuse(name, why); });
  }
  startDiagnostics(name);
}

void LstmGlobalPlanner::setUp(const std::string& name, costmap_2d::Costmap2DROS* costmap_ros) {
  if (costmap_ros == nullptr) throw std::invalid_argument("it was initialised without a costmap");
  GlobalPlannerParameters parameters = loadGlobalPlannerParameters(ros::NodeHandle("~/" + name));
  takeSafeFootprint(*costmap_ros, name + "/shield/", &parameters.agent.shield);
  parameters.agent = fittedToFootprint(parameters.agent);
  plan_maker_ = std::make_unique<PlanMaker>(name, parameters, costmap_ros->getGlobalFrameID(),
                                            costmap_ros->getBaseFrameID(), costmap_ros);
  const bool has_model = plan_maker_->modelProblem().empty();
  model_ = has_model ? resolvedPath(parameters.model) : "none";
  costmap_ = parameters.use_costmap ? costmap_ros : nullptr;
  ROS_INFO("%s plans in %s with the model %s", name.c_str(), costmap_ros->getGlobalFrameID().c_str(),
           has_model ? parameters.model.c_str() : model_.c_str());
  const auto visit = [](auto& visited, const auto& visitor) { visitGlobalPlannerParameters(visited, visitor); };
  reconfigure_ = serveReconfiguration(name, plan_maker_.get(), visit, changeableGlobalPlannerParameters(),
                                      {"network", "route"}, &mutex_);
}

void LstmGlobalPlanner::refuse(const std::string& name, const std::string& reason) {
  why_unusable_ = reason;
  ROS_FATAL("%s cannot be used: %s", name.c_str(), reason.c_str());
}

bool LstmGlobalPlanner::makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                                 std::vector<geometry_msgs::PoseStamped>& plan) {
  plan.clear();
  const auto costmap_lock = lockOf(costmap_);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!plan_maker_) {
    ROS_ERROR_THROTTLE(kLogPeriod, "no plan: the planner cannot be used: %s", why_unusable_.c_str());
    return false;
  }
  const ros::SteadyTime begin = ros::SteadyTime::now();
  const auto make = [&] {
    plan_maker_->makePlan(start, goal, &plan);
    note("", begin);
    return true;
  };
  const auto refuse_plan = [&](const std::string& why) {
    plan.clear();
    note(why, begin);
    ROS_WARN_THROTTLE(kLogPeriod, "no plan: %s", why.c_str());
    return false;
  };
  return guarded(make, refuse_plan);
}

std::string LstmGlobalPlanner::besideGoal() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return plan_maker_ ? plan_maker_->besideGoal() : "";
}

/// A plan that somebody asked for tells nothing about the drive.
void LstmGlobalPlanner::note(const std::string& refusal, const ros::SteadyTime& begin) {
  const auto verdict = plan_maker_->verdict();
  if (verdict == GoalTracker::Verdict::kQuestion) return;
  answer_.refusal = refusal;
  answer_.is_decided = verdict.has_value();
  answer_.time = ros::SteadyTime::now();
  answer_.duration = (answer_.time - begin).toSec();
  answer_.longest = std::max(answer_.longest, answer_.duration);
}

void LstmGlobalPlanner::startDiagnostics(const std::string& name) {
  if (diagnostics_) return;
  using Status = PluginDiagnostics::Status;
  const auto describe_state = [this](Status& status) {
    if (plan_maker_) plan_maker_->noteEnd(!isAsked());
    describeState(&status);
  };
  diagnostics_ = std::make_unique<PluginDiagnostics>(name, &mutex_, describe_state,
                                                     [this](Status& status) { describeFigures(&status); });
  diagnostics_->add("model", [this](Status& status) { describeModel(&status); });
  diagnostics_->addSensors([this] { return plan_maker_ ? &plan_maker_->sensors() : nullptr; });
  diagnostics_->start();
}

bool LstmGlobalPlanner::isAsked() const {
  return plan_maker_ && (ros::SteadyTime::now() - answer_.time).toSec() <= kPlannerUnasked;
}

void LstmGlobalPlanner::describeState(PluginDiagnostics::Status* status) const {
  using diagnostic_msgs::DiagnosticStatus;
  if (!plan_maker_) {
    status->summary(DiagnosticStatus::ERROR, "the planner cannot be used: " + why_unusable_);
    return;
  }
  status->add("model", model_);
  const Decision& decision = plan_maker_->agent().decision();
  const std::optional<DriveEnd>& end = plan_maker_->end();
  if (!isAsked() && plan_maker_->isDriving()) {
    status->summary(DiagnosticStatus::OK,
                    "nobody asks for plans, but no end of the drive was heard: the goal was cancelled or given up, or "
                    "move_base waits (see its log)");
    return;
  }
  if (!isAsked() || (end && end->is_arrival && answer_.refusal.empty())) {
    const std::string last = end ? "; the last drive " + end->text() : "";
    status->summary(end && end->is_beside ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                    "nobody asks for plans: there is no goal" + last);
    return;
  }
  if (!answer_.refusal.empty()) {
    const bool is_final = answer_.is_decided && decision.choice == Decision::Move::kNoPath;
    status->summary(is_final ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN, "no plan");
    status->add("why", answer_.refusal);
  } else {
    const bool follows_boundary = decision.leader == Leader::kEscape;
    // Why it leads is of the step with which it began to.
    const bool is_reachable = decision.goal_seems == Decision::GoalSeems::kReachable;
    const std::string why =
        is_reachable ? decision.why : std::string("the goal seems ") + toString(decision.goal_seems);
    status->summary(follows_boundary ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                    std::string("the ") + toString(decision.leader) + " leads: " + why);
  }
}

void LstmGlobalPlanner::describeFigures(PluginDiagnostics::Status* status) const {
  if (!isAsked() || !answer_.is_decided) return;
  const Decision& decision = plan_maker_->agent().decision();
  status->add("decided by", toString(decision.choice));
  status->add("what was decided", describe(decision));
  status->add("step", decision.step);
  status->add("the goal seems", toString(decision.goal_seems));
  status->add("the goal counts as reached within (m)", plan_maker_->agent().reachedWithin());
  status->add("best distance to the goal (m)", plan_maker_->agent().bestDistance());
  if (decision.preferred >= 0) {  // else neither network nor shield were asked about actions
    status->add("actions that the shield removed",
                std::count(decision.allowed.begin(), decision.allowed.end(), static_cast<char>(0)));
    status->add("overruled", toString(decision.overruled));
    status->add("detours of the network (m)", decision.regret_used);
    status->add("detours that are allowed (m)", decision.regret_allowed);
  }
  status->add("drift of the odometry (m)", plan_maker_->drift());
  status->add("time for the plan (ms)", 1e3 * answer_.duration);
  status->add("longest time for a plan (ms)", 1e3 * answer_.longest);
}

void LstmGlobalPlanner::describeModel(PluginDiagnostics::Status* status) const {
  using diagnostic_msgs::DiagnosticStatus;
  if (!plan_maker_) {
    status->summary(DiagnosticStatus::ERROR, "the planner cannot be used: " + why_unusable_);
    return;
  }
  if (!plan_maker_->modelProblem().empty()) {
    status->summary(DiagnosticStatus::OK, "no network can lead: " + plan_maker_->modelProblem());
    return;
  }
  const std::string warning = plan_maker_->agent().standInWarning();
  status->summary(warning.empty() ? DiagnosticStatus::OK : DiagnosticStatus::WARN, warning.empty() ? model_ : warning);
  const PolicyDescription& description = plan_maker_->agent().policy().description();
  status->add("steering angles", description.actions.size());
  status->add("step length (m)", description.step_length);
  status->add("robot radius (m)", description.footprint_radius);
}

}  // namespace lstm_planner
