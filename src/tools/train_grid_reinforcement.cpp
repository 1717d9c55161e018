#include "tools/train_grid_reinforcement.hpp"

#include <iomanip>
#include <iostream>
#include <string>
#include <utility>

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
      : ToolTrainingHost(loop), judge_(std::move(judge)), training_(training), learner_(*learner) {}

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
    std::cout << "epoch    steps [M]  reward  arrival  ratio";
    for (const std::string& name : judge_.names()) std::cout << "  " << std::setw(9) << name;
    std::cout << "       mean" << std::endl;
    for (const GridCurvePoint& point : points_) print(point);
  }

  static void print(const GridCurvePoint& point) {
    std::cout << std::fixed << std::setw(5) << point.epoch << std::setw(13) << std::setprecision(1) << point.steps / 1e6
              << std::setprecision(3) << std::setw(8) << point.reward << std::setw(9) << point.arrival << std::setw(7)
              << std::setprecision(2) << point.ratio << std::setprecision(3);
    for (const double success : point.success) std::cout << "  " << std::setw(9) << success;
    std::cout << "  " << std::setw(9) << point.mean_success << (point.best ? "  best" : "") << std::endl;
  }

  GridJudge judge_;
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
