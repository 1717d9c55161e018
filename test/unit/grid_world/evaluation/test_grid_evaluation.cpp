#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/evaluation/grid_agent_factory.hpp"
#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"
#include "support/refusal.hpp"
#include "unit/grid_world/evaluation/grid_fixtures.hpp"

namespace lstm_planner::test_grid_evaluation {
namespace {

/// Maps with random obstacles, and tasks between cells that are connected.
GridTaskSet randomSet(int maps, int tasks_per_map) {
  constexpr int kSize = 30;
  constexpr double kFill = 0.25;
  GridTaskSet set;
  set.name = "random";
  Random random(3);
  for (int i = 0; i < maps; ++i) {
    PassableGrid grid(kSize, kSize, true);
    for (int cell = 0; cell < kSize * kSize; ++cell) {
      grid.set({cell % kSize, cell / kSize}, uniform(random) >= kFill);
    }
    const auto drawCell = [&]() -> CellIndex {
      return {static_cast<int>(uniformIndex(random, kSize)), static_cast<int>(uniformIndex(random, kSize))};
    };
    for (int found = 0; found < tasks_per_map;) {
      const CellIndex start = drawCell();
      const CellIndex goal = drawCell();
      const double optimum = GridDistances(grid, goal, CornerCutting::kForbidden).at(start);
      if (!std::isfinite(optimum)) continue;
      set.tasks.push_back({set.maps.size(), start, goal, optimum});
      ++found;
    }
    set.map_names.push_back("random-" + std::to_string(i));
    set.maps.push_back(std::move(grid));
  }
  return set;
}

GridAgentMaker makerOf(const char* name) {
  GridAgentOptions options;
  options.agent = name;
  return gridAgentMaker(options);
}

std::vector<GridEpisode> evaluate(const GridTaskSet& set, const GridAgentMaker& maker, int threads) {
  GridEvaluationOptions options;
  options.threads = threads;
  return evaluateGridTasks(set, 0, set.tasks.size(), maker, options);
}

/// All but the times.
std::vector<double> results(const std::vector<GridEpisode>& episodes) {
  std::vector<double> values;
  for (const GridEpisode& episode : episodes) {
    values.insert(values.end(), {static_cast<double>(episode.end), static_cast<double>(episode.straight_moves),
                                 static_cast<double>(episode.diagonal_moves), episode.optimal_length,
                                 static_cast<double>(episode.expanded), static_cast<double>(episode.peak_bytes)});
    values.insert(values.end(), episode.led.begin(), episode.led.end());
  }
  return values;
}

GridEpisode episodeOf(GridEpisode::End end, std::int64_t moves, double optimum) {
  GridEpisode episode;
  episode.end = end;
  episode.straight_moves = moves;
  episode.optimal_length = optimum;
  return episode;
}

TEST(GridEvaluation, AStarAlwaysArrivesNoLongerThanTheOptimum) {
  const GridTaskSet set = randomSet(3, 20);
  const GridSetSummary summary = summarizeGridEpisodes(set.name, evaluate(set, makerOf("astar"), 1));
  EXPECT_EQ(summary.scenarios, 60u);
  EXPECT_EQ(summary.arrived, 60u);
  EXPECT_LE(summary.mean_ratio, 1.0);
  EXPECT_LE(summary.mean_length, summary.mean_optimal);
  EXPECT_GE(summary.mean_length, summary.mean_optimal - 2.0) << "the last move is sqrt(2) long at most, or left out "
                                                                "past a corner two straight ones";
  EXPECT_GT(summary.mean_expanded, 0.0);
  EXPECT_GT(summary.mean_time, 0.0);
  EXPECT_GT(summary.ns_per_step, 0.0);
  EXPECT_GT(summary.peak_bytes, 900);
}

TEST(GridEvaluation, DoesNotDependOnTheNumberOfThreads) {
  const GridTaskSet set = randomSet(4, 25);
  const std::vector<double> one = results(evaluate(set, makerOf("astar"), 1));
  EXPECT_EQ(one, results(evaluate(set, makerOf("astar"), 2)));
  EXPECT_EQ(one, results(evaluate(set, makerOf("astar"), 5)));
}

TEST(GridEvaluation, CanBeSplitIntoRangesOfTasks) {
  const GridTaskSet set = randomSet(3, 10);
  const std::vector<GridEpisode> whole = evaluate(set, makerOf("astar"), 1);
  std::vector<GridEpisode> parts;
  for (const auto& [first, last] : {std::pair<std::size_t, std::size_t>{0, 7}, {7, 7}, {7, 30}}) {
    const std::vector<GridEpisode> part = evaluateGridTasks(set, first, last, makerOf("astar"), {});
    parts.insert(parts.end(), part.begin(), part.end());
  }
  EXPECT_EQ(results(whole), results(parts));
}

TEST(GridEvaluation, RefusesTasksThatTheSetDoesNotHave) {
  const GridTaskSet set = randomSet(1, 3);
  const auto refusal = [&](std::size_t first, std::size_t last) {
    return test::refusalOf<std::invalid_argument>([&] { evaluateGridTasks(set, first, last, makerOf("greedy"), {}); });
  };
  EXPECT_EQ(refusal(0, 4), "the tasks from 0 to 4 are to be run, expected a range of the set's 3");
  EXPECT_EQ(refusal(2, 1), "the tasks from 2 to 1 are to be run, expected a range of the set's 3");
  EXPECT_TRUE(evaluateGridTasks(set, 3, 3, makerOf("greedy"), {}).empty());
}

TEST(GridEvaluation, TellsTheShareDoneUpToTheWhole) {
  const GridTaskSet set = randomSet(1, 8);
  std::vector<double> shares;
  GridEvaluationOptions options;
  options.threads = 1;
  options.progress = [&](double share) { shares.push_back(share); };
  evaluateGridTasks(set, 0, set.tasks.size(), makerOf("astar"), options);
  EXPECT_EQ(shares.size(), 8u);
  EXPECT_EQ(shares.back(), 1.0);
}

TEST(GridSummary, CountsEveryEndAndTakesMeansOverArrivals) {
  using End = GridEpisode::End;
  const GridSetSummary summary =
      summarizeGridEpisodes("set", {episodeOf(End::kArrived, 30, 10.0), episodeOf(End::kArrived, 10, 10.0),
                                    episodeOf(End::kCollision, 500, 10.0), episodeOf(End::kTimeout, 1000, 20.0),
                                    episodeOf(End::kNoPath, 7, 10.0)});
  EXPECT_EQ(summary.arrived, 2u);
  EXPECT_EQ(summary.collisions, 1u);
  EXPECT_EQ(summary.timeouts, 1u);
  EXPECT_EQ(summary.no_path, 1u);
  EXPECT_DOUBLE_EQ(summary.mean_ratio, 2.0);
  EXPECT_DOUBLE_EQ(summary.mean_length, 20.0);
  EXPECT_DOUBLE_EQ(summary.mean_optimal, 10.0);
  EXPECT_DOUBLE_EQ(summary.share(summary.arrived), 0.4);
}

TEST(GridSummary, QuantilesAreByNearestRank) {
  std::vector<GridEpisode> episodes;
  for (int i = 20; i >= 1; --i) episodes.push_back(episodeOf(GridEpisode::End::kArrived, i, 1.0));
  const GridSetSummary summary = summarizeGridEpisodes("set", episodes);
  EXPECT_DOUBLE_EQ(summary.median_ratio, 10.0);
  EXPECT_DOUBLE_EQ(summary.p95_ratio, 19.0);
}

TEST(GridSummary, WritesTheKeysThatReadersCountOn) {
  const nlohmann::json json = toJson(summarizeGridEpisodes(
      "Rows", {episodeOf(GridEpisode::End::kArrived, 5, 5.0), episodeOf(GridEpisode::End::kTimeout, 9, 5.0),
               episodeOf(GridEpisode::End::kTimeout, 9, 5.0), episodeOf(GridEpisode::End::kCollision, 1, 5.0)}));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"collisions", "led", "led_on_path", "mean_expanded", "mean_length",
                                            "mean_optimal", "mean_ratio", "mean_time_s", "median_ratio", "name",
                                            "ns_per_step", "overruled_by_bound", "overruled_by_shield", "p95_ratio",
                                            "peak_bytes", "scenarios", "success", "timeouts"}));
  EXPECT_EQ(json["name"], "Rows");
  EXPECT_EQ(json["scenarios"], 4);
  EXPECT_EQ(json["success"], 0.25);
  EXPECT_EQ(json["collisions"], 0.25);
  EXPECT_EQ(json["timeouts"], 0.5);
}

