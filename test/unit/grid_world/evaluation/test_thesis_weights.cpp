#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"
#include "lstm_planner/grid_world/evaluation/grid_thesis.hpp"
#include "support/real_data.hpp"
#include "support/thesis_network.hpp"

namespace lstm_planner::test_thesis_weights {
namespace {

/// The agent of the author's program with his weights: his inputs and his order of the moves; the hidden state starts
/// anew every ten steps.
class AuthorsAgent : public GridAgent {
 public:
  AuthorsAgent() : network_(realData("golden"), "lstm_2-8-512-11_iter367500") {}

  void start(CellIndex /*start*/, CellIndex /*goal*/) override {
    steps_ = 0;
    move_ = 0;
  }
  void observe(const GridObservation& observation) override {
    constexpr int kStepsAState = 10;
    if (steps_++ % kStepsAState == 0) network_.reset();
    std::array<float, ThesisNetwork::kInputs> inputs{};
    for (std::size_t move = 0; move < kMoves.size(); ++move) {
      const auto direction = static_cast<std::size_t>(rayBetween({0, 0}, kMoves[move]));
      inputs[move] = 2.0f * static_cast<float>(observation.ranges[direction] * moveLength(static_cast<int>(direction)));
    }
    const int columns = observation.cell.column - observation.goal.column;
    const int rows = observation.cell.row - observation.goal.row;
    inputs[8] = 4.0f * static_cast<float>(std::hypot(columns, rows));
    inputs[9] = static_cast<float>(std::atan2(rows, columns));
    inputs[10] = static_cast<float>(move_);
    network_.forward(inputs).maxCoeff(&move_);
  }
  int decide() override { return rayBetween({0, 0}, kMoves[static_cast<std::size_t>(move_)]); }
  GridLeader leader() const override { return GridLeader::kNetwork; }
  std::size_t peakBytes() const override { return sizeof(*this); }

 private:
  static constexpr std::array<CellIndex, 8> kMoves = {
      {{0, 1}, {1, 0}, {0, -1}, {-1, 0}, {-1, -1}, {1, 1}, {-1, 1}, {1, -1}}};

  ThesisNetwork network_;
  Eigen::Index move_ = 0;
  int steps_ = 0;
};

/// Share of arrivals by the thesis's rules: corners cut, no shield, 1,000 steps as in the author's program.
double success(const char* set, double max_length) {
  ScenarioSelection selection;
  selection.min_length = 10.0;
  selection.max_length = max_length;
  selection.count = 400;
  selection.rule = PassableRule::kThesis;
  const GridTaskSet tasks =
      drawGridTasks(findGridSets((std::filesystem::path(realData("movingai")) / set).string()).front(), selection);
  GridEvaluationOptions options;
  options.rules.corner_cutting = CornerCutting::kAllowed;
  const auto episodes = evaluateGridTasks(
      tasks, 0, tasks.tasks.size(), [](const PassableGrid&) { return std::make_unique<AuthorsAgent>(); }, options);
  const GridSetSummary summary = summarizeGridEpisodes(set, episodes);
  std::cout << set << ", paths of 10 to " << max_length << " cells: " << 100.0 * summary.share(summary.arrived)
            << " % arrived, " << 100.0 * summary.share(summary.collisions) << " % collided\n";
  return summary.share(summary.arrived);
}

/// Two standard deviations of what fifty tasks give.
double uncertainty(double share) { return 2.0 * std::sqrt(share * (1.0 - share) / 50.0); }

// What the thesis prints (Tables 3.7-3.9) is what its weights do on paths of at most 120 cells, the first 300 scenarios
// of a file of the benchmark, and not on paths of at most 300 cells.
TEST(ThesisWeights, ArriveAsPrintedInTheFirst300ScenariosOfAFile) {
  SKIP_WITHOUT_REAL_DATA(realData("golden"));
  SKIP_WITHOUT_REAL_DATA(realData("movingai"));
  for (const char* set : {"DragonAge", "Mazes_8w", "Random25"}) {
    const double printed = thesisTableOf(set)->rows.back().success;
    EXPECT_NEAR(success(set, 120.0), printed, uncertainty(printed)) << set;
  }
}

TEST(ThesisWeights, ArriveLessOftenThanPrintedOnPathsOfUpTo300Cells) {
  SKIP_WITHOUT_REAL_DATA(realData("golden"));
  SKIP_WITHOUT_REAL_DATA(realData("movingai"));
  for (const char* set : {"DragonAge", "Mazes_8w", "Random25"}) {
    EXPECT_LT(success(set, 300.0), thesisTableOf(set)->rows.back().success - 0.1) << set;
  }
}

}  // namespace
}  // namespace lstm_planner::test_thesis_weights
