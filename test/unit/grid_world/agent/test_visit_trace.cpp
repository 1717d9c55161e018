#include <gtest/gtest.h>

#include "lstm_planner/grid_world/agent/visit_trace.hpp"

namespace lstm_planner::test_visit_trace {
namespace {

TEST(VisitTrace, KnowsNothingAtFirstAndAfterClearing) {
  VisitTrace trace;
  EXPECT_EQ(trace.at(VisitTrace::kCell, {0, 0}).count, 0);
  trace.visit({0, 0});
  trace.clear();
  EXPECT_EQ(trace.at(VisitTrace::kCell, {0, 0}).count, 0);
}

TEST(VisitTrace, CountsComingsAndTheStepsSince) {
  VisitTrace trace;
  trace.visit({100, 7});
  trace.visit({101, 7});
  trace.visit({100, 7});
  trace.visit({101, 8});
  trace.visit({102, 8});
  EXPECT_EQ(trace.at(VisitTrace::kCell, {100, 7}).count, 2);
  EXPECT_EQ(trace.at(VisitTrace::kCell, {100, 7}).age, 2);
  EXPECT_EQ(trace.at(VisitTrace::kCell, {102, 8}).age, 0);
}

TEST(VisitTrace, ABlockIsEnteredOnceHoweverLongOneStaysInIt) {
  VisitTrace trace;
  for (const int column : {0, 1, 2, 3, 4, 3}) trace.visit({column, 0});
  EXPECT_EQ(trace.at(VisitTrace::kSmallBlock, {1, 1}).count, 2);
  EXPECT_EQ(trace.at(VisitTrace::kSmallBlock, {4, 0}).count, 1);
  EXPECT_EQ(trace.at(VisitTrace::kLargeBlock, {7, 7}).count, 1);
}

TEST(VisitTrace, APlaceAWindowAwayTakesTheEntryAndIsNotMistakenForIt) {
  VisitTrace trace;
  trace.visit({5, 5});
  EXPECT_EQ(trace.at(VisitTrace::kCell, {5 + 32, 5}).count, 0);
  trace.visit({5 + 32, 5});
  EXPECT_EQ(trace.at(VisitTrace::kCell, {5, 5}).count, 0);
  EXPECT_EQ(trace.at(VisitTrace::kCell, {5 + 32, 5}).count, 1);
}

TEST(VisitTrace, PlacesWithNegativeCoordinatesAreLikeOthers) {
  VisitTrace trace;
  trace.visit({-1, -1});
  EXPECT_EQ(trace.at(VisitTrace::kSmallBlock, {-4, -4}).count, 1);
  EXPECT_EQ(trace.at(VisitTrace::kSmallBlock, {0, 0}).count, 0);
}

TEST(VisitTrace, ForgetsRatherThanTakesOldForNewWhenTheStampsRunOut) {
  VisitTrace trace;
  trace.visit({0, 0});
  for (int step = 0; step < 65535; ++step) trace.visit({9, 9 + step % 2});
  EXPECT_EQ(trace.at(VisitTrace::kCell, {0, 0}).count, 0);
  EXPECT_EQ(trace.at(VisitTrace::kCell, {9, 9}).age, 0);
}

}  // namespace
}  // namespace lstm_planner::test_visit_trace
