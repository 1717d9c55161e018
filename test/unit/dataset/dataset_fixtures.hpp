#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/drive/decision/action_set.hpp"
#include "support/folder_test.hpp"
#include "support/refusal.hpp"

namespace lstm_planner {

using DatasetTest = test::FolderTest;

inline RecordingDescription exampleDescription(const std::string& source = "live") {
  RecordingDescription description;
  description.parameters.period = 0.4;
  description.source = source;
  description.odometry_frame = "odom";
  description.begun = "2026-11-21T12:00:00Z";
  return description;
}

/// 190 degrees, upside down; `beams` of 0: scans are not kept, those that were seen had 16.
inline ScanGeometry exampleGeometry(int beams) {
  const int count = beams > 0 ? beams : 16;
  const double span = degreesToRadians(190.0);
  return {"laser", -0.5 * span, span / (count - 1), count, 0.02, 30.0, {{0.1, 0.0, 0.01}, true}};
}

/// A robot that drives about as a recorder would see it: every number follows from the ones that it depends on, and
/// none is round.
inline RecordedEpisode exampleEpisode(int steps, unsigned seed, int beams = 16) {
  constexpr double kCap = 6.0;
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  Random random(seed);
  const ActionSet actions(RecorderParameters().action_angles);
  RecordedEpisode recorded;
  Episode& episode = recorded.episode;
  episode.goal = {"map", {uniform(random, 3.0, 4.0), 1.0 / 3.0, 0.1}};
  episode.goal_source = "move_base/goal";
  episode.begun = 1700000000.0 + uniform(random, 0.0, 1e6);
  episode.end = EpisodeEnd::kArrived;

  Pose2 pose{uniform(random), uniform(random), uniform(random, -3.0, 3.0)};
  double stamp = episode.begun;
  double previous_action = 0.0;
  for (int i = 0; i < steps; ++i) {
    DriveStep step;
    step.number = i;
    step.stamp = stamp;
    step.next_stamp = stamp + uniform(random, 0.45, 0.55);
    step.pose = pose;
    const int label = static_cast<int>(uniformIndex(random, 5));
    const double direction = pose.yaw + actions.angle(label) + uniform(random, -0.3, 0.3);
    const Point2 next = pointAlong(pose, direction, 0.15);
    step.next_pose = {next.x, next.y, direction};
    step.twist = {uniform(random, 0.1, 0.3), uniform(random, -0.5, 0.5)};
    step.goal = {episode.goal.pose.x + 0.01, episode.goal.pose.y - 0.02};
    step.geometry = exampleGeometry(beams);
    LaserScan scan = scanOf(step.geometry, {});
    for (int beam = 0; beam < step.geometry.beams; ++beam) {
      const double direction = step.geometry.mount.pose.yaw - scan.angle_min - beam * scan.angle_increment;
      const bool in_empty_sector = direction >= -M_PI / 8.0 && direction < 0.0;
      scan.ranges.push_back(in_empty_sector ? kNothing : static_cast<float>(uniform(random, 0.1, 9.0)));
    }
    scan.ranges[2] = std::numeric_limits<float>::quiet_NaN();
    const Sectors sectors = averageSectors(scan, step.geometry.mount, {}, kCap);
    step.beams = sectors.beams;
    step.measured = sectors.measured;
    step.minimum_ranges = sectors.nearest;
    if (beams > 0) step.ranges = scan.ranges;
    step.observation = observe(sectors, pose, step.goal, previous_action);
    step.observation.visits[2] = 1.5;
    step.driven_angle = drivenAngle(step.pose, step.next_pose, RecorderParameters().min_step_distance);
    step.label = actions.nearest(step.driven_angle);
    previous_action = actions.angle(step.label);
    pose = step.next_pose;
    stamp = step.next_stamp;
    recorded.steps.push_back(step);
  }
  episode.ended = stamp;
  return recorded;
}

/// A finished recording of `episodes` drives of 4, 5, 6 ... steps.
inline Recording exampleRecording(int episodes, unsigned seed, const std::string& source = "live") {
  Recording recording;
  recording.description = exampleDescription(source);
  recording.finished = true;
  recording.rejections[static_cast<std::size_t>(Rejection::kStanding)] = 7;
  for (int i = 0; i < episodes; ++i) {
    recording.episodes.push_back(exampleEpisode(4 + i, seed + 100 * static_cast<unsigned>(i)));
  }
  return recording;
}

/// A folder with a dataset in a.db.
class ExampleFileTest : public DatasetTest {
 protected:
  /// `episodes`: see exampleRecording().
  explicit ExampleFileTest(int episodes = 2) {
    Dataset dataset;
    dataset.recordings = {exampleRecording(episodes, 1)};
    writeDataset(in("a.db"), dataset);
  }
};

}  // namespace lstm_planner
