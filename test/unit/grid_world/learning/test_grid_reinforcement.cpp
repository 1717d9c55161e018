#include <gtest/gtest.h>

#include <stdexcept>

#include "lstm_planner/grid_world/learning/grid_reinforcement.hpp"
#include "support/refusal.hpp"
#include "unit/grid_world/learning/grid_learning_fixtures.hpp"

namespace lstm_planner::test_grid_reinforcement {
namespace {

/// Counts.
class Learner : public GridLearner {
 public:
  void startEpoch(int epoch, const GridCourse& course) override {
    Random random(1);
    epochs_.push_back(epoch);
    starts_.push_back(course.draw(random).start);
  }
  void update() override { ++updates_; }
  ReinforcementReport report() override { return {}; }
  int updates() const override { return updates_; }
  const LayerStack& layers() const override { return layers_; }
  std::vector<std::uint8_t> checkpoint() const override { return {static_cast<std::uint8_t>(updates_)}; }
  void restore(const std::vector<std::uint8_t>& checkpoint) override { updates_ = checkpoint.at(0); }

  std::vector<int> epochs_;
  std::vector<CellIndex> starts_;  ///< what each epoch's course draws first

 private:
  LayerStack layers_;
  int updates_ = 0;
};

GridReinforcementParameters smallTraining() {
  GridReinforcementParameters parameters;
  parameters.course = smallCourse();
  parameters.updates = 11;
  parameters.epochs = 3;
  parameters.threads = 1;
  return parameters;
}

const std::vector<GridCourse::Set> kCave = {{{smallCave(1)}, 1.0}};

TEST(GridReinforcement, IsJudgedAndCanGoOnBetweenEpochs) {
  Learner learner;
  GridReinforcement training(smallTraining(), kCave, &learner);
  EXPECT_FALSE(training.judgementDue()) << "nothing was learned yet";
  std::vector<int> judged_after;
  while (!training.done()) {
    training.step();
    EXPECT_EQ(training.judgementDue(), training.resumable());
    if (training.judgementDue()) judged_after.push_back(learner.updates());
  }
  EXPECT_EQ(judged_after, (std::vector<int>{3, 7, 11})) << "as equal as can be";
  EXPECT_EQ(learner.epochs_, (std::vector<int>{0, 1, 2}));
}

TEST(GridReinforcement, GoesOnInTheEpochAndOnTheCourseThatWouldHaveComeNext) {
  Learner whole;
  GridReinforcement without_break(smallTraining(), kCave, &whole);
  while (!without_break.done()) without_break.step();

  Learner learner;
  GridReinforcement training(smallTraining(), kCave, &learner);
  training.restore({7});
  EXPECT_EQ(training.epoch(), 2);
  EXPECT_FALSE(training.judgementDue()) << "it was judged then";
  while (!training.done()) training.step();
  EXPECT_EQ(learner.epochs_, std::vector<int>{2});
  EXPECT_EQ(learner.updates(), 11);
  ASSERT_EQ(learner.starts_.size(), 1u);
  EXPECT_EQ(learner.starts_[0].column, whole.starts_[2].column);
  EXPECT_EQ(learner.starts_[0].row, whole.starts_[2].row);
}

TEST(GridReinforcement, RefusesFewerUpdatesThanEpochs) {
  GridReinforcementParameters parameters = smallTraining();
  parameters.updates = 2;
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { validate(parameters); }),
            "parameter updates is 2, expected at least one for each of the epochs");
}

}  // namespace
}  // namespace lstm_planner::test_grid_reinforcement
