#include <gtest/gtest.h>

#include <algorithm>

#include "lstm_planner/grid_world/evaluation/grid_report.hpp"
#include "lstm_planner/grid_world/evaluation/grid_thesis.hpp"
#include "unit/grid_world/evaluation/grid_fixtures.hpp"

namespace lstm_planner::test_grid_report {
namespace {

using End = GridEpisode::End;

GridEpisode episodeOf(End end, double optimum, std::int64_t moves = 10) {
  GridEpisode episode;
  episode.end = end;
  episode.optimal_length = optimum;
  episode.straight_moves = moves;
  return episode;
}

ReportAgent agentOf(const char* name, bool searches) {
  return {{name, [](const PassableGrid&) { return std::make_unique<ScriptedAgent>(std::vector<int>{kEast}); }},
          searches};
}

/// Two agents in a maze set, where the second one misses the longer half.
GridComparison comparisonOf(const std::string& set_name) {
  GridComparison comparison;
  comparison.agents = {agentOf("A*", true), agentOf("LSTM", false)};
  GridTaskSet set;
  set.name = set_name;
  set.map_names = {"row"};
  set.maps = {PassableGrid(101, 1, true)};
  std::vector<GridEpisode> all;
  std::vector<GridEpisode> half;
  for (int length = 10; length <= 100; length += 10) {
    set.tasks.push_back({0, {0, 0}, {length, 0}, static_cast<double>(length)});
    all.push_back(episodeOf(End::kArrived, length, length));
    half.push_back(episodeOf(length <= 50 ? End::kArrived : End::kTimeout, length, 2 * length));
  }
  comparison.sets = {set};
  comparison.episodes = {{all, half}};
  return comparison;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char letter : text) {
    if (letter == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += letter;
    }
  }
  return lines;
}

TEST(ThesisTable, BelongsToTheSetsOfTheThesis) {
  ASSERT_NE(thesisTableOf("DragonAge"), nullptr);
  EXPECT_EQ(thesisTableOf("DragonAge")->number, "3.7");
  EXPECT_EQ(thesisTableOf("Mazes_8w")->number, "3.8");
  EXPECT_EQ(thesisTableOf("Random25")->number, "3.9");
  EXPECT_EQ(thesisTableOf("Mazes_2w"), nullptr);
  EXPECT_EQ(thesisTableOf("Random40"), nullptr);
  EXPECT_EQ(thesisTableOf("maze-128-128"), nullptr) << "a size";
  EXPECT_EQ(thesisTableOf("random256-40"), nullptr) << "a size";
  EXPECT_DOUBLE_EQ(thesisTableOf("Mazes_8w")->rows.back().success, 0.26);
}

TEST(GridReport, PutsTheThesisAboveOurAgents) {
  const std::vector<std::string> lines = linesOf(reportTables(comparisonOf("Mazes_8w")));
  const auto lineWith = [&](const char* text) {
    return std::find_if(lines.begin(), lines.end(),
                        [&](const std::string& line) { return line.find(text) != std::string::npos; });
  };
  EXPECT_NE(lineWith("Table 3.8"), lines.end());
  ASSERT_NE(lineWith("| *LSTM, thesis* | 26 % |"), lines.end());
  ASSERT_NE(lineWith("| LSTM | 50.0 % | 0.0 % | 50.0 % |"), lines.end());
  EXPECT_LT(lineWith("*LSTM, thesis*"), lineWith("| LSTM |"));
}

TEST(GridReport, GivesEveryRowAsManyCellsAsTheHead) {
  for (const std::string& line : linesOf(reportTables(comparisonOf("Mazes_8w")))) {
    if (line.empty() || line.front() != '|') continue;
    EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 14) << line;
  }
}

TEST(GridReport, WritesACsvLineForEachSetAndAgent) {
  const std::vector<std::string> lines = linesOf(reportCsv(comparisonOf("Rows")));
  ASSERT_EQ(lines.size(), 4u) << "head, two agents, and what is behind the last end of line";
  EXPECT_EQ(lines[2].substr(0, 24), "Rows,LSTM,10,0.5,0,0.5,2");
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(std::count(lines[i].begin(), lines[i].end(), ','), 14) << lines[i];
}

