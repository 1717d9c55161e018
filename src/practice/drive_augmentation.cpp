#include "practice/drive_augmentation.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/random.hpp"

namespace lstm_planner {
namespace {

constexpr double kMirroredAngle = 1e-4;  ///< rad

void requireSymmetric(const std::vector<double>& actions) {
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (std::abs(actions[i] + actions[actions.size() - 1 - i]) < kMirroredAngle) continue;
    std::ostringstream message;
    message << "the allowed angle of " << actions[i] << " rad has no counterpart on the other side, expected one to "
            << "mirror drives";
    throw std::invalid_argument(message.str());
  }
}

Pose2 mirrored(const Pose2& pose) { return {pose.x, -pose.y, -pose.yaw}; }

void mirror(DriveStep* step, int actions) {
  step->pose = mirrored(step->pose);
  step->next_pose = mirrored(step->next_pose);
  step->twist.angular = -step->twist.angular;
  step->goal.y = -step->goal.y;
  step->observation = mirrored(step->observation);
  std::reverse(step->minimum_ranges.begin(), step->minimum_ranges.end());
  std::reverse(step->beams.begin(), step->beams.end());
  std::reverse(step->measured.begin(), step->measured.end());
  step->driven_angle = normalizeAngle(-step->driven_angle);
  step->label = actions - 1 - step->label;
  // The same beams in the other order, of a scanner on the other side.
  ScanGeometry& geometry = step->geometry;
  geometry.angle_min = -(geometry.angle_min + (geometry.beams - 1) * geometry.angle_increment);
  geometry.mount.pose = mirrored(geometry.mount.pose);
  std::reverse(step->ranges.begin(), step->ranges.end());
}

}  // namespace

RecordedEpisode mirrored(RecordedEpisode episode, const std::vector<double>& actions) {
  requireSymmetric(actions);
  for (DriveStep& step : episode.steps) mirror(&step, static_cast<int>(actions.size()));
  return episode;
}

RecordedEpisode turned(RecordedEpisode episode, double angle) {
  const Pose2 turn{0.0, 0.0, angle};
  for (DriveStep& step : episode.steps) {
    step.pose = compose(turn, step.pose);
    step.next_pose = compose(turn, step.next_pose);
    step.goal = toParentFrame(turn, step.goal);
    step.observation.heading = normalizeAngle(step.observation.heading + angle);
  }
  return episode;
}

Dataset variantsOf(const Dataset& dataset, int count, std::uint64_t seed) {
  Random random(seed);
  Dataset variants;
  for (const Recording& recording : dataset.recordings) {
    Recording varied;
    varied.description = recording.description;
    varied.finished = recording.finished;
    for (const RecordedEpisode& episode : recording.episodes) {
      if (episode.episode.discarded) continue;
      for (int variant = 0; variant < count; ++variant) {
        RecordedEpisode other = turned(episode, uniform(random, -M_PI, M_PI));
        const bool mirror = variant % 2 == 0;
        varied.episodes.push_back(mirror ? mirrored(std::move(other), recording.description.parameters.action_angles)
                                         : std::move(other));
      }
    }
    variants.recordings.push_back(std::move(varied));
  }
  return variants;
}

}  // namespace lstm_planner
