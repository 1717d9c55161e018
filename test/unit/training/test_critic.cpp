#include <gtest/gtest.h>

#include "lstm_planner/training/critic.hpp"
#include "lstm_planner/training/tile_exchange.hpp"

namespace lstm_planner::test_critic {
namespace {

TEST(CriticSums, AllOfTheVarianceIsExplainedWhereThereAreNoErrorsAndNoneWhereTheMeanIsAsGood) {
  CriticSums knows(1);
  CriticSums guesses(1);
  for (const double result : {1.0, 2.0, 6.0}) {
    knows.count(0, result, 0.0);
    guesses.count(0, 3.0, result - 3.0);
  }
  EXPECT_DOUBLE_EQ(knows.explained(), 1.0);
  EXPECT_NEAR(guesses.explained(), 0.0, 1e-12);
}

TEST(CriticSums, VariancesMoveTowardsThoseOfTheSetsThatWereSeen) {
  CriticSums sums(2);
  sums.count(1, 0.0, 1.0);
  sums.count(1, 0.0, -3.0);
  std::vector<double> variances = {4.0, 1.0};
  sums.moveVariances(0.5, &variances);
  EXPECT_DOUBLE_EQ(variances[0], 4.0);  // nothing was seen of it
  EXPECT_DOUBLE_EQ(variances[1], 1.0 + 0.5 * ((1.0 + 9.0) / 2.0 - 1.0));
}

TEST(CriticSums, SumsOfPartsAreThoseOfTheWhole) {
  CriticSums whole(2), first(2), second(2);
  for (CriticSums* sums : {&whole, &first}) sums->count(0, 1.0, 2.0);
  for (CriticSums* sums : {&whole, &second}) sums->count(1, -1.0, 4.0);
  addTo(&first, second);
  EXPECT_EQ(first.steps, whole.steps);
  EXPECT_DOUBLE_EQ(first.explained(), whole.explained());
  EXPECT_EQ(first.set_steps, whole.set_steps);
  EXPECT_EQ(first.set_squared_advantages, whole.set_squared_advantages);
}

}  // namespace
}  // namespace lstm_planner::test_critic