TEST(GridReport, GivesTheThesisAsManyCsvFieldsAsTheOthers) {
  const std::vector<std::string> lines = linesOf(reportCsv(comparisonOf("Mazes_8w")));
  ASSERT_EQ(lines.size(), 6u);
  // The comma within "LSTM, thesis" is no separator.
  EXPECT_EQ(std::count(lines[2].begin(), lines[2].end(), ','), 15) << lines[2];
}

TEST(SuccessTrend, FallsAsLongerPathsAreAllowed) {
  const std::vector<std::string> lines = linesOf(successTrendCsv(comparisonOf("Rows"), 0));
  ASSERT_EQ(lines.size(), 12u);
  EXPECT_EQ(lines[0], "longest optimum;A*;LSTM");
  EXPECT_EQ(lines[1], "10;1;1");
  EXPECT_EQ(lines[5], "50;1;1");
  EXPECT_EQ(lines[8], "80;1;0.625") << "5 of 8";
  EXPECT_EQ(lines[10], "100;1;0.5");
}

TEST(SuccessTrend, LeavesOutLimitsThatNoTaskKeeps) {
  GridComparison comparison = comparisonOf("Rows");
  comparison.episodes[0][0].front().optimal_length = 11.0;
  comparison.episodes[0][1].front().optimal_length = 11.0;
  EXPECT_EQ(linesOf(successTrendCsv(comparison, 0))[1], "10;;");
}

TEST(ReportPictures, AreAboutTheFirstAgentThatDoesNotSearch) {
  const std::vector<ReportPicture> pictures = choosePictures(comparisonOf("Mazes_8w"));
  ASSERT_EQ(pictures.size(), 2u) << "a timeout and an arrival in the maze; no other set, and no collision";
  EXPECT_EQ(pictures[0].name, "figure_3_12");
  EXPECT_GE(pictures[0].task, 5u) << "the first five arrive";
  EXPECT_EQ(pictures[1].name, "figure_3_13");
  EXPECT_LT(pictures[1].task, 5u);
  for (const ReportPicture& picture : pictures) {
    ASSERT_EQ(picture.agents.size(), 2u);
    EXPECT_EQ(picture.agents[0].name, "LSTM");
    EXPECT_EQ(picture.agents[1].name, "A*");
  }
}

TEST(Gallery, RunsATaskAgainWithItsPaths) {
  const GridComparison comparison = comparisonOf("Rows");
  const GridPicture picture = pictureOfTask(comparison.sets[0], 3, {comparison.agents[1].agent}, comparison.rules);
  ASSERT_EQ(picture.paths.size(), 1u);
  EXPECT_EQ(picture.paths[0].cells.size(), 40u) << "39 moves to one cell before the goal, 40 away";
  EXPECT_TRUE(picture.paths[0].arrived);
  EXPECT_EQ(picture.paths[0].label, "LSTM: arrived after 39.0");
}

TEST(Gallery, FindsDetoursTypicalArrivalsAndMisses) {
  const std::vector<GridEpisode> episodes = {episodeOf(End::kArrived, 10.0, 30), episodeOf(End::kTimeout, 90.0),
                                             episodeOf(End::kArrived, 10.0, 10), episodeOf(End::kTimeout, 20.0),
                                             episodeOf(End::kArrived, 10.0, 20)};
  EXPECT_EQ(longestDetour(episodes), std::size_t{0});
  EXPECT_EQ(typicalArrival(episodes), std::size_t{4});
  EXPECT_EQ(tasksThatEnded(episodes, End::kTimeout), (std::vector<std::size_t>{3, 1}));
  EXPECT_TRUE(tasksThatEnded(episodes, End::kCollision).empty());
  EXPECT_FALSE(longestDetour({episodeOf(End::kTimeout, 1.0)}).has_value());
}

}  // namespace
}  // namespace lstm_planner::test_grid_report
