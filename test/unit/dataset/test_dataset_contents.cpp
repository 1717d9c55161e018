// What is said of a dataset, and how it is put together and taken apart.

#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "lstm_planner/dataset/dataset_check.hpp"
#include "lstm_planner/dataset/dataset_edit.hpp"
#include "lstm_planner/dataset/dataset_summary.hpp"
#include "support/refusal.hpp"
#include "unit/dataset/dataset_fixtures.hpp"

namespace lstm_planner::test_dataset_contents {
namespace {

Dataset exampleDataset() {
  Dataset dataset;
  dataset.recordings = {exampleRecording(3, 1), exampleRecording(2, 50, "b.bag")};
  return dataset;
}

const QuantityRange& rangeNamed(const DatasetSummary& summary, const std::string& name) {
  static const QuantityRange none;
  const auto found = std::find_if(summary.ranges.begin(), summary.ranges.end(),
                                  [&](const QuantityRange& range) { return range.name == name; });
  EXPECT_NE(found, summary.ranges.end()) << name;
  return found == summary.ranges.end() ? none : *found;
}

TEST(DatasetSummary, CountsWhatThereIs) {
  Dataset dataset = exampleDataset();
  dataset.recordings[1].finished = false;
  dataset.recordings[1].episodes[0].episode.discarded = true;
  dataset.recordings[0].episodes[1].episode.end = EpisodeEnd::kAborted;
  dataset.recordings[0].episodes[1].steps.erase(dataset.recordings[0].episodes[1].steps.begin() + 2);
  dataset.recordings[0].episodes[2].steps[0].ranges.clear();
  const DatasetSummary summary = summarise(dataset);
  EXPECT_EQ(summary.recordings, 2);
  EXPECT_EQ(summary.unfinished, 1);
  EXPECT_EQ(summary.episodes, 4);
  EXPECT_EQ(summary.ends.at(EpisodeEnd::kArrived), 3);
  EXPECT_EQ(summary.ends.at(EpisodeEnd::kAborted), 1);
  EXPECT_EQ(summary.discarded_episodes, 1);
  EXPECT_EQ(summary.discarded_steps, 4);
  EXPECT_EQ(summary.steps, 4 + 4 + 6 + 5);
  EXPECT_EQ(summary.steps_with_scan, summary.steps - 1);
  EXPECT_EQ(summary.gaps, 1);
  EXPECT_NEAR(summary.distance, 0.15 * 19, 1e-9) << "each step of the example is 15 cm long";
  EXPECT_EQ(summary.rejections[static_cast<std::size_t>(Rejection::kStanding)], 14);
  ASSERT_EQ(summary.labels.size(), 1u);
  long labels = 0;
  for (const long count : summary.labels[0].counts) labels += count;
  EXPECT_EQ(labels, summary.steps);
}

TEST(DatasetSummary, CountsAGapAtTheStart) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(1, 1)};
  std::vector<DriveStep>& steps = dataset.recordings[0].episodes[0].steps;
  steps.erase(steps.begin());
  EXPECT_EQ(summarise(dataset).gaps, 1);
}

TEST(DatasetSummary, KnowsTheRangeOfEachQuantity) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(1, 1)};
  std::vector<DriveStep>& steps = dataset.recordings[0].episodes[0].steps;
  steps.resize(2);
  steps[0].observation.goal_distance = 3.0;
  steps[1].observation.goal_distance = 5.0;
  steps[0].pose.yaw = -2.0;
  steps[1].pose.yaw = 1.0;
  const DatasetSummary summary = summarise(dataset);
  EXPECT_EQ(rangeNamed(summary, "goal_distance").minimum, 3.0);
  EXPECT_EQ(rangeNamed(summary, "goal_distance").mean, 4.0);
  EXPECT_EQ(rangeNamed(summary, "goal_distance").maximum, 5.0);
  EXPECT_EQ(rangeNamed(summary, "pose_yaw").minimum, -2.0);
  EXPECT_EQ(rangeNamed(summary, "pose_yaw").unit, "rad");
  EXPECT_EQ(rangeNamed(summary, "sector_range").maximum, 6.0) << "the sector without a return counts as the cap";
  EXPECT_EQ(rangeNamed(summary, "minimum_range").count, 14) << "the infinite ones are left out";
  EXPECT_GT(summary.intervals.minimum, 0.4);
  EXPECT_LT(summary.intervals.maximum, 0.6);
}

TEST(DatasetSummary, KeepsLabelsApartThatMeanDifferentAngles) {
  Dataset dataset = exampleDataset();
  dataset.recordings[1].description.parameters.action_angles = {-1.0, 0.0, 1.0, 2.0, 3.0};
  const DatasetSummary summary = summarise(dataset);
  ASSERT_EQ(summary.labels.size(), 2u);
  EXPECT_EQ(summary.labels[1].angles[0], -1.0);
}

