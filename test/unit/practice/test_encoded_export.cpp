#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/practice/dataset_sequences.hpp"
#include "lstm_planner/practice/encoded_export.hpp"
#include "support/scratch_folder.hpp"
#include "unit/simulation/recorded_drives_fixtures.hpp"

namespace lstm_planner::test_encoded_export {
namespace {

using Row = std::vector<std::string>;

std::vector<Row> rowsOf(const std::string& path) {
  std::ifstream file(path);
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

Dataset twoEpisodes() {
  Dataset dataset;
  dataset.recordings.emplace_back();
  dataset.recordings[0].episodes = {driveTowards({3.0, 4.0}, 7), driveTowards({-2.0, 1.0}, 5)};
  return dataset;
}

TEST(EncodedExport, HoldsWhatTheTrainerHereLearnsFrom) {
  const test::ScratchFolder folder;
  const Dataset dataset = twoEpisodes();
  DatasetSequenceParameters parameters;
  parameters.policy = policyOf(dataset);
  exportEncodedCsv(folder / "encoded.csv", dataset, parameters.policy, {0.0, 0.4});
  const std::vector<Row> rows = rowsOf(folder / "encoded.csv");
  const std::vector<std::string>& layout = parameters.policy.encoder.input_layout;
  ASSERT_EQ(rows.size(), 1u + 7u + 5u);
  ASSERT_EQ(rows[0].size(), 2 + layout.size() + 2);
  EXPECT_EQ(rows[0][0] + rows[0][1] + rows[0][2], "episodestep" + layout[0]);
  EXPECT_EQ(rows[0][2 + layout.size()], "label_0");
  EXPECT_EQ(rows[0][3 + layout.size()], "label_0.4");
  const std::vector<Sequence> driven = datasetSequences(dataset, parameters);
  parameters.label_distance = 0.4;
  const std::vector<Sequence> ahead = datasetSequences(dataset, parameters);
  std::size_t row = 1;
  for (std::size_t episode = 0; episode < 2; ++episode) {
    for (Eigen::Index step = 0; step < driven[episode].steps(); ++step, ++row) {
      EXPECT_EQ(rows[row][0], std::to_string(episode));
      EXPECT_EQ(rows[row][1], std::to_string(step));
      for (std::size_t i = 0; i < layout.size(); ++i) {
        EXPECT_EQ(std::stof(rows[row][2 + i]), driven[episode].inputs(static_cast<Eigen::Index>(i), step)) << layout[i];
      }
      EXPECT_EQ(rows[row][2 + layout.size()], std::to_string(driven[episode].labels[step]));
      EXPECT_EQ(rows[row][3 + layout.size()], std::to_string(ahead[episode].labels[step]));
    }
  }
}

TEST(EncodedExport, PreviousActionIsThatOfTheFirstLabelWhateverTheOthersAre) {
  const test::ScratchFolder folder;
  Dataset dataset = twoEpisodes();
  dataset.recordings[0].episodes.push_back(driveTowards({0.4, 0.3}, 12));  // past the goal and back
  exportEncodedCsv(folder / "encoded.csv", dataset, policyOf(dataset), {0.0, 0.4});
  const std::vector<Row> rows = rowsOf(folder / "encoded.csv");
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
  };
  int different = 0;
  for (std::size_t row = 2; row < rows.size(); ++row) {
    if (rows[row][column("step")] == "0") continue;
    const Row& before = rows[row - 1];
    EXPECT_EQ(std::stof(rows[row][column("previous_action")]), 0.5f * (std::stof(before[column("label_0")]) - 2.0f));
    different += before[column("label_0")] != before[column("label_0.4")] ? 1 : 0;
  }
  EXPECT_GT(different, 0);
}

TEST(EncodedExport, NeedsALabelDistanceAndAPlaceToWriteTo) {
  const Dataset dataset = twoEpisodes();
  EXPECT_THROW(exportEncodedCsv("encoded.csv", dataset, policyOf(dataset), {}), std::invalid_argument);
  EXPECT_THROW(exportEncodedCsv("/nowhere/encoded.csv", dataset, policyOf(dataset), {0.0}), DatasetError);
}

}  // namespace
}  // namespace lstm_planner::test_encoded_export
