#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "lstm_planner/training/q_learner.hpp"
#include "lstm_planner/training/training_loop.hpp"
#include "support/folder_test.hpp"
#include "support/refusal.hpp"
#include "training/training_checkpoint.hpp"

namespace lstm_planner::test_training_loop {
namespace {

constexpr int kSteps = 12;
constexpr int kEpoch = 4;  ///< steps from judgement to judgement

LayerStack firstLayers() { return initialised(makeDenseStack(2, {3}, 1), 1); }

QLearningParameters parameters() {
  QLearningParameters parameters;
  parameters.learning_rate = 0.1;
  parameters.max_gradient_norm = 1.0;
  return parameters;
}

/// An optimiser with momentum of its own learns to have all weights 1.
class Toy : public SteppedTraining {
 public:
  explicit Toy(bool resumable_anywhere = true)
      : layers_(firstLayers()), learner_(parameters(), kSteps, layers_), resumable_anywhere_(resumable_anywhere) {}

  bool done() const override { return steps() == kSteps; }
  void step() override {
    learner_.startUpdate();
    learner_.update(learner_.weights() - Eigen::VectorXf::Ones(learner_.weights().size()));
    learner_.finishUpdate(1.0);
    setParameterVector(learner_.weights(), layers_);
  }
  const LayerStack& layers() const override { return layers_; }
  bool judgementDue() const override { return steps() > 0 && steps() % kEpoch == 0; }
  bool resumable() const override { return resumable_anywhere_ || steps() % kEpoch == 0; }
  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override {
    learner_.restore(checkpoint);
    setParameterVector(learner_.weights(), layers_);
  }
  int steps() const { return learner_.updates(); }

 private:
  LayerStack layers_;
  QLearner learner_;
  bool resumable_anywhere_;
};

/// Notes what happens; scores as told, one judgement after the other, else 1.
class Host : public TrainingHost {
 public:
  Host(const Toy& training, std::string output) : training_(training), output_(std::move(output)) {}

  void started(bool resumed) override { resumed_ = resumed; }
  void stepDone() override { ++steps_; }
  bool stopWanted() override { return training_.steps() == stop_after_; }
  double judge(const LayerStack& layers) override {
    EXPECT_EQ(parameterVector(layers), parameterVector(training_.layers()));
    judged_at_.push_back(training_.steps());
    return judged_at_.size() <= scores_.size() ? scores_[judged_at_.size() - 1] : 1.0;
  }
  void keep(const LayerStack&) override {
    kept_at_.push_back(training_.steps());
    std::ofstream(output_) << training_.steps();
  }
  void judged(const Judgement& judgement) override { judgements_.push_back(judgement); }
  nlohmann::json notes() const override { return {{"note", training_.steps()}}; }
  void restoreNotes(const nlohmann::json& progress) override { note_ = progress.at("note").get<int>(); }

  int stop_after_ = -1;
  std::vector<double> scores_;
  bool resumed_ = false;
  int steps_ = 0;
  int note_ = -1;
  std::vector<int> judged_at_, kept_at_;
  std::vector<Judgement> judgements_;

 private:
  const Toy& training_;
  std::string output_;
};

class TrainingLoop : public test::FolderTest {
 protected:
  TrainingLoop() {
    options_.checkpoint = in("checkpoint");
    options_.settings = {{"seed", 1}};
    options_.output = in("model");
    options_.checkpoint_interval = std::numeric_limits<double>::infinity();
  }

  /// Steps that the checkpoint is after.
  int stepsInCheckpoint() const {
    Toy training;
    training.restore(readTrainingCheckpoint(options_.checkpoint, options_.settings)->learner);
    return training.steps();
  }