TEST(DatasetCheck, FindsNothingWrongWithWhatARecorderMakes) {
  EXPECT_EQ(checkDataset(exampleDataset()), std::vector<std::string>());
}

struct Flaw {
  const char* sentence;  ///< a part of what is to be said
  std::function<void(DriveStep*)> make;
};

TEST(DatasetCheck, FindsEachFlawAndSaysWhereItIs) {
  const std::vector<Flaw> flaws = {
      {"goal_bearing is ", [](DriveStep* step) { step->observation.goal_bearing += 0.001; }},
      {"goal_distance is ", [](DriveStep* step) { step->observation.goal_distance += 0.001; }},
      {"heading is ", [](DriveStep* step) { step->observation.heading += 0.001; }},
      {"driven_angle is ", [](DriveStep* step) { step->driven_angle += 0.001; }},
      {"its label is ", [](DriveStep* step) { step->label = (step->label + 1) % 5; }},
      {"previous_action is ", [](DriveStep* step) { step->observation.previous_action += 0.1; }},
      {"expected after ", [](DriveStep* step) { step->next_stamp = step->stamp; }},
      {"its stamp is ", [](DriveStep* step) { step->stamp += 0.01; }},
      {"pose_y is ", [](DriveStep* step) { step->pose.y += 0.01; }},
      {"it comes after step 1", [](DriveStep* step) { step->number = 1; }},
      {"sector_range_0 is 6.1 m", [](DriveStep* step) { step->observation.sector_ranges[0] = 6.1; }},
      {"sector_range_0 is 0 m", [](DriveStep* step) { step->observation.sector_ranges[0] = 0.0; }},
      {"measured_1 is 3", [](DriveStep* step) { step->measured[1] = 3; }},
      {"beams_1 and measured_1 are 3 and 1, but its scan has 1 and 1", [](DriveStep* step) { step->beams[1] = 3; }},
      {"the scan has 0 of 2 beams measured",
       [](DriveStep* step) { std::fill(step->ranges.begin(), step->ranges.end(), 0.0f); }},
      {"minimum_range_1 is ", [](DriveStep* step) { step->minimum_ranges[1] *= 0.9; }},
      {"minimum_range_2 is inf", [](DriveStep* step) { step->minimum_ranges[2] = 1.0 / 0.0; }},
      {"minimum_range_2 is 6", [](DriveStep* step) { step->minimum_ranges[2] = 6.0; }},
      {"route_length is -1", [](DriveStep* step) { step->observation.route_length = -1.0; }},
  };
  for (const Flaw& flaw : flaws) {
    Dataset dataset = exampleDataset();
    flaw.make(&dataset.recordings[1].episodes[1].steps[2]);
    const std::vector<std::string> sentences = checkDataset(dataset);
    const bool is_found = std::any_of(sentences.begin(), sentences.end(), [&](const std::string& sentence) {
      return sentence.rfind("recording 1, episode 1, step ", 0) == 0 && sentence.find(flaw.sentence) != sentence.npos;
    });
    EXPECT_TRUE(is_found) << flaw.sentence << "; said was: " << (sentences.empty() ? "nothing" : sentences[0]);
  }
}

TEST(DatasetCheck, EndsAfterMoreSentencesThanAnybodyReads) {
  Dataset dataset = exampleDataset();
  std::vector<DriveStep>& steps = dataset.recordings[0].episodes[1].steps;
  steps.assign(20000, steps[0]);
  const std::vector<std::string> sentences = checkDataset(dataset);
  EXPECT_LT(sentences.size(), 10100u);
  EXPECT_EQ(sentences.back(), "nothing behind recording 0, episode 1 was looked at");
}

TEST(DatasetCheck, AllowsAStepToBeLeftOut) {
  Dataset dataset = exampleDataset();
  std::vector<DriveStep>& steps = dataset.recordings[0].episodes[2].steps;
  steps.erase(steps.begin() + 3);
  EXPECT_EQ(checkDataset(dataset), std::vector<std::string>());
}

using DatasetEdit = DatasetTest;

TEST_F(DatasetEdit, ChecksAFileWithWhatSqliteKnows) {
  writeDataset(in("a.db"), exampleDataset());
  EXPECT_EQ(checkDatasetFile(in("a.db")), std::vector<std::string>());
  EXPECT_THROW(checkDatasetFile(in("b.db")), DatasetError);
}

TEST_F(DatasetEdit, MergesTheRecordingsInOrder) {
  Dataset a;
  a.recordings = {exampleRecording(2, 1, "a")};
  Dataset b;
  b.recordings = {exampleRecording(1, 50, "b"), exampleRecording(1, 60, "c")};
  writeDataset(in("a.db"), a);
  writeDataset(in("b.db"), b);
  const Dataset merged = mergeDatasets({in("b.db"), in("a.db")});
  ASSERT_EQ(merged.recordings.size(), 3u);
  EXPECT_EQ(merged.recordings[0].description.source, "b");
  EXPECT_EQ(merged.recordings[2].description.source, "a");
  EXPECT_EQ(stepCount(merged), 4 + 5 + 4 + 4);
  EXPECT_FALSE(merged.recordings[2].episodes[1].steps[0].ranges.empty()) << "scans are kept";
}

