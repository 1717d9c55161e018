#include "tools/train_grid_reinforcement.hpp"

#include <iomanip>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/base/learning/training_checkpoint.hpp"
#include "tools/interruption.hpp"
#include "tools/progress.hpp"
#include "tools/ranges.hpp"
#include "tools/ranks.hpp"
#include "tools/train_grid_curve.hpp"
#include "tools/train_grid_judge.hpp"
#include "tools/train_grid_maps.hpp"

namespace lstm_planner {
namespace {

/// Updates between replacements of one of the course's goals.
constexpr int kRenewalInterval = 8;

class ReinforcementTraining {
 public:
  ReinforcementTraining(const ReinforcementPlan& plan, GridTrainingMaps maps, ReinforcementLearner* learner)
      : plan_(plan),
        options_(plan_.options),
        training_(std::move(maps.training)),
        judge_(options_, std::move(maps.validation)),
        learner_(learner) {}

  int run() {
    const Interruption interruption;
    restore();
    printHeader();
    while (epoch_ < options_.epochs) {
      if (!runEpoch(interruption)) return stop(interruption);
      ++epoch_;
      judgeEpoch();
      writeCheckpoint();
    }
    bar_.show(1.0);
    drawCurve();
    std::cout << "wrote " << options_.output << ": mean arrival " << judge_.best() << std::endl;
    return 0;
  }

 private:
  int firstUpdate(int epoch) const {
    return static_cast<int>(static_cast<std::int64_t>(plan_.updates) * epoch / options_.epochs);
  }

  /// False when interrupted.
  bool runEpoch(const Interruption& interruption) {
    GridCourse course(plan_.course, training_, options_.seed + static_cast<std::uint64_t>(epoch_), options_.threads);
    learner_->beginEpoch(epoch_, course);
    for (int update = firstUpdate(epoch_); update < firstUpdate(epoch_ + 1); ++update) {
      if (interruption.wanted()) return false;
      learner_->update();
      if (update % kRenewalInterval == kRenewalInterval - 1) course.renew(1);
      bar_.show(static_cast<double>(update + 1) / plan_.updates);
    }
    return true;
  }

  void judgeEpoch() {
    const ReinforcementReport report = learner_->report();
    const GridScore score = judge_.judge(learner_->layers());
    GridCurvePoint point{epoch_,       report.steps,  report.reward, report.arrival,
                         report.ratio, score.success, score.mean,    judge_.keepIfBest(learner_->layers(), score)};
    print(point);
    points_.push_back(std::move(point));
  }

  void printHeader() const {
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

  void restore() {
    if (options_.checkpoint.empty()) return;
    const auto checkpoint = readTrainingCheckpoint(options_.checkpoint, plan_.settings);
    if (!checkpoint) return;
    epoch_ = checkpoint->progress.at("epoch").get<int>();
    judge_.restore(checkpoint->progress);
    for (const auto& point : checkpoint->progress.at("curve")) points_.push_back(curvePointFrom(point));
    learner_->restore(checkpoint->learner);
    std::cout << "going on from " << options_.checkpoint << " after epoch " << epoch_ << std::endl;
  }

  void writeCheckpoint() const {
    if (options_.checkpoint.empty() || !isFirstRank()) return;
    TrainingCheckpoint checkpoint;
    checkpoint.settings = plan_.settings;
    checkpoint.progress = judge_.state();
    checkpoint.progress.update({{"epoch", epoch_}, {"curve", nlohmann::json::array()}});
    for (const GridCurvePoint& point : points_) checkpoint.progress["curve"].push_back(toJson(point));
    checkpoint.learner = learner_->checkpoint();
    writeTrainingCheckpoint(options_.checkpoint, checkpoint);
  }

  void drawCurve() const {
    if (!options_.curve.empty() && !points_.empty() && isFirstRank()) {
      writeGridCurve(options_.curve, judge_.names(), points_);
    }
  }

  int stop(const Interruption& interruption) {
    std::cout << "interrupted in epoch " << epoch_ + 1 << std::endl;
    // What was learned since the last epoch ended is judged where nothing else is kept; else that epoch starts anew.
    if (options_.checkpoint.empty() || judge_.best() < 0.0) {
      judge_.keepIfBest(learner_->layers(), judge_.judge(learner_->layers()));
    }
    drawCurve();
    std::cout << "wrote " << options_.output << ": mean arrival " << judge_.best() << "; ";
    if (options_.checkpoint.empty()) {
      std::cout << "without --checkpoint the training cannot be gone on with";
    } else if (epoch_ == 0) {
      std::cout << "there is no checkpoint before the end of the first epoch";
    } else {
      std::cout << "the same command goes on after epoch " << epoch_;
    }
    std::cout << std::endl;
    return interruption.exitStatus();
  }

  const ReinforcementPlan& plan_;
  const GridTrainingOptions& options_;
  std::vector<GridCourse::Set> training_;
  GridJudge judge_;
  ReinforcementLearner* learner_;
  Progress bar_;
  int epoch_ = 0;  ///< epochs done
  std::vector<GridCurvePoint> points_;
};

}  // namespace

void addReinforcementOptions(ReinforcementPlan* plan, CommandLine* line) {
  GridCourseParameters& course = plan->course;
  line->add("updates", &plan->updates, kAnySteps, "of the weights, over all epochs");
  line->add("goals", &course.goals, {1, 1e5}, "kept at a time; each takes 4 bytes a cell of its map");
  line->add("short-share", &course.short_share, kAnyShare,
            "of the training episodes whose length is drawn in proportion to 1 / length, not uniformly");
}

void finishReinforcementOptions(ReinforcementPlan* plan) {
  const GridTrainingOptions& options = plan->options;
  if (plan->updates < options.epochs) {
    throw std::invalid_argument("--updates is " + std::to_string(plan->updates) +
                                ", expected at least one for each of " + std::to_string(options.epochs) + " epochs");
  }
  plan->course.min_length = options.min_length;
  plan->course.max_length = options.max_length;
  validate(plan->course);
  plan->settings = settingsOf(options);
  plan->settings.update(
      {{"updates", plan->updates}, {"goals", plan->course.goals}, {"short-share", plan->course.short_share}});
}

int trainByReinforcement(const ReinforcementPlan& plan, ReinforcementLearner* learner) {
  return ReinforcementTraining(plan, loadGridTrainingMaps(plan.options), learner).run();
}

}  // namespace lstm_planner