TEST(GridSummary, GivesTheSharesOfWhoDecidedOverTheStepsOfAllEpisodes) {
  GridEpisode mostly_network = episodeOf(GridEpisode::End::kArrived, 8, 8.0);
  mostly_network.led = {6, 0, 2, 0};
  mostly_network.on_path = 3;
  mostly_network.overruled_by_shield = 2;
  GridEpisode searched = episodeOf(GridEpisode::End::kTimeout, 12, 8.0);
  searched.led = {0, 12, 0, 0};
  searched.overruled_by_bound = 10;
  const GridSetSummary summary = summarizeGridEpisodes("set", {mostly_network, searched});
  const std::array<double, kGridLeaderCount> led = {0.3, 0.6, 0.1, 0.0};
  for (std::size_t i = 0; i < led.size(); ++i) EXPECT_DOUBLE_EQ(summary.led[i], led[i]);
  EXPECT_DOUBLE_EQ(summary.on_path, 0.15);
  EXPECT_DOUBLE_EQ(summary.overruled_by_shield, 0.1);
  EXPECT_DOUBLE_EQ(summary.overruled_by_bound, 0.5);
}

TEST(GridEvaluation, TheRememberedPathArrivesWhereThereIsAPath) {
  const GridTaskSet set = randomSet(3, 20);
  GridEvaluationOptions options;
  options.rules.max_steps = 0;
  const std::vector<GridEpisode> episodes =
      evaluateGridTasks(set, 0, set.tasks.size(), makerOf("rolling_escape"), options);
  EXPECT_EQ(summarizeGridEpisodes(set.name, episodes).arrived, set.tasks.size());
}

