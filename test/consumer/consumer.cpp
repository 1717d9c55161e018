// The planner in a program without ROS: scans in, steering angles and plans out, until the goal is reached.
#include <chrono>
#include <cmath>
#include <iostream>
#include <lstm_planner/drive/decision/navigation_agent.hpp>
#include <lstm_planner/drive/motion/rollout.hpp>

using namespace lstm_planner;

/// What a scanner in the middle of the robot sees in a room from (-2, -2) to (8, 2): yours comes from a driver.
LaserScan scanFrom(const Pose2& pose, double stamp) {
  LaserScan scan{stamp, -2.35619, 0.00436332, 0.023, 60.0, std::vector<float>(1081)};
  for (std::size_t beam = 0; beam < scan.ranges.size(); ++beam) {
    const double direction = pose.yaw + scan.angle_min + static_cast<double>(beam) * scan.angle_increment;
    const double x = std::cos(direction), y = std::sin(direction);
    scan.ranges[beam] = static_cast<float>(std::fmin(((x > 0 ? 8 : -2) - pose.x) / x, ((y > 0 ? 2 : -2) - pose.y) / y));
  }
  return scan;
}

int main(int argc, char** argv) try {
  const Pose2 goal{6.5, 1.0, 0.0};   // m, m, rad, in the frame of the robot's poses
  const AgentParameters parameters;  // config/parameters.md explains them
  NavigationAgent agent(DrivePolicy::fromFile(argc > 1 ? argv[1] : "models/create2_lstm.onnx"), parameters);
  agent.setGoal({goal.x, goal.y});
  Situation situation;
  std::vector<Pose2> plan{Pose2{}};
  for (int i = 0; i < 200 && agent.decision().choice != Decision::Move::kArrived; ++i) {
    const Pose2 pose = plan.size() > 2 ? plan[2] : plan.back();  // yours comes from odometry
    const LaserScan scan = scanFrom(pose, 0.2 * i);
    const auto begin = std::chrono::steady_clock::now();
    perceive(scan, SensorMount(), ScanRules(), agent.policy().description().encoder.range_cap, &situation);
    situation.pose = pose;
    situation.time = scan.stamp;
    agent.perceive(situation);
    agent.decide();
    rollOut(agent.situation(), agent.decision(), agent.shield(), goal, parameters, RolloutParameters(), &plan);
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
    const double angle = normalizeAngle(agent.decision().direction - pose.yaw);  // rad, to the left
    std::cout << "steer " << std::lround(angle * 180.0 / M_PI) << " degrees (" << toString(agent.decision().choice)
              << "), a plan of " << plan.size() << " poses, " << std::lround(time.count()) << " us\n";
  }
  return agent.decision().choice == Decision::Move::kArrived ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
