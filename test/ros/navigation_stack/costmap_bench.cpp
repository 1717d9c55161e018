#include <benchmark/benchmark.h>
#include <costmap_2d/costmap_2d.h>
#include <global_planner/planner_core.h>
#include <malloc.h>
#include <nav_msgs/Odometry.h>
#include <navfn/navfn_ros.h>
#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "call_times.hpp"
#include "costmap_course.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "recorded_steps.hpp"
#include "ros/planner/plan_maker.hpp"

namespace lstm_planner {
namespace {

constexpr char kMap[] = "map";
constexpr char kOdometry[] = "odom";
constexpr char kBase[] = "base_footprint";
constexpr char kLaser[] = "laser";
constexpr std::size_t kEvery = 5;  // scans a plan: two plans a second

geometry_msgs::PoseStamped stamped(const Pose2& pose) { return toMessage(pose, kMap, ros::Time::now()); }

/// A line of /proc/self/status, MB.
double memoryStatus(const std::string& key) {
  std::ifstream file("/proc/self/status");
  std::string word;
  double kilobytes = 0.0;
  while (file >> word) {
    if (word == key + ":" && file >> kilobytes) break;
  }
  return 1e-3 * kilobytes;
}

/// What a planner needs of the memory between construction and destruction, MB.
class MemoryMeter {
 public:
  MemoryMeter() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak starts anew
    before_ = memoryStatus("VmRSS");
  }
  double peak() const { return memoryStatus("VmHWM") - before_; }

 private:
  double before_ = 0.0;
};

/// Times of the calls, ms, and the memory needed meanwhile.
class Result {
 public:
  explicit Result(const Course& course) : times_(course.drive.steps.size()) {}
  LeastTime& operator[](std::size_t step) { return times_[step]; }

  void report(std::size_t longest_plan, benchmark::State* state) const {
    std::vector<double> values;
    for (const LeastTime& time : times_) {
      if (std::isfinite(time.microseconds())) values.push_back(1e-3 * time.microseconds());
    }
    state->counters["plans"] = static_cast<double>(values.size());
    state->counters["median_ms"] = quantile(values, 0.5);
    state->counters["mean_ms"] = meanOf(values);
    state->counters["worst_ms"] = quantile(values, 1.0);
    state->counters["peak_mb"] = memory_.peak();
    state->counters["poses"] = static_cast<double>(longest_plan);
  }

 private:
  std::vector<LeastTime> times_;
  MemoryMeter memory_;
};

/// Publishes what a robot in a drive would.
class Robot {
 public:
  explicit Robot(const Course& course)
      : course_(course),
        scans_(node_handle_.advertise<sensor_msgs::LaserScan>("scan", 1)),
        odometry_(node_handle_.advertise<nav_msgs::Odometry>("odom", 1)) {
    const SensorMount& mount = course.drive.mount;
    listening_.setCallbackQueue(&arrived_);
    scan_arrivals_ = listening_.subscribe("scan", 1, &Robot::onScan, this);
    odometry_arrivals_ = listening_.subscribe("odom", 1, &Robot::onOdometry, this);
    broadcaster_.sendTransform({toMessage(course.task.start, kMap, kOdometry), toMessage(mount.pose, kBase, kLaser)});
  }

  bool isHeard() const { return scans_.getNumSubscribers() > 0 && odometry_.getNumSubscribers() > 0; }

  /// Waits until what was published last has arrived in this process, where the planner is.
  void waitForArrival() {
    const ros::WallTime begin = ros::WallTime::now();
    while (scan_arrived_ != ros::Time::now() || odometry_arrived_ != ros::Time::now()) {
      if (ros::WallTime::now() - begin > ros::WallDuration(5.0)) throw std::runtime_error("a scan came too late");
      ros::WallDuration(0.0002).sleep();
      arrived_.callAvailable();
    }
    ros::WallDuration(0.0005).sleep();
  }

  /// `time`: s, by the clock of the drive.
  void publish(const RecordedStep& step, double time) {
    ros::Time::setNow(ros::Time(time));
    nav_msgs::Odometry odometry;
    odometry.header.frame_id = kOdometry;
    odometry.header.stamp = ros::Time(time);
    odometry.child_frame_id = kBase;
    odometry.pose.pose = toMessage(step.pose);
    odometry_.publish(odometry);
    const auto scan = boost::make_shared<sensor_msgs::LaserScan>();
    scan->header.frame_id = kLaser;
    scan->header.stamp = ros::Time(time);
    scan->angle_min = static_cast<float>(step.scan.angle_min);
    scan->angle_increment = static_cast<float>(step.scan.angle_increment);
    scan->range_min = static_cast<float>(step.scan.range_min);
    scan->range_max = static_cast<float>(step.scan.range_max);
    scan->ranges = step.scan.ranges;
    scans_.publish(sensor_msgs::LaserScan::ConstPtr(scan));
  }

  Pose2 inMap(const Pose2& pose) const { return compose(course_.task.start, pose); }

 private:
  void onScan(const sensor_msgs::LaserScan& scan) { scan_arrived_ = scan.header.stamp; }
  void onOdometry(const nav_msgs::Odometry& odometry) { odometry_arrived_ = odometry.header.stamp; }

