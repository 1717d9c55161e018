#include "lstm_planner/evaluation/drive.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "lstm_planner/parameter_check.hpp"
#include "lstm_planner/simulation/random.hpp"

namespace lstm_planner {

DriveResult drive(const World& world, const DriveTask& task, const DriveParameters& parameters, std::uint64_t seed,
                  NavigationAgent* agent) {
  checkPositive("control_period", parameters.control_period);
  checkPositive("plan_every", parameters.plan_every);
  checkPositive("rollout.spacing", parameters.rollout.spacing);
  SimulatedRobot robot(world, parameters.robot, task.start, seed);
  const MotionController controller(parameters.motion);
  const double range_cap = agent->policy().description().encoder.range_cap;
  const Point2 goal = toLocalFrame(task.start, task.goal);  // odometry begins at the start
  const Pose2 goal_pose{goal.x, goal.y, 0.0};
  agent->setGoal(goal);

  DriveResult result;
  result.shortest = task.shortest;
  Situation situation;
  std::vector<Pose2> plan;
  long last_step = 0;
  for (int tick = 0; robot.time() < parameters.time_limit; ++tick) {
    robot.sense(range_cap, &situation);
    const Decision& decision = agent->update(situation);
    if (decision.source == Decision::Source::kNoWay) {
      result.end = DriveResult::End::kNoWay;
      break;
    }
    if (controller.goalReached(situation.pose, goal_pose)) {
      const bool there = distanceBetween(robot.truePose(), task.goal) <= parameters.goal_radius;
      result.end = there ? DriveResult::End::kReached : DriveResult::End::kTimeout;
      break;
    }
    if (tick % parameters.plan_every == 0) {
      rollOut(situation, decision, agent->shield(), goal_pose, agent->parameters(), parameters.rollout, &plan);
    }
    const bool escaping = decision.source == Decision::Source::kEscape;
    result.escape_steps += escaping && decision.step != last_step ? 1 : 0;
    last_step = decision.step;
    result.trace.push_back(robot.truePose());
    result.escaping.push_back(escaping);
    robot.command(
        controller.compute(plan, situation.pose, robot.measuredTwist(), agent->shield(), parameters.control_period));
    robot.advance(parameters.control_period);
  }
  result.steps = last_step;
  result.contacts = robot.contacts();
  result.time = robot.time();
  result.path_length = robot.pathLength();
  return result;
}

DriveSummary summarize(const std::vector<DriveResult>& results) {
  DriveSummary summary;
  std::vector<double> ratios;
  double time = 0.0;
  for (const DriveResult& result : results) {
    ++summary.goals;
    summary.contacts += result.contacts;
    switch (result.end) {
      case DriveResult::End::kReached:
        ++summary.reached;
        time += result.time;
        if (result.shortest > 0.0) {
          ratios.push_back(result.path_length / result.shortest);
        }
        break;
      case DriveResult::End::kTimeout:
        ++summary.timeouts;
        break;
      case DriveResult::End::kNoWay:
        ++summary.no_way;
        break;
    }
  }
  if (summary.reached > 0) {
    summary.mean_time = time / summary.reached;
  }
  if (!ratios.empty()) {
    std::sort(ratios.begin(), ratios.end());
    for (const double ratio : ratios) {
      summary.mean_ratio += ratio / static_cast<double>(ratios.size());
    }
    const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(ratios.size())));
    summary.p95_ratio = ratios[rank - 1];
  }
  return summary;
}

std::vector<DriveTask> drawTasks(const GridWorld& world, int count, double footprint_radius, double clearance,
                                 double shortest, std::uint64_t seed) {
  const OccupancyGrid& grid = world.grid();
  // Distances are between centres of cells, the obstacle begins half a cell before.
  const double needed = footprint_radius + clearance + 0.5 * grid.resolution();
  const DistanceField distances(grid, true);
  std::vector<CellIndex> standing;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      if (grid.at({column, row}) == Cell::kFree && distances.at({column, row}) >= needed) {
        standing.push_back({column, row});
      }
    }
  }
  if (standing.empty()) {
    throw std::invalid_argument("the map has no place for a disc of radius " + std::to_string(needed) + " m");
  }
  std::mt19937_64 random(seed);
  std::vector<DriveTask> tasks;
  GeodesicField::Options options;
  options.clearance = needed;
  for (int failures = 0; static_cast<int>(tasks.size()) < count; ++failures) {
    if (failures > 100 * count) {
      throw std::invalid_argument("the map has no two places at least " + std::to_string(shortest) +
                                  " m apart that can be reached from one another");
    }
    const CellIndex goal = standing[uniformIndex(random, standing.size())];
    const CellIndex start = standing[uniformIndex(random, standing.size())];
    const double yaw = (2.0 * uniform(random) - 1.0) * M_PI;
    const double length = GeodesicField(grid, distances, goal, options).at(start);
    if (std::isfinite(length) && length >= shortest) {
      const Point2 from = grid.centerOf(start);
      tasks.push_back({{from.x, from.y, yaw}, grid.centerOf(goal), length});
    }
  }
  return tasks;
}

}  // namespace lstm_planner
