#include <gtest/gtest.h>

#include "lstm_planner/common/progress_watch.hpp"

namespace lstm_planner::test_progress_watch {
namespace {

TEST(DrivenProgressWatch, CountsWhatIsSpentWithoutProgress) {
  DrivenProgressWatch watch(0.5);
  EXPECT_TRUE(watch.note(10.0, 3.0)) << "the first is the best so far";
  EXPECT_FALSE(watch.note(9.5, 1.0)) << "not by enough";
  EXPECT_FALSE(watch.note(12.0, 2.0));
  EXPECT_EQ(watch.steps(), 2);
  EXPECT_EQ(watch.driven(), 3.0);
  EXPECT_EQ(watch.best(), 10.0);
  EXPECT_TRUE(watch.note(9.4, 1.0));
  EXPECT_EQ(watch.steps(), 0);
  EXPECT_EQ(watch.driven(), 0.0);
  EXPECT_EQ(watch.best(), 9.4);
}

TEST(ProgressWatch, AGoalThatMovesIsNoProgress) {
  ProgressWatch watch(0.5);
  watch.note(10.0);
  watch.note(10.0);
  watch.moveBest(7.0);
  EXPECT_EQ(watch.steps(), 1);
  EXPECT_EQ(watch.target(), 6.5);
  EXPECT_FALSE(watch.note(6.8));
  EXPECT_TRUE(watch.note(6.4));
}

TEST(DrivenProgressWatch, ForgetsWhenCleared) {
  DrivenProgressWatch watch(0.5);
  watch.note(1.0, 1.0);
  watch.note(2.0, 1.0);
  watch.clear();
  EXPECT_FALSE(watch.hasBest());
  EXPECT_EQ(watch.steps(), 0);
  EXPECT_EQ(watch.driven(), 0.0);
  EXPECT_TRUE(watch.note(5.0, 1.0));
}

}  // namespace
}  // namespace lstm_planner::test_progress_watch