TEST(GridSummary, HasNoMeanWhereNoneArrived) {
  const nlohmann::json json = toJson(summarizeGridEpisodes("set", {episodeOf(GridEpisode::End::kTimeout, 9, 5.0)}));
  EXPECT_EQ(json["success"], 0.0);
  EXPECT_NE(json.dump().find("\"mean_ratio\":null"), std::string::npos);
  EXPECT_NE(json.dump().find("\"median_ratio\":null"), std::string::npos);
}

TEST(GridSummary, HasNoTimeAStepWhereNoStepWasMade) {
  std::ostringstream out;
  printGridSummaries(out, {summarizeGridEpisodes("Rows", {episodeOf(GridEpisode::End::kArrived, 0, 0.0)})});
  EXPECT_EQ(out.str().find("nan"), std::string::npos) << out.str();
}

TEST(GridSummary, RefusesNoEpisodes) { EXPECT_THROW(summarizeGridEpisodes("set", {}), std::invalid_argument); }

TEST(GridSummary, PrintsOneLineASet) {
  std::ostringstream out;
  printGridSummaries(out, {summarizeGridEpisodes("Rows", {episodeOf(GridEpisode::End::kArrived, 5, 5.0)})});
  EXPECT_NE(out.str().find("\nRows"), std::string::npos);
  EXPECT_NE(out.str().find("100.00%"), std::string::npos);
}

TEST(GridAgentFactory, MakesAgentsThatAreCertainToArrive) {
  const GridTaskSet set = randomSet(2, 10);
  GridEvaluationOptions options;
  options.rules.max_steps = 0;
  for (const char* name : {"astar", "dstar", "boundary"}) {
    const auto episodes = evaluateGridTasks(set, 0, set.tasks.size(), makerOf(name), options);
    EXPECT_EQ(summarizeGridEpisodes(set.name, episodes).arrived, 20u) << name;
  }
}

TEST(GridAgentFactory, RefusesModelsThatAreMissingOrNotForTheGrid) {
  GridAgentOptions options;
  options.agent = "lstm";
  EXPECT_THROW(gridAgentMaker(options), std::invalid_argument);
  options.model = "/no/such/model.onnx";
  EXPECT_THROW(gridAgentMaker(options), ModelFileError);
  options.model = std::string(LSTM_PLANNER_SOURCE_DIR) + "/models/create2_lstm.onnx";
  EXPECT_THROW(gridAgentMaker(options), std::invalid_argument);
}

TEST(GridAgentFactory, RefusesUnknownNames) {
  GridAgentOptions options;
  options.agent = "asta";
  EXPECT_THROW(gridAgentMaker(options), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_grid_evaluation