TEST_F(DatasetEdit, RefusesToMergeLabelsOfDifferentAnglesOrADriveTwice) {
  Dataset a;
  a.recordings = {exampleRecording(2, 1)};
  writeDataset(in("a.db"), a);
  Dataset part = a;  // a copy made while it was being recorded
  part.recordings[0].episodes.pop_back();
  part.recordings[0].episodes[0].steps.pop_back();
  writeDataset(in("part.db"), part);
  Dataset other;
  other.recordings = {exampleRecording(1, 50)};
  other.recordings[0].description.parameters.action_angles = {-0.5, 0.0, 0.5, 1.0, 1.5};
  writeDataset(in("other.db"), other);
  const auto refusal = [](const std::vector<std::string>& paths) {
    return test::refusalOf<DatasetError>([&] { mergeDatasets(paths); });
  };
  EXPECT_EQ(refusal({in("a.db"), in("other.db")}), "the labels of '" + in("other.db") +
                                                       "' stand for the angles -0.5, 0, 0.5, 1, 1.5 rad, those of '" +
                                                       in("a.db") + "' for -1.5708, -0.785398, 0, 0.785398, 1.5708");
  EXPECT_NE(refusal({in("a.db"), in("part.db")}).find("is in '" + in("a.db") + "' and in '" + in("part.db") + "'"),
            std::string::npos);
  EXPECT_NE(refusal({in("a.db"), in("a.db")}).find("is in '" + in("a.db") + "' and in '" + in("a.db") + "'"),
            std::string::npos);
}

/// Stamps tell episodes of the example apart.
std::set<double> begunIn(const Dataset& dataset) {
  std::set<double> begun;
  for (const Recording& recording : dataset.recordings) {
    for (const RecordedEpisode& episode : recording.episodes) begun.insert(episode.episode.begun);
  }
  return begun;
}

TEST(DatasetSplit, TakesWholeEpisodesAboutTheShareOfTheSteps) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(12, 1), exampleRecording(8, 50)};
  const double steps = static_cast<double>(stepCount(dataset));
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double share : {0.1, 0.25, 0.5, 0.8}) {
      const DatasetSplit split = splitDataset(dataset, share, seed);
      EXPECT_EQ(stepCount(split.training) + stepCount(split.validation), stepCount(dataset));
      // Nearer than half the longest episode, of 15 steps, there need not be a choice.
      EXPECT_NEAR(static_cast<double>(stepCount(split.validation)), share * steps, 7.5) << share << " " << seed;
      std::set<double> all = begunIn(split.training);
      for (const double begun : begunIn(split.validation)) {
        EXPECT_TRUE(all.insert(begun).second) << "an episode is in both";
      }
      EXPECT_EQ(all, begunIn(dataset));
    }
  }
}

TEST(DatasetSplit, IsTheSameForTheSameSeedOnly) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(12, 1)};
  EXPECT_EQ(begunIn(splitDataset(dataset, 0.3, 1).validation), begunIn(splitDataset(dataset, 0.3, 1).validation));
  EXPECT_NE(begunIn(splitDataset(dataset, 0.3, 1).validation), begunIn(splitDataset(dataset, 0.3, 2).validation));
}

TEST(DatasetSplit, GivesEitherPartAnEpisodeAndLeavesDiscardedOnesInTheFirst) {
  Dataset dataset;
  dataset.recordings = {exampleRecording(3, 1)};
  dataset.recordings[0].episodes[0].episode.discarded = true;
  for (const double share : {0.001, 0.5, 0.999}) {
    const DatasetSplit split = splitDataset(dataset, share, 1);
    EXPECT_GT(stepCount(split.training), 0) << share;
    EXPECT_GT(stepCount(split.validation), 0) << share;
    EXPECT_EQ(split.training.recordings[0].episodes.size(), 2u) << "with the discarded one";
    EXPECT_EQ(split.training.recordings[0].rejections, dataset.recordings[0].rejections);
    EXPECT_EQ(split.validation.recordings[0].rejections, RejectionCounts{});
  }
  const auto refusal = [&](double share) {
    return test::refusalOf<std::invalid_argument>([&] { splitDataset(dataset, share, 1); });
  };
  for (const char* share : {"0", "1"}) {
    EXPECT_EQ(refusal(std::stod(share)),
              "the share of the validation set is " + std::string(share) + ", expected more than 0 and less than 1");
  }
  dataset.recordings[0].episodes[1].steps.clear();
  EXPECT_EQ(refusal(0.5), "a dataset with 1 episodes cannot be split, expected at least 2 with steps");
}

}  // namespace
}  // namespace lstm_planner::test_dataset_contents
