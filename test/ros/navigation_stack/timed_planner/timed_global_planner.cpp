#include <nav_core/base_global_planner.h>
#include <ros/ros.h>
#include <std_msgs/Float64MultiArray.h>

#include <boost/shared_ptr.hpp>
#include <ctime>
#include <memory>
#include <pluginlib/class_list_macros.hpp>
#include <pluginlib/class_loader.hpp>
#include <string>
#include <vector>

namespace lstm_planner_test {

/// Hands every call on to the global planner named by the parameter ~TimedGlobalPlanner/planner, which keeps the
/// parameter namespace it would have by itself, and publishes on ~TimedGlobalPlanner/calls, latched: the number of
/// calls, how many of them gave no plan, and the CPU time that the calling thread spent in them (s).
class TimedGlobalPlanner : public nav_core::BaseGlobalPlanner {
 public:
  void initialize(std::string name, costmap_2d::Costmap2DROS* costmap_ros) override {
    ros::NodeHandle node("~/" + name);
    const std::string planner = node.param("planner", std::string());
    planner_ = loader_.createInstance(planner);  // move_base reports pluginlib's exceptions
    publisher_ = node.advertise<std_msgs::Float64MultiArray>("calls", 1, true);
    planner_->initialize(loader_.getName(planner), costmap_ros);
  }

  bool makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                std::vector<geometry_msgs::PoseStamped>& plan) override {
    const double begin = threadTime();
    const bool planned = planner_->makePlan(start, goal, plan);
    seconds_ += threadTime() - begin;
    calls_ += 1.0;
    if (!planned || plan.empty()) failures_ += 1.0;
    std_msgs::Float64MultiArray message;
    message.data = {calls_, failures_, seconds_};
    publisher_.publish(message);
    return planned;
  }

 private:
  static double threadTime() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  pluginlib::ClassLoader<nav_core::BaseGlobalPlanner> loader_{"nav_core", "nav_core::BaseGlobalPlanner"};
  boost::shared_ptr<nav_core::BaseGlobalPlanner> planner_;  // after loader_: destroyed before its library is closed
  ros::Publisher publisher_;
  double calls_ = 0.0;
  double failures_ = 0.0;
  double seconds_ = 0.0;
};

}  // namespace lstm_planner_test

PLUGINLIB_EXPORT_CLASS(lstm_planner_test::TimedGlobalPlanner, nav_core::BaseGlobalPlanner)
