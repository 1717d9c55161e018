#include <gtest/gtest.h>

#include <stdexcept>

#include "lstm_planner/practice/drive_actor_critic.hpp"

namespace lstm_planner::test_drive_reinforcement {
namespace {

/// Counts.
class Learner : public DriveActorCritic {
 public:
  ReinforcementReport iterate() override {
    ReinforcementReport report;
    report.update = ++updates_;
    return report;
  }
  void follow(const Dataset& /*recordings*/, double /*weight*/) override {}
  int updates() const override { return updates_; }
  const LayerStack& layers() const override { return layers_; }
  std::vector<std::uint8_t> checkpoint() const override { return {static_cast<std::uint8_t>(updates_)}; }
  void restore(const std::vector<std::uint8_t>& checkpoint) override { updates_ = checkpoint.at(0); }

 private:
  LayerStack layers_;
  int updates_ = 0;
};

std::vector<int> judgedAfter(int iterations, int judgements) {
  Learner learner;
  DriveReinforcement training(iterations, judgements, &learner);
  std::vector<int> judged_after;
  if (training.judgementDue()) judged_after.push_back(0);
  while (!training.done()) {
    training.step();
    EXPECT_EQ(training.report().update, training.iterations());
    if (training.judgementDue()) judged_after.push_back(training.iterations());
  }
  return judged_after;
}

TEST(DriveReinforcement, IsJudgedFirstAndLastAndInBetween) {
  EXPECT_EQ(judgedAfter(10, 2), (std::vector<int>{0, 5, 10}));
  EXPECT_EQ(judgedAfter(11, 2), (std::vector<int>{0, 5, 10, 11}));
  EXPECT_EQ(judgedAfter(2, 10), (std::vector<int>{0, 1, 2})) << "no more often than there are iterations";
}

TEST(DriveReinforcement, RefusesToDoNothing) {
  Learner learner;
  EXPECT_THROW(DriveReinforcement(0, 1, &learner), std::invalid_argument);
  EXPECT_THROW(DriveReinforcement(1, 0, &learner), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_drive_reinforcement
