#include "tools/train_grid_reinforcement.hpp"

#include <algorithm>
#include <iostream>
#include <string>
#include <utility>

#include "lstm_planner/common/text_table.hpp"
#include "tools/train_grid_curve.hpp"
#include "tools/train_grid_judge.hpp"
#include "tools/train_grid_maps.hpp"
#include "tools/training_host.hpp"

namespace lstm_planner {
namespace {

class GridReinforcementHost : public ToolTrainingHost {
 public:
  GridReinforcementHost(const TrainingLoopOptions& loop, GridJudge judge, const GridReinforcement& training,
                        GridLearner* learner)
      : ToolTrainingHost(loop),
        judge_(std::move(judge)),
        table_(tableOf(judge_.names())),
        training_(training),
        learner_(*learner) {}

  double judge(const LayerStack& layers) override {
    score_ = judge_.judge(layers);
    return score_.mean;
  }
  void keep(const LayerStack& layers) override { judge_.write(layers, score_); }
  void judged(const Judgement& judgement) override {
    if (!judgement.due) return;
    const ReinforcementReport report = learner_.report();
    points_.push_back({training_.epoch(), report.steps, report.reward, report.arrival, report.ratio, score_.success,
                       score_.mean, judgement.best});
    print(points_.back());
  }

  nlohmann::json notes() const override {
    nlohmann::json curve = nlohmann::json::array();
    for (const GridCurvePoint& point : points_) curve.push_back(toJson(point));
    return {{"epoch", training_.epoch()}, {"curve", curve}};
  }
  void restoreNotes(const nlohmann::json& progress) override {
    for (const auto& point : progress.at("curve")) points_.push_back(curvePointFrom(point));
  }

  void drawCurve(const std::string& file) const {
    if (!file.empty() && !points_.empty() && isFirstRank()) writeGridCurve(file, judge_.names(), points_);
  }

 private:
  double progress() const override { return training_.progress(); }
  std::string position() const override { return "epoch " + std::to_string(training_.epoch()); }
  std::string scoreText(double score) const override { return namedScore("mean arrival", score); }
  std::string resumption() const override {
    // What was learned since the last epoch ended is lost: that epoch starts anew.
    return training_.epoch() == 0 ? "there is no checkpoint before the end of the first epoch"
                                  : "the same command goes on after " + position();
  }

  void printHeader() const override {
    std::cout << table_.headings() << std::endl;
    for (const GridCurvePoint& point : points_) print(point);
  }

  static TextTable tableOf(const std::vector<std::string>& set_names) {
    constexpr std::size_t kWidth = 9;
    std::string headings = "epoch    steps [M]  reward  arrival  ratio";
    for (const std::string& name : set_names) {
      headings += "  " + std::string(kWidth - std::min(kWidth, name.size()), ' ') + name;
    }
    return TextTable(headings + "       mean");
  }

  void print(const GridCurvePoint& point) const {
    std::vector<std::string> cells = {std::to_string(point.epoch), fixedText(point.steps / 1e6, 1),
                                      fixedText(point.reward, 3), fixedText(point.arrival, 3),
                                      fixedText(point.ratio, 2)};
    for (const double success : point.success) cells.push_back(fixedText(success, 3));
    cells.push_back(fixedText(point.mean_success, 3));
    std::cout << table_.line(cells) << (point.best ? "  best" : "") << std::endl;
  }

  GridJudge judge_;
  const TextTable table_;
  const GridReinforcement& training_;
  GridLearner& learner_;
  GridScore score_;  ///< what was judged last
  std::vector<GridCurvePoint> points_;
};

}  // namespace

int trainByReinforcement(const GridReinforcementPlan& plan, GridLearner* learner) {
  const GridTrainingOptions& options = plan.options;
  TrainingLoopOptions loop;
  loop.checkpoint = options.checkpoint;
  loop.settings = plan.settings;
  loop.output = options.output;
  loop.communicator = ranks();
  GridTrainingMaps maps = loadGridTrainingMaps(options);
  GridReinforcement training(plan.training, std::move(maps.training), learner);
  GridReinforcementHost host(loop, GridJudge(options, std::move(maps.validation)), training, learner);
  const TrainingOutcome outcome = runTraining(loop, &training, &host);
  host.drawCurve(options.curve);
  return host.end(outcome);
}

}  // namespace lstm_planner
