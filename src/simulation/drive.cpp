#include "lstm_planner/simulation/drive.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/common/quantile.hpp"
#include "lstm_planner/drive/decision/closed_loop.hpp"
#include "lstm_planner/drive/motion/elastic_band.hpp"
#include "lstm_planner/drive/motion/path_tracker.hpp"
#include "lstm_planner/drive/perception/drift_correction.hpp"

namespace lstm_planner {

namespace {

constexpr double kControlPeriod = 0.1;  // s between commands, as the Create driver's loop
constexpr int kPlanEvery = 2;           // commands between plans

/// A simulated robot that a controller leads along the agent's plans.
class ControlledRobot : public LoopRobot {
 public:
  ControlledRobot(SimulatedRobot* robot, const DriveTask& task, const DriveParameters& parameters, bool correct_drift,
                  const DriveListener& listener)
      : robot_(*robot),
        parameters_(parameters),
        correct_drift_(correct_drift),
        listener_(listener),
        tracker_(parameters.motion) {
    const Point2 goal = toLocalFrame(task.start, task.goal);  // odometry starts at the start
    goal_ = {goal.x, goal.y, 0.0};
  }

  const Pose2& goal() const { return goal_; }  ///< odometry frame
  /// Where the robot thinks it is; odometry frame as it was at the start.
  Pose2 believedPose() const { return compose(correction_.correction(), robot_.odometry()); }

  /// Sees what the last scan showed until the scanner has taken another one.
  bool sense(double range_cap, Situation* situation) override {
    if (robot_.time() < next_scan_) return true;
    try {
      robot_.sense(range_cap, situation);
      if (correct_drift_) correction_.correct(situation);
    } catch (const UnusableScan&) {
      // Somebody is so near to the scanner that it measures nothing. The plugins stop the robot then.
      robot_.command({});
      robot_.advance(kControlPeriod);
      return false;
    }
    next_scan_ = robot_.time() + scanPeriod() - kSameTime;
    return true;
  }

  bool hasArrived(const Situation& situation, const Point2& end) const override {
    return tracker_.goalReached(situation.pose, {end.x, end.y, 0.0});
  }

  void carryOut(const Situation& situation, const Decision& decision, const NavigationAgent& agent) override {
    if (tick_++ % kPlanEvery == 0) {
      const auto bent = bentAway(agent, situation.pose, decision, parameters_.rollout.clearance);
      rollOut(situation, bent.value_or(decision), agent.shield(), goal_, agent.parameters(), parameters_.rollout,
              &plan_);
    }
    tracker_.expectReactionTime(0.0, parameters_.robot.longestScanPeriod(), kControlPeriod);
    const MotionCommand command = nextCommand(situation, agent.shield());
    if (command.stop != StopReason::kStuck) stuck_since_.reset();
    if (command.stop == StopReason::kStuck && !stuck_since_) stuck_since_ = robot_.time();
    robot_.command(command);
    if (listener_) listener_({robot_.time(), robot_.truePose(), situation, plan_, agent});
    robot_.advance(kControlPeriod);
  }

  /// Whether move_base would stop trying, whose controller_patience is about as long.
  bool hasGivenUp() const { return stuck_since_ && robot_.time() - *stuck_since_ > parameters_.motion.patience; }

 private:
  static constexpr double kSameTime = 1e-6;  // s
  double scanPeriod() const { return 1.0 / parameters_.robot.scanner.rate; }

  /// `shield`: as seen from where the scan was taken.
  MotionCommand nextCommand(const Situation& situation, const Shield& shield) {
    const double scan_age = robot_.time() - situation.time;
    if (scan_age == 0.0) {
      return tracker_.compute({plan_, situation.pose, robot_.measuredTwist(), shield, kControlPeriod}, situation);
    }
    const Pose2 pose = believedPose();
    Shield from_here = shield;
    from_here.moveTo(compose(inverse(situation.pose), pose));
    return tracker_.compute({plan_, pose, robot_.measuredTwist(), from_here, kControlPeriod}, situation, scan_age);
  }

