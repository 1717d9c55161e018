#include "lstm_planner/dataset/dataset_check.hpp"

#include <Poco/Data/Statement.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "dataset/dataset_file.hpp"
#include "dataset/dataset_rows.hpp"
#include "lstm_planner/drive/decision/action_set.hpp"
#include "lstm_planner/drive/perception/sectors.hpp"

namespace lstm_planner {

namespace {

// Numbers that follow from others were calculated from the same bits; the rest is for other compilers.
constexpr double kRounding = 1e-9;
constexpr std::size_t kMostSentences = 10000;  // nobody reads more

/// Looks at the steps of an episode and collects sentences.
class EpisodeCheck {
 public:
  EpisodeCheck(const RecorderParameters& parameters, const std::string& name, std::vector<std::string>* sentences)
      : parameters_(parameters), actions_(parameters.action_angles), name_(name), sentences_(*sentences) {}

  void check(const RecordedEpisode& recorded) {
    const Episode& episode = recorded.episode;
    const DriveStep* before = nullptr;
    for (const DriveStep& step : recorded.steps) {
      if (sentences_.size() >= kMostSentences) return;
      where_ = name_ + ", step " + std::to_string(step.number);
      checkOrder(episode, step, before);
      checkLabel(step);
      checkObservation(step);
      checkSectors(step);
      checkScan(step);
      before = &step;
    }
    where_ = name_;
    if (episode.end != EpisodeEnd::kRunning && before != nullptr && before->next_stamp > episode.ended) {
      say("it ended at ", episode.ended, " s, expected after its last step at ", before->next_stamp, " s");
    }
  }

 private:
  template <typename... Words>
  void say(const Words&... words) {
    std::ostringstream sentence;
    sentence.precision(15);
    sentence << where_ << ": ";
    (sentence << ... << words);
    sentences_.push_back(sentence.str());
  }

  void expectNear(const char* name, double value, double expected) {
    if (std::abs(value - expected) <= kRounding * std::max(1.0, std::abs(expected))) return;
    say(name, " is ", value, ", expected ", expected);
  }

  void expectAngle(const char* name, double value, double expected) {
    if (std::abs(normalizeAngle(value - expected)) > kRounding) say(name, " is ", value, " rad, expected ", expected);
  }

  void checkOrder(const Episode& episode, const DriveStep& step, const DriveStep* before) {
    if (!(step.next_stamp > step.stamp)) {
      say("the next step is at ", step.next_stamp, " s, expected after ", step.stamp, " s");
    }
    if (before == nullptr) {
      if (step.stamp < episode.begun) say("it is at ", step.stamp, " s, expected after ", episode.begun, " s");
      if (step.number == 0) expectNear("the first previous action", step.observation.previous_action, 0.0);
      return;
    }
    if (step.number <= before->number) say("it comes after step ", before->number);
    if (step.number != before->number + 1) {
      if (step.stamp < before->next_stamp) say("it comes before the end of step ", before->number);
      return;
    }
    if (step.stamp != before->next_stamp) say("its stamp is ", step.stamp, " s, expected ", before->next_stamp, " s");
    expectNear("pose_x", step.pose.x, before->next_pose.x);
    expectNear("pose_y", step.pose.y, before->next_pose.y);
    expectAngle("pose_yaw", step.pose.yaw, before->next_pose.yaw);
    expectNear("previous_action", step.observation.previous_action, actions_.angle(before->label));
  }

  void checkLabel(const DriveStep& step) {
    expectAngle("driven_angle", step.driven_angle,
                drivenAngle(step.pose, step.next_pose, parameters_.min_step_distance));
    const int nearest = actions_.nearest(step.driven_angle);
    if (step.label != nearest) {
      say("its label is ", step.label, ", expected ", nearest, ", the nearest to ", step.driven_angle, " rad");
    } else if (std::abs(normalizeAngle(step.driven_angle - actions_.angle(nearest))) > parameters_.max_label_error) {
      say("driven_angle is ", step.driven_angle, " rad, expected within ", parameters_.max_label_error,
          " rad of the angle of its label, ", actions_.angle(nearest), " rad");
    }
  }

  void checkObservation(const DriveStep& step) {
    const Observation& seen = step.observation;
    const double distance = distanceBetween(step.pose, step.goal);
    expectNear("goal_distance", seen.goal_distance, distance);
    if (distance > 0.0)
      expectAngle("goal_bearing", seen.goal_bearing, directionTo(step.pose, step.goal) - step.pose.yaw);
    expectAngle("heading", seen.heading, step.pose.yaw);
    if (seen.route_length < 0.0) say("route_length is ", seen.route_length, " m, expected 0 or more");
    if (std::abs(seen.route_bearing) > M_PI + kRounding) say("route_bearing is ", seen.route_bearing, " rad");
  }