  TrainingLoopOptions options_;
};

TEST_F(TrainingLoop, GoesOnFromACheckpointToTheSameBitsAsWithoutAStop) {
  Toy whole;
  Host host(whole, in("whole"));
  runTraining({}, &whole, &host);
  ASSERT_TRUE(whole.done());

  for (const int stop_after : {1, kEpoch, kEpoch + 3, kSteps - 1}) {
    std::filesystem::remove(options_.checkpoint);
    Toy first;
    Host stopping(first, in("model"));
    stopping.stop_after_ = stop_after;
    EXPECT_TRUE(runTraining(options_, &first, &stopping).stopped);
    Toy second;
    Host resuming(second, in("model"));
    EXPECT_FALSE(runTraining(options_, &second, &resuming).stopped);
    EXPECT_TRUE(resuming.resumed_);
    EXPECT_EQ(resuming.note_, stop_after);
    EXPECT_EQ(resuming.steps_, kSteps - stop_after);
    EXPECT_EQ(parameterVector(second.layers()), parameterVector(whole.layers())) << "after " << stop_after;
    EXPECT_EQ(second.checkpoint(), whole.checkpoint());
  }
}

TEST_F(TrainingLoop, AStopEndsAfterThePresentStep) {
  Toy training;
  Host host(training, in("model"));
  host.stop_after_ = 5;
  EXPECT_TRUE(runTraining(options_, &training, &host).stopped);
  EXPECT_EQ(training.steps(), 5);
  EXPECT_EQ(stepsInCheckpoint(), 5);
  EXPECT_EQ(host.judged_at_, std::vector<int>{kEpoch}) << "the best of before is kept already";
}

TEST_F(TrainingLoop, AStopAfterTheLastStepIsNone) {
  Toy training;
  Host host(training, in("model"));
  host.stop_after_ = kSteps;
  EXPECT_FALSE(runTraining(options_, &training, &host).stopped);
}

TEST_F(TrainingLoop, WhereATrainingCannotGoOnFromTheCheckpointIsOlder) {
  Toy training(false);
  Host host(training, in("model"));
  host.stop_after_ = kEpoch + 2;
  EXPECT_TRUE(runTraining(options_, &training, &host).stopped);
  EXPECT_EQ(stepsInCheckpoint(), kEpoch);
}

TEST_F(TrainingLoop, OfTwoThatAreAsGoodTheFirstIsKeptUnlessTheLaterIsWanted) {
  for (const bool later : {false, true}) {
    options_.checkpoint.clear();
    options_.keep_later = later;
    Toy training;
    Host host(training, in("model"));
    host.scores_ = {0.5, 0.7, 0.7};
    EXPECT_EQ(runTraining(options_, &training, &host).best, 0.7);
    EXPECT_EQ(host.kept_at_.back(), later ? 3 * kEpoch : 2 * kEpoch);
  }
}

TEST_F(TrainingLoop, KeepsTheBest) {
  Toy training;
  Host host(training, in("model"));
  host.scores_ = {0.5, 0.7, 0.6};
  const TrainingOutcome outcome = runTraining(options_, &training, &host);
  EXPECT_EQ(host.judged_at_, (std::vector<int>{kEpoch, 2 * kEpoch, 3 * kEpoch}));
  EXPECT_EQ(host.kept_at_, (std::vector<int>{kEpoch, 2 * kEpoch}));
  EXPECT_EQ(outcome.best, 0.7);
  ASSERT_EQ(host.judgements_.size(), 3u);
  EXPECT_TRUE(host.judgements_[1].best);
  EXPECT_FALSE(host.judgements_[2].best);
  EXPECT_EQ(host.judgements_[2].score, 0.6);
}

TEST_F(TrainingLoop, KeepsTheLastWhereThatIsWanted) {
  options_.keep_last = true;
  Toy training;
  Host host(training, in("model"));
  host.scores_ = {0.5, 0.7, 0.6};
  EXPECT_EQ(runTraining(options_, &training, &host).best, 0.6);
  EXPECT_EQ(host.kept_at_.back(), kSteps);
  EXPECT_FALSE(host.judgements_.back().best);
}

TEST_F(TrainingLoop, WhatAStopLeavesIsJudgedWhereNothingElseIsKept) {
  const auto judgedAt = [&](int stop_after) {
    Toy training;
    Host host(training, in("model"));
    host.stop_after_ = stop_after;
    runTraining(options_, &training, &host);
    return std::make_pair(host.judged_at_, host.judgements_.back().due);
  };
  EXPECT_EQ(judgedAt(2), std::make_pair(std::vector<int>{2}, false)) << "nothing was judged before";
  options_.checkpoint = "";
  EXPECT_EQ(judgedAt(kEpoch + 1), std::make_pair(std::vector<int>({kEpoch, kEpoch + 1}), false)) << "it is lost else";
}

TEST_F(TrainingLoop, WhatOnlyAStopHadJudgedDoesNotCountWhenItGoesOn) {
  Toy first;
  Host stopping(first, options_.output);
  stopping.stop_after_ = 2;
  stopping.scores_ = {0.9};
  EXPECT_EQ(runTraining(options_, &first, &stopping).best, 0.9);
  Toy second;
  Host resuming(second, options_.output);
  resuming.scores_ = {0.5, 0.7, 0.6};
  EXPECT_EQ(runTraining(options_, &second, &resuming).best, 0.7) << "as without the stop";
  EXPECT_EQ(resuming.kept_at_, (std::vector<int>{kEpoch, 2 * kEpoch}));
}

TEST_F(TrainingLoop, TheBestOfBeforeAStopCountsUnlessItsFileIsGoneOrAnother) {
  const auto bestAfterStopAndRest = [&](const auto& change) {
    std::filesystem::remove(options_.checkpoint);
    Toy first;
    Host stopping(first, options_.output);
    stopping.scores_ = {0.9};
    stopping.stop_after_ = kEpoch + 1;
    runTraining(options_, &first, &stopping);
    TrainingLoopOptions rest = options_;
    change(&rest);
    Toy second;
    Host resuming(second, rest.output);
    resuming.scores_ = {0.3, 0.2};
    return runTraining(rest, &second, &resuming).best;
  };
  EXPECT_EQ(bestAfterStopAndRest([](TrainingLoopOptions*) {}), 0.9);
  EXPECT_EQ(bestAfterStopAndRest([](TrainingLoopOptions* rest) { rest->output += "2"; }), 0.3);
  EXPECT_EQ(bestAfterStopAndRest([](TrainingLoopOptions* rest) { std::filesystem::remove(rest->output); }), 0.3);
}

TEST_F(TrainingLoop, NamesOfFilesNeedBeNoUtf8) {
  options_.output = in("mod\xe8le");
  options_.settings["maps"] =
      "donn\xe9"
      "es";
  Toy first;
  Host stopping(first, options_.output);
  stopping.scores_ = {0.9};
  stopping.stop_after_ = kEpoch + 1;
  runTraining(options_, &first, &stopping);
  Toy second;
  Host resuming(second, options_.output);
  resuming.scores_ = {0.3, 0.2};
  EXPECT_EQ(runTraining(options_, &second, &resuming).best, 0.9);
  EXPECT_TRUE(resuming.resumed_);
}

TEST_F(TrainingLoop, AFinishedTrainingWritesItsNetworkToAnotherFile) {
  Toy first;
  Host host(first, in("model"));
  runTraining(options_, &first, &host);
  options_.output = in("model2");
  Toy second;
  Host again(second, in("model2"));
  EXPECT_EQ(runTraining(options_, &second, &again).best, 1.0);
  EXPECT_EQ(again.kept_at_, std::vector<int>{kSteps});
}

TEST_F(TrainingLoop, WritesCheckpointsBetweenJudgementsWhenTimeHasPassed) {
  options_.checkpoint_interval = 0.0;
  Toy training;
  struct Watch : Host {
    using Host::Host;
    bool stopWanted() override {
      if (++asked_ == 3) throw std::runtime_error("killed");  // within the third step
      return false;
    }
    int asked_ = 0;
  } host(training, in("model"));
  EXPECT_THROW(runTraining(options_, &training, &host), std::runtime_error);
  EXPECT_EQ(stepsInCheckpoint(), 2);
}

TEST_F(TrainingLoop, GoesOnWithoutSettings) {
  options_.settings = TrainingLoopOptions().settings;
  Toy first;
  Host stopping(first, in("model"));
  stopping.stop_after_ = 5;
  runTraining(options_, &first, &stopping);
  Toy second;
  Host resuming(second, in("model"));
  runTraining(options_, &second, &resuming);
  EXPECT_TRUE(resuming.resumed_);
}

TEST_F(TrainingLoop, RefusesProgressThatIsNone) {
  Toy training;
  std::ofstream(in("model")) << "there";
  for (const nlohmann::json& progress :
       std::vector<nlohmann::json>{{{"best", "much"}, {"note", 1}}, {{"best", 1.0}}, nlohmann::json::array({1})}) {
    writeTrainingCheckpoint(options_.checkpoint, {options_.settings, progress, training.checkpoint()});
    Host host(training, in("model"));
    const std::string refusal =
        test::refusalOf<std::invalid_argument>([&] { runTraining(options_, &training, &host); });
    EXPECT_EQ(refusal.find("the progress in checkpoint '" + options_.checkpoint + "' is not that of a training"), 0u)
        << refusal;
  }
}

}  // namespace
}  // namespace lstm_planner::test_training_loop
