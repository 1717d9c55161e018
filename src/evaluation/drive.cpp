#include "lstm_planner/evaluation/drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lstm_planner/parameter_check.hpp"

namespace lstm_planner {

namespace {

/// One drive as it goes on.
class Run {
 public:
  Run(SimulatedRobot* robot, const Crowd* crowd, const DriveTask& task, const DriveParameters& parameters,
      NavigationAgent* agent)
      : robot_(*robot),
        crowd_(crowd),
        task_(task),
        parameters_(parameters),
        agent_(*agent),
        controller_(parameters.motion),
        moving_(parameters.motion.moving) {
    const Point2 goal = toLocalFrame(task.start, task.goal);  // odometry begins at the start
    goal_ = {goal.x, goal.y, 0.0};
    result_.shortest = task.shortest;
    if (crowd != nullptr) result_.walker_traces.resize(crowd->walkers().size());
  }

  DriveResult run() {
    const double range_cap = agent_.policy().description().encoder.range_cap;
    agent_.setGoal({goal_.x, goal_.y});
    agent_.restart();  // what it remembers of another drive is in another odometry frame
    for (int tick = 0; robot_.time() < parameters_.time_limit; ++tick) {
      if (parameters_.arrival == Arrival::kTruePosition && isAtGoal(parameters_.goal_radius)) {
        result_.end = DriveResult::End::kReached;
        break;
      }
      robot_.sense(range_cap, &situation_);
      const Decision& decision = agent_.update(situation_);
      if (endsWith(decision)) break;
      if (tick % parameters_.plan_every == 0) {
        rollOut(situation_, decision, agent_.shield(), goal_, agent_.parameters(), parameters_.rollout, &plan_);
      }
      note(decision);
      moving_.show(situation_.profile, situation_.pose, situation_.time);
      robot_.command(controller_.compute(plan_, situation_.pose, robot_.measuredTwist(), agent_.shield(),
                                         parameters_.control_period, moving_.points()));
      move();
    }
    result_.contacts = robot_.contacts();
    result_.bumped = robot_.bumped();
    result_.bumped_moving = robot_.bumpedMoving();
    result_.time = robot_.time();
    result_.path_length = robot_.pathLength();
    result_.goal_error = distanceBetween(robot_.truePose(), task_.goal);
    return std::move(result_);
  }

 private:
  bool isAtGoal(double radius) const { return distanceBetween(robot_.truePose(), task_.goal) <= radius; }

  /// When the robot itself says that it is over.
  bool endsWith(const Decision& decision) {
    if (decision.source == Decision::Source::kNoWay) {
      result_.end = DriveResult::End::kNoWay;
      return true;
    }
    if (!controller_.goalReached(situation_.pose, {decision.destination.x, decision.destination.y, 0.0})) return false;
    result_.end = isAtGoal(allowedRadius(distanceBetween(decision.destination, goal_))) ? DriveResult::End::kReached
                                                                                        : DriveResult::End::kElsewhere;
    return true;
  }

  /// `beside`: m between the goal and the place that the robot went to instead.
  double allowedRadius(double beside) const {
    if (parameters_.arrival == Arrival::kTruePosition) return parameters_.goal_radius;
    double error = parameters_.robot.base.odometry_error * robot_.pathLength();
    if (robot_.contacts() == 0) {
      const Point2 believed = toParentFrame(task_.start, {robot_.odometry().x, robot_.odometry().y});
      error = std::max(error, distanceBetween(robot_.truePose(), believed));
    }
    return parameters_.goal_radius + error + std::min(beside, error);
  }

  void note(const Decision& decision) {
    const bool escaping = decision.source == Decision::Source::kEscape || decision.source == Decision::Source::kRoute;
    result_.escape_steps += escaping && decision.step != result_.steps ? 1 : 0;
    result_.steps = decision.step;
    result_.trace.push_back(robot_.truePose());
    result_.escaping.push_back(escaping);
    for (std::size_t i = 0; i < result_.walker_traces.size(); ++i) {
      result_.walker_traces[i].push_back(crowd_->walkers()[i].body.center);
    }
  }

  void move() {
    const int contacts = robot_.contacts();
    robot_.advance(parameters_.control_period);
    if (robot_.contacts() > contacts) result_.contact_places.push_back({robot_.truePose().x, robot_.truePose().y});
  }

  SimulatedRobot& robot_;
  const Crowd* crowd_;
  const DriveTask& task_;
  const DriveParameters& parameters_;
  NavigationAgent& agent_;
  MotionController controller_;
  MovingReturns moving_;
  Pose2 goal_;  ///< odometry frame
  Situation situation_;
  std::vector<Pose2> plan_;
  DriveResult result_;
};

void validate(const DriveParameters& parameters) {
  checkPositive("control_period", parameters.control_period);
  checkPositive("plan_every", parameters.plan_every);
  checkPositive("rollout.spacing", parameters.rollout.spacing);
  checkPositive("goal_radius", parameters.goal_radius);
}

}  // namespace

DriveResult drive(const World& world, const DriveTask& task, const DriveParameters& parameters, std::uint64_t seed,
                  NavigationAgent* agent) {
  validate(parameters);
  SimulatedRobot robot(world, parameters.robot, task.start, seed);
  return Run(&robot, nullptr, task, parameters, agent).run();
}

DriveResult drive(Crowd* crowd, const DriveTask& task, const DriveParameters& parameters, std::uint64_t seed,
                  NavigationAgent* agent) {
  validate(parameters);
  SimulatedRobot robot(crowd, parameters.robot, task.start, seed);
  return Run(&robot, crowd, task, parameters, agent).run();
}

DriveSummary summarize(const std::vector<DriveResult>& results) {
  DriveSummary summary;
  std::vector<double> ratios;
  double time = 0.0;
  for (const DriveResult& result : results) {
    ++summary.goals;
    summary.contacts += result.contacts;
    summary.bumped += result.bumped;
    summary.bumped_moving += result.bumped_moving;
    switch (result.end) {
      case DriveResult::End::kReached:
        ++summary.reached;
        time += result.time;
        summary.mean_goal_error += result.goal_error;
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
      case DriveResult::End::kElsewhere:
        ++summary.elsewhere;
        break;
    }
  }
  if (summary.reached > 0) {
    summary.mean_time = time / summary.reached;
    summary.mean_goal_error /= summary.reached;
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

}  // namespace lstm_planner