  SimulatedRobot& robot_;
  const DriveParameters& parameters_;
  const bool correct_drift_;
  const DriveListener& listener_;
  DriftCorrection correction_;
  PathTracker tracker_;
  Pose2 goal_;
  std::vector<Pose2> plan_;
  int tick_ = 0;
  double next_scan_ = 0.0;             ///< s
  std::optional<double> stuck_since_;  ///< s
};

/// One drive as it goes on, and what is noted of it.
class Run {
 public:
  Run(SimulatedRobot* robot, const Traffic* traffic, const DriveTask& task, const DriveParameters& parameters,
      NavigationAgent* agent, const DriveListener& listener)
      : robot_(*robot),
        controlled_(robot, task, parameters, agent->parameters().correct_drift, listener),
        traffic_(traffic),
        task_(task),
        parameters_(parameters),
        agent_(*agent) {
    result_.shortest = task.shortest;
    if (traffic != nullptr) result_.walker_traces.resize(traffic->circles().size());
  }

  DriveResult run() {
    const Pose2& goal = controlled_.goal();
    const LoopEnd end = runClosedLoop(
        {goal.x, goal.y}, &controlled_, &agent_, [this] { return goesOn(); },
        [this](const Decision& decision) { note(decision); });
    result_.end = judge(end);
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
  bool refereeSaysArrived() const {
    return parameters_.arrival == Arrival::kTruePosition && isAtGoal(parameters_.goal_radius);
  }

  bool isEndedByTouch() const { return parameters_.ends_at_touch && robot_.contacts() + robot_.bumped() > 0; }

  bool goesOn() {
    if (robot_.contacts() > contacts_seen_) {
      contacts_seen_ = robot_.contacts();
      result_.contact_places.push_back({robot_.truePose().x, robot_.truePose().y});
    }
    return robot_.time() < parameters_.time_limit && !refereeSaysArrived() && !isEndedByTouch() &&
           !controlled_.hasGivenUp();
  }

  DriveResult::End judge(LoopEnd end) const {
    switch (end) {
      case LoopEnd::kNoPath:
        return DriveResult::End::kNoPath;
      case LoopEnd::kArrived:
        return isAtGoal(allowedRadius()) ? DriveResult::End::kReached : DriveResult::End::kElsewhere;
      case LoopEnd::kStopped:
        break;
    }
    if (isEndedByTouch()) return DriveResult::End::kTouched;
    if (robot_.time() >= parameters_.time_limit) return DriveResult::End::kTimeout;
    return refereeSaysArrived() ? DriveResult::End::kReached : DriveResult::End::kStuck;
  }

  double allowedRadius() const {
    if (parameters_.arrival == Arrival::kTruePosition) return parameters_.goal_radius;
    const double beside = distanceBetween(agent_.decision().destination, controlled_.goal());
    const Pose2 believed = compose(task_.start, controlled_.believedPose());
    const double error = robot_.contacts() == 0 ? distanceBetween(robot_.truePose(), believed)
                                                : parameters_.robot.base.odometry_error * robot_.pathLength();
    return parameters_.goal_radius + error + std::min(beside, error);
  }

  void note(const Decision& decision) {
    if (decision.step != result_.steps) {
      ++result_.steps_by.at(indexOf(decision.choice));
      const bool is_by_leader = decision.choice == Leader::kNetwork || decision.choice == Leader::kGreedy;
      result_.steps_on_path += is_by_leader && decision.on_route ? 1 : 0;
      ++result_.overruled.at(static_cast<std::size_t>(decision.overruled));
    }
    if (result_.goal_seemed == Decision::GoalSeems::kReachable) result_.goal_seemed = decision.goal_seems;
    result_.steps = decision.step;
    result_.regret = decision.regret_used;
    result_.trace.push_back(robot_.truePose());
    result_.led.push_back(decision.choice);
    result_.on_path.push_back(decision.on_route);
    if (traffic_ == nullptr) return;
    const std::vector<Circle>& bodies = traffic_->circles();
    for (std::size_t i = 0; i < bodies.size(); ++i) result_.walker_traces[i].push_back(bodies[i].center);
  }

  SimulatedRobot& robot_;
  ControlledRobot controlled_;
  const Traffic* traffic_;
  const DriveTask& task_;
  const DriveParameters& parameters_;
  NavigationAgent& agent_;
  DriveResult result_;
  int contacts_seen_ = 0;
};

/// `count`: the steps of a drive that are meant.
template <typename Count>
double shareOfSteps(const std::vector<DriveResult>& results, const Count& count) {
  long meant = 0;
  long all = 0;
  for (const DriveResult& result : results) {
    meant += count(result);
    all += result.steps;
  }
  return all > 0 ? static_cast<double>(meant) / static_cast<double>(all) : 0.0;
}

}  // namespace

double shareOf(Decision::Choice choice, const std::vector<DriveResult>& results) {
  return shareOfSteps(results, [choice](const DriveResult& result) { return result.steps_by[indexOf(choice)]; });
}

double shareOf(Overruled overruled, const std::vector<DriveResult>& results) {
  return shareOfSteps(results, [overruled](const DriveResult& result) {
    return result.overruled[static_cast<std::size_t>(overruled)];
  });
}

double shareOutOfSight(Decision::Choice choice, const std::vector<DriveResult>& results) {
  const double out_of_sight = 1.0 - shareOf(Decision::Move::kGoalInSight, results);
  return out_of_sight > 0.0 ? shareOf(choice, results) / out_of_sight : 0.0;
}

double shareOnPath(const std::vector<DriveResult>& results) {
  return shareOfSteps(results, [](const DriveResult& result) { return result.steps_on_path; });
}

DriveResult drive(const World& world, const DriveTask& task, const DriveParameters& parameters, std::uint64_t seed,
                  NavigationAgent* agent, const DriveListener& listener) {
  visitRolloutParameters(parameters.rollout, RangeCheck());
  SimulatedRobot robot(world, parameters.robot, task.start, seed);
  return Run(&robot, nullptr, task, parameters, agent, listener).run();
}

DriveResult drive(Traffic* traffic, const DriveTask& task, const DriveParameters& parameters, std::uint64_t seed,
                  NavigationAgent* agent, const DriveListener& listener) {
  visitRolloutParameters(parameters.rollout, RangeCheck());
  SimulatedRobot robot(traffic, parameters.robot, task.start, seed);
  return Run(&robot, traffic, task, parameters, agent, listener).run();
}

DriveSummary summarize(const std::vector<DriveResult>& results) {
  DriveSummary summary;
  const auto countOf = [&](DriveResult::End end) {
    return static_cast<int>(
        std::count_if(results.begin(), results.end(), [end](const DriveResult& result) { return result.end == end; }));
  };
  summary.goals = static_cast<int>(results.size());
  summary.reached = countOf(DriveResult::End::kReached);
  summary.timeouts = countOf(DriveResult::End::kTimeout);
  summary.no_path = countOf(DriveResult::End::kNoPath);
  summary.elsewhere = countOf(DriveResult::End::kElsewhere);
  summary.touched = countOf(DriveResult::End::kTouched);
  summary.stuck = countOf(DriveResult::End::kStuck);
  std::vector<double> ratios;
  double time = 0.0;
  for (const DriveResult& result : results) {
    summary.contacts += result.contacts;
    summary.bumped += result.bumped;
    summary.bumped_moving += result.bumped_moving;
    if (result.end != DriveResult::End::kReached) continue;
    time += result.time;
    summary.mean_goal_error += result.goal_error;
    if (result.shortest > 0.0) ratios.push_back(result.path_length / result.shortest);
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
    summary.p95_ratio = quantile(ratios, 0.95);
  }
  return summary;
}

}  // namespace lstm_planner
