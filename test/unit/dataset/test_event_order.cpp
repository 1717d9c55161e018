#include <gtest/gtest.h>

#include <vector>

#include "lstm_planner/dataset/drive_events.hpp"

namespace lstm_planner::test_event_order {
namespace {

DriveEvent odometryAt(double stamp) { return OdometryHeard{stamp, {}, {}}; }
DriveEvent scanAt(double stamp) { return ScanHeard{stamp, {}, {}, "laser"}; }
DriveEvent goalAt(double stamp) { return GoalHeard{stamp, {}, ""}; }

std::vector<std::pair<double, std::size_t>> takeAll(EventOrder* order, bool all) {
  std::vector<std::pair<double, std::size_t>> taken;
  while (const auto event = order->take(all)) taken.emplace_back(stampOf(*event), event->index());
  return taken;
}

TEST(EventOrder, GivesTheSameOrderHoweverTopicsInterleave) {
  std::vector<DriveEvent> events = {odometryAt(0.0), goalAt(0.05), scanAt(0.1), odometryAt(0.1), scanAt(0.2)};
  std::vector<int> arrival = {0, 1, 2, 3, 4};
  do {
    EventOrder order(1.0, 10.0);
    for (const int index : arrival)
      EXPECT_EQ(order.add(events[static_cast<std::size_t>(index)]), EventOrder::Verdict::kTaken);
    const std::size_t odometry = odometryAt(0.0).index();
    const std::size_t scan = scanAt(0.0).index();
    const std::vector<std::pair<double, std::size_t>> expected = {
        {0.0, odometry}, {0.05, goalAt(0.0).index()}, {0.1, odometry}, {0.1, scan}, {0.2, scan}};
    EXPECT_EQ(takeAll(&order, true), expected);
  } while (std::next_permutation(arrival.begin(), arrival.end()));
}

TEST(EventOrder, HoldsAnEventBackUntilAnotherIsNewerByTheDelay) {
  EventOrder order(0.3, 10.0);
  order.add(odometryAt(1.0));
  EXPECT_FALSE(order.take());
  order.add(odometryAt(1.25));
  EXPECT_FALSE(order.take());
  order.add(odometryAt(1.5));
  EXPECT_EQ(takeAll(&order, false).size(), 1u);
}

TEST(EventOrder, RefusesWhatIsOlderThanWhatWasTaken) {
  EventOrder order(0.3, 10.0);
  order.add(odometryAt(1.0));
  order.add(odometryAt(2.0));
  ASSERT_EQ(takeAll(&order, false).size(), 1u);
  EXPECT_EQ(order.add(scanAt(0.9)), EventOrder::Verdict::kLate);
  EXPECT_EQ(order.add(scanAt(1.1)), EventOrder::Verdict::kTaken);
}

TEST(EventOrder, NoticesThatTheClockWasSet) {
  EventOrder order(0.3, 2.0);
  order.add(odometryAt(100.0));
  EXPECT_EQ(order.add(odometryAt(97.0)), EventOrder::Verdict::kClockSet);
  EXPECT_EQ(order.add(odometryAt(103.0)), EventOrder::Verdict::kClockSet);
  order.clear();
  EXPECT_EQ(order.add(odometryAt(97.0)), EventOrder::Verdict::kTaken);
}

TEST(EventOrder, HoldsABoundedNumberOfEventsBackWhereStampsStandStill) {
  EventOrder order(0.3, 2.0);
  std::size_t held = 0;
  for (int i = 0; i < 200000; ++i) {
    ASSERT_EQ(order.add(i % 2 == 0 ? scanAt(5.0) : odometryAt(5.0)), EventOrder::Verdict::kTaken) << "none is late";
    held += 1 - takeAll(&order, false).size();
    ASSERT_LE(held, EventOrder::kMostWaiting);
  }
  EXPECT_EQ(takeAll(&order, true).size(), held);
}

}  // namespace
}  // namespace lstm_planner::test_event_order