  const Course& course_;
  ros::NodeHandle node_handle_;
  ros::NodeHandle listening_;
  ros::CallbackQueue arrived_;
  ros::Time scan_arrived_;
  ros::Time odometry_arrived_;
  ros::Subscriber scan_arrivals_;
  ros::Subscriber odometry_arrivals_;
  ros::Publisher scans_;
  ros::Publisher odometry_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
};

void waitForSubscriptions(const Robot& robot) {
  const ros::WallTime begin = ros::WallTime::now();
  while (!robot.isHeard()) {
    if (ros::WallTime::now() - begin > ros::WallDuration(10.0)) throw std::runtime_error("the planner hears nothing");
    ros::WallDuration(0.01).sleep();
  }
  ros::WallDuration(0.5).sleep();  // static transforms
}

/// makePlan of this package's planner, the sensors' messages included, twice a second while the robot drives towards
/// the goal from where it knows nothing.
void lstmPlanner(benchmark::State& state) {
  const Course& where = course(static_cast<int>(state.range(0)), static_cast<Goal>(state.range(1)));
  Robot robot(where);
  Result result(where);
  GlobalPlannerParameters parameters;
  parameters.model = std::string(LSTM_PLANNER_SOURCE_DIR) + "/models/create2_lstm.onnx";
  parameters.rollout.steps = 10;
  PlanMaker planner("LstmGlobalPlanner", parameters, kMap, kBase);
  waitForSubscriptions(robot);
  const geometry_msgs::PoseStamped goal = stamped({where.task.goal.x, where.task.goal.y, 0.0});
  std::vector<geometry_msgs::PoseStamped> plan;  // used again and again, as move_base does
  double time = 1000.0;
  std::size_t longest = 0;
  for (auto _ : state) {
    time += 10.0;  // the odometry jumps back to the start, which makes the planner forget what it saw
    for (std::size_t i = 0; i < where.drive.steps.size(); i += kEvery) {
      const RecordedStep& step = where.drive.steps[i];
      robot.publish(step, time + step.time);
      robot.waitForArrival();
      const geometry_msgs::PoseStamped start = stamped(robot.inMap(step.pose));
      plan.clear();
      const auto ask = [&] { planner.makePlan(start, goal, &plan); };
      if (i == 0) {
        ask();  // twice, or the goal is taken for a question
        ask();
      } else {
        result[i].measure(ask);
      }
      if (distanceBetween(plan.front().pose.position, start.pose.position) > 1e-6) {
        state.SkipWithError("a scan came too late, the machine is too busy");
        return;
      }
      longest = std::max(longest, plan.size());
    }
  }
  result.report(longest, &state);
}

/// makePlan of one of the stack's planners from the same places to the same goal, in a costmap that shows the whole
/// building.
template <typename Planner>
void stackPlanner(const std::string& name, benchmark::State& state) {
  constexpr std::size_t kFewer = 4;  // of the places: what they cost hardly depends on the place
  const Course& where = course(static_cast<int>(state.range(0)), static_cast<Goal>(state.range(1)));
  Result result(where);
  ros::Time::setNow(ros::Time(1000.0));
  Planner planner(name, where.costmap.get(), kMap);
  const geometry_msgs::PoseStamped goal = stamped({where.task.goal.x, where.task.goal.y, 0.0});
  std::vector<geometry_msgs::PoseStamped> plan;
  std::size_t longest = 0;
  for (auto _ : state) {
    for (std::size_t i = kEvery; i < where.drive.steps.size(); i += kFewer * kEvery) {
      const geometry_msgs::PoseStamped start = stamped(compose(where.task.start, where.drive.steps[i].pose));
      plan.clear();
      bool found = false;
      result[i].measure([&] { found = planner.makePlan(start, goal, plan); });
      if (!found) {
        state.SkipWithError("no plan was found");
        return;
      }
      longest = std::max(longest, plan.size());
    }
  }
  result.report(longest, &state);
}

void navfnPlanner(benchmark::State& state) { stackPlanner<navfn::NavfnROS>("NavfnROS", state); }

void globalPlanner(benchmark::State& state) { stackPlanner<global_planner::GlobalPlanner>("GlobalPlanner", state); }

void globalPlannerAStar(benchmark::State& state) {
  const ros::NodeHandle parameters("~/GlobalPlannerAStar");
  parameters.setParam("use_dijkstra", false);
  parameters.setParam("use_grid_path", true);  // its gradients lead nowhere on what A* has looked at
  stackPlanner<global_planner::GlobalPlanner>("GlobalPlannerAStar", state);
}

void registerAll() {
  for (const Goal goal : {kNearGoal, kFarGoal}) {
    for (const int size : {200, 400, 1000, 2000, 4000}) {
      const auto add = [&](const char* name, void (*function)(benchmark::State&), int iterations) {
        benchmark::RegisterBenchmark(name, function)
            ->ArgNames({"cells", "far"})
            ->Args({size, goal})
            ->Iterations(iterations)
            ->Unit(benchmark::kMillisecond);
      };
      const int passes = size < 2000 ? 3 : 1;  // these take a second a plan
      add("lstm_planner", lstmPlanner, 5);
      add("navfn", navfnPlanner, passes);
      add("global_planner", globalPlanner, passes);
      add("global_planner_a_star", globalPlannerAStar, passes);
    }
  }
}

}  // namespace
}  // namespace lstm_planner

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  ros::init(argc, argv, "lstm_planner_costmap_bench");
  if (!ros::master::check()) {
    std::cerr << "lstm_planner_costmap_bench needs a ROS master: run roscore beside it\n";
    return 1;
  }
  ros::start();
  lstm_planner::registerAll();
  benchmark::RunSpecifiedBenchmarks();
  ros::shutdown();
  return 0;
}
