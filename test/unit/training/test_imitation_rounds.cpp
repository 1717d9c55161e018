#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "lstm_planner/training/imitation_rounds.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "support/refusal.hpp"
#include "unit/training/toy_tasks.hpp"

namespace lstm_planner::test_imitation_rounds {
namespace {

/// What a course was asked for: round, and the learner's weights.
struct Asked {
  std::vector<int> rounds;
  std::vector<Eigen::VectorXf> learners;  ///< empty vectors where there was none
};

/// Parities, as many more sequences in each round.
class ParityCourse : public ImitationCourse {
 public:
  ParityCourse(Asked* training, Asked* validation) : asked_training_(training), asked_validation_(validation) {}
  std::vector<Sequence> collectTraining(int round, const LayerStack* learner) override {
    note(round, learner, asked_training_);
    return paritySequences(20, 6, 100 + static_cast<std::uint64_t>(round));
  }
  std::vector<Sequence> collectValidation(int round, const LayerStack* learner) override {
    note(round, learner, asked_validation_);
    return paritySequences(5, 6, 200 + static_cast<std::uint64_t>(round));
  }

 private:
  static void note(int round, const LayerStack* learner, Asked* asked) {
    if (asked == nullptr) return;
    asked->rounds.push_back(round);
    asked->learners.push_back(learner != nullptr ? parameterVector(*learner) : Eigen::VectorXf());
  }
  Asked* asked_training_;
  Asked* asked_validation_;
};

constexpr int kEpochs = 3;

std::unique_ptr<ImitationRounds> parityRounds(Asked* training = nullptr, Asked* validation = nullptr) {
  ImitationRoundsParameters parameters;
  parameters.rounds = 2;
  parameters.batch_steps = 60;
  parameters.trainer.epochs = kEpochs;
  parameters.trainer.threads = 1;
  parameters.trainer.averaging = 0.5;
  const LayerStack layers = initialised(makeLstmStack(1, {4}, 2), 1);
  return std::make_unique<ImitationRounds>(parameters, layers, std::make_unique<ParityCourse>(training, validation));
}

TEST(ImitationRounds, LearnFromAllRoundsSoFarAndAskTheLearnerFromTheSecondOn) {
  Asked training;
  Asked validation;
  const auto rounds = parityRounds(&training, &validation);
  std::vector<std::size_t> steps;
  Eigen::VectorXf after_first;
  while (!rounds->done()) {
    rounds->step();
    steps.push_back(rounds->collectedSteps());
    EXPECT_EQ(rounds->round(), steps.size() <= kEpochs ? 1 : 2);
    EXPECT_EQ(rounds->judgementDue(), steps.size() % kEpochs == 0);
    if (steps.size() == kEpochs) after_first = parameterVector(rounds->layers());
  }
  EXPECT_EQ(steps, (std::vector<std::size_t>{120, 120, 120, 240, 240, 240}));
  for (const Asked& asked : {training, validation}) {
    EXPECT_EQ(asked.rounds, (std::vector<int>{0, 1}));
    EXPECT_EQ(asked.learners[0].size(), 0);
    EXPECT_EQ(asked.learners[1], after_first);
  }
}

TEST(ImitationRounds, TheNetworkIsThatOfTheRoundsBestEpoch) {
  const auto rounds = parityRounds();
  for (int epoch = 0; epoch < kEpochs; ++epoch) rounds->step();
  EXPECT_EQ(parameterVector(rounds->layers()), parameterVector(rounds->roundResult().layers));
}

TEST(ImitationRounds, GoOnAfterABreakAsIfThereHadBeenNone) {
  const auto whole = parityRounds();
  while (!whole->done()) whole->step();
  const std::vector<EpochReport> curve = whole->curve();
  ASSERT_EQ(curve.size(), 2u * kEpochs);
  for (const int epochs_before : {1, kEpochs, kEpochs + 1, 2 * kEpochs}) {
    const auto first = parityRounds();
    for (int epoch = 0; epoch < epochs_before; ++epoch) first->step();
    Asked training;
    const auto rest = parityRounds(&training);
    rest->restore(first->checkpoint());
    EXPECT_EQ(training.rounds.size(), epochs_before <= kEpochs ? 1u : 2u) << "it is not kept";
    EXPECT_EQ(parameterVector(rest->layers()), parameterVector(first->layers()));
    while (!rest->done()) rest->step();
    EXPECT_EQ(parameterVector(rest->layers()), parameterVector(whole->layers())) << epochs_before << " epochs before";
    ASSERT_EQ(rest->curve().size(), curve.size());
    for (std::size_t epoch = 0; epoch < curve.size(); ++epoch) {
      const EpochReport resumed = rest->curve()[epoch];
      EXPECT_EQ(resumed.epoch, static_cast<int>(epoch) + 1);
      EXPECT_EQ(resumed.training.loss, curve[epoch].training.loss);
      EXPECT_EQ(resumed.validation.confusion, curve[epoch].validation.confusion);
      EXPECT_EQ(resumed.averaged.confusion, curve[epoch].averaged.confusion);
      EXPECT_EQ(resumed.mean_batch_accuracy, curve[epoch].mean_batch_accuracy);
    }
  }
}

TEST(ImitationRounds, RefuseAStateOfMoreRounds) {
  ImitationState state;
  state.learners.resize(2);
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { parityRounds()->restore(toBytes(state)); }),
            "the imitation's state is of round 3, expected 2 at most");
}

TEST(ImitationState, IsNotReadFromOtherBytes) {
  EXPECT_THROW(imitationStateFrom({}), std::invalid_argument);
  std::vector<std::uint8_t> bytes = toBytes({});
  EXPECT_TRUE(imitationStateFrom(bytes).training.curve.empty());
  bytes.pop_back();
  EXPECT_THROW(imitationStateFrom(bytes), std::invalid_argument);
}

TEST(ImitationState, WithoutAFirstAndBestEpochIsRefused) {
  ImitationState state;
  state.training.curve.resize(1);
  state.training.curve[0].epoch = 1;
  EXPECT_THROW(imitationStateFrom(toBytes(state)), std::invalid_argument) << "none is best";
  state.training.curve[0].best = true;
  EXPECT_EQ(imitationStateFrom(toBytes(state)).training.curve.size(), 1u);
  state.training.curve[0].epoch = 7;
  EXPECT_THROW(imitationStateFrom(toBytes(state)), std::invalid_argument) << "the best of seven";
}

TEST(ImitationState, OfManyLevelsIsRefused) {
  const std::vector<std::uint8_t> lists_in_lists(1000000, 0x81);
  try {
    imitationStateFrom(lists_in_lists);
    FAIL() << "it was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("more than 16 levels"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lstm_planner::test_imitation_rounds
