#include <gtest/gtest.h>

#include "lstm_planner/ros/common/publisher_watch.hpp"

namespace lstm_planner::test_publisher_watch {
namespace {

TEST(PublisherWatch, NoticesTwoInTurnOnce) {
  PublisherWatch watch;
  EXPECT_FALSE(watch.note("/base", 1.0));
  EXPECT_FALSE(watch.note("/base", 1.1));
  EXPECT_FALSE(watch.note("/filter", 1.2));
  EXPECT_TRUE(watch.note("/base", 1.3));
  EXPECT_EQ(watch.newest(), "/base");
  EXPECT_EQ(watch.other(), "/filter");
  EXPECT_FALSE(watch.note("/filter", 1.4));
  EXPECT_FALSE(watch.note("/base", 1.5));
}

TEST(PublisherWatch, TakesOneInPlaceOfAnotherForNoFault) {
  PublisherWatch watch;
  EXPECT_FALSE(watch.note("/old", 1.0));
  EXPECT_FALSE(watch.note("/new", 1.1));
  EXPECT_FALSE(watch.note("/new", 60.0));
  EXPECT_FALSE(watch.note("/old", 61.0)) << "and back, much later";
}

}  // namespace
}  // namespace lstm_planner::test_publisher_watch
