#pragma once

#include <cmath>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/drive/decision/action_set.hpp"

namespace lstm_planner {

/// Steps of a drive through open space: the driver turns to the allowed angle nearest to the goal's bearing and goes
/// 0.15 m that way, again and again.
inline RecordedEpisode driveTowards(const Point2& goal, int steps, const Pose2& start = {}) {
  const ActionSet actions;
  RecordedEpisode recorded;
  recorded.episode.goal.pose = {goal.x, goal.y, 0.0};
  Pose2 pose = start;
  double previous = 0.0;
  for (int number = 0; number < steps; ++number) {
    Sectors sectors;
    sectors.range.fill(6.0);
    DriveStep step;
    step.number = number;
    step.stamp = 0.5 * number;
    step.next_stamp = step.stamp + 0.5;
    step.pose = pose;
    step.goal = goal;
    step.observation = observe(sectors, pose, goal, previous);
    step.label = actions.nearest(step.observation.goal_bearing);
    step.driven_angle = actions.angle(step.label);
    step.geometry = {"laser", -M_PI_2, M_PI / 180.0, 181, 0.02, 30.0, {}};
    pose.yaw = normalizeAngle(pose.yaw + step.driven_angle);
    const Point2 next = pointAlong(pose, pose.yaw, 0.15);
    pose = {next.x, next.y, pose.yaw};
    step.next_pose = pose;
    previous = step.driven_angle;
    recorded.steps.push_back(step);
  }
  return recorded;
}

/// A recording of such drives, to goals all around.
inline Dataset drivesAllAround(int episodes, int steps, std::uint64_t seed) {
  Random random(seed);
  Dataset dataset;
  dataset.recordings.emplace_back();
  dataset.recordings[0].description.source = "test";
  for (int episode = 0; episode < episodes; ++episode) {
    const double direction = uniform(random, -M_PI, M_PI);
    const Point2 goal = {8.0 * std::cos(direction), 8.0 * std::sin(direction)};
    dataset.recordings[0].episodes.push_back(driveTowards(goal, steps, {0.0, 0.0, uniform(random, -M_PI, M_PI)}));
  }
  return dataset;
}

}  // namespace lstm_planner