  void checkSectors(const DriveStep& step) {
    const double cap = parameters_.range_cap;
    for (std::size_t i = 0; i < step.beams.size(); ++i) {
      const double range = step.observation.sector_ranges[i];
      const double nearest = step.minimum_ranges[i];
      if (!(range > 0.0) || range > cap * (1.0 + kRounding)) {
        say("sector_range_", i, " is ", range, " m, expected more than 0 and at most ", cap, " m");
      }
      if (step.measured[i] < 0 || step.measured[i] > step.beams[i]) {
        say("measured_", i, " is ", step.measured[i], ", expected 0 to ", step.beams[i]);
      }
      if (std::isinf(nearest) != (step.measured[i] == 0)) {
        say("minimum_range_", i, " is ", nearest, " m, but ", step.measured[i], " beams were measured");
      }
      if (std::min(nearest, cap) > range * (1.0 + kRounding)) {
        say("minimum_range_", i, " is ", nearest, " m, expected at most the mean range of ", range, " m");
      }
    }
  }

  /// Means depend on what a reading without a return stands for, and that is not in the file.
  void checkScan(const DriveStep& step) {
    if (step.ranges.empty()) return;
    try {
      const LaserScan scan = scanOf(step.geometry, step.ranges);
      compare(step, averageSectors(scan, step.geometry.mount, parameters_.scan_rules, parameters_.range_cap));
    } catch (const UnusableScan& error) {
      say(error.what());
    }
  }

  void compare(const DriveStep& step, const Sectors& scan) {
    for (std::size_t i = 0; i < scan.beams.size(); ++i) {
      if (step.beams[i] != scan.beams[i] || step.measured[i] != scan.measured[i]) {
        say("beams_", i, " and measured_", i, " are ", step.beams[i], " and ", step.measured[i], ", but its scan has ",
            scan.beams[i], " and ", scan.measured[i]);
      } else if (step.minimum_ranges[i] != scan.nearest[i]) {
        say("minimum_range_", i, " is ", step.minimum_ranges[i], " m, but the nearest in its scan is ", scan.nearest[i],
            " m");
      }
    }
  }

  const RecorderParameters& parameters_;
  ActionSet actions_;
  std::string name_;
  std::string where_;
  std::vector<std::string>& sentences_;
};

/// The rows of a PRAGMA that finds something wrong.
std::vector<std::string> rowsOf(DatasetFile* file, const std::string& pragma) {
  using Poco::Data::Keywords::into;
  using Poco::Data::Keywords::now;
  std::vector<std::string> rows;
  file->session() << pragma, into(rows), now;
  return rows;
}

}  // namespace

std::vector<std::string> checkDataset(const Dataset& dataset) {
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < dataset.recordings.size(); ++i) {
    const Recording& recording = dataset.recordings[i];
    const std::string name = "recording " + std::to_string(i);
    for (std::size_t k = 0; k < recording.episodes.size(); ++k) {
      EpisodeCheck(recording.description.parameters, name + ", episode " + std::to_string(k), &sentences)
          .check(recording.episodes[k]);
      if (sentences.size() < kMostSentences) continue;
      sentences.push_back("nothing behind " + name + ", episode " + std::to_string(k) + " was looked at");
      return sentences;
    }
  }
  return sentences;
}

std::vector<std::string> checkDatasetFile(const std::string& path) {
  constexpr int kPatience = 10000;  // ms
  DatasetFile file(path, DatasetFile::Use::kRead, kPatience);
  std::vector<std::string> sentences;
  Dataset dataset;
  file.transact([&] {
    for (const std::string& row : rowsOf(&file, "PRAGMA integrity_check")) {
      if (row != "ok") sentences.push_back("SQLite finds the file damaged: " + row);
    }
    const std::size_t orphans = rowsOf(&file, "PRAGMA foreign_key_check").size();
    if (orphans > 0) sentences.push_back(std::to_string(orphans) + " rows belong to rows that are not there");
    if (sentences.empty()) dataset = readRows(&file, true);
  });
  const std::vector<std::string> more = checkDataset(dataset);
  sentences.insert(sentences.end(), more.begin(), more.end());
  return sentences;
}

}  // namespace lstm_planner
