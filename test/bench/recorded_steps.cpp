#include "recorded_steps.hpp"

#include <algorithm>
#include <utility>

#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/drive/motion/rollout.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/simulation/generated_world.hpp"

namespace lstm_planner {
namespace {

constexpr std::uint64_t kWorlds = 1;
constexpr double kPeriod = 0.1;     // s between scans that the planner is asked about
constexpr double kLongest = 120.0;  // s
constexpr double kShortest = 10.0;  // m from start to goal

const std::string kPackage = LSTM_PLANNER_SOURCE_DIR;

RecordedDrive record(const std::string& name, OccupancyGrid grid, std::uint64_t seed) {
  const GridWorld world(std::move(grid));
  const ShieldParameters shield;
  const DriveTask task = drawTasks(world, 1, shield.footprint_radius, shield.clearance, kShortest, seed)[0];
  return recordDrive(name, world, task, kLongest, seed);
}

}  // namespace

DrivePolicy shippedPolicy() { return DrivePolicy::fromFile(kPackage + "/models/create2_lstm.onnx"); }

RecordedDrive recordDrive(const std::string& name, const World& world, const DriveTask& task, double longest,
                          std::uint64_t seed) {
  const AgentParameters agent_parameters;
  SimulatedRobot::Parameters robot_parameters;
  robot_parameters.latency = kPeriod;
  SimulatedRobot robot(world, robot_parameters, task.start, seed);
  NavigationAgent agent(shippedPolicy(), agent_parameters);
  const MotionController controller{MotionParameters()};
  const Point2 goal = toLocalFrame(task.start, task.goal);  // odometry starts at the start

  RecordedDrive drive;
  drive.world = name;
  drive.mount = robot_parameters.scanner.mount;
  drive.goal = {goal.x, goal.y, 0.0};
  agent.setGoal(goal);
  Situation situation;
  std::vector<Pose2> plan;
  while (robot.time() < longest && !controller.goalReached(robot.odometry(), drive.goal)) {
    RecordedStep step;
    robot.scan(&step.scan);
    step.pose = robot.odometry();
    step.time = robot.time();
    perceive(step.scan, drive.mount, Hokuyo::rules(), agent.policy().description().encoder.range_cap, &situation);
    situation.pose = step.pose;
    situation.time = step.time;
    agent.perceive(situation);
    agent.decide();
    rollOut(agent.situation(), agent.decision(), agent.shield(), drive.goal, agent_parameters, {}, &plan);
    robot.command(controller.compute({plan, step.pose, robot.measuredTwist(), agent.shield(), kPeriod}));
    robot.advance(kPeriod);
    drive.steps.push_back(std::move(step));
  }
  return drive;
}

std::vector<RecordedDrive> recordDrives(std::uint64_t seed) {
  return {
      record("office", generateWorld(WorldKind::kOffice, worldSeed(WorldUse::kJudging, kWorlds, 0)), seed),
      record("maze", generateWorld(WorldKind::kMaze, worldSeed(WorldUse::kJudging, kWorlds, 1)), seed),
      record("building", readMapServerMap(kPackage + "/config/demo_building.yaml"), seed),
  };
}

const std::vector<RecordedDrive>& recordedDrives() {
  static const std::vector<RecordedDrive> drives = recordDrives(1);
  return drives;
}

}  // namespace lstm_planner
