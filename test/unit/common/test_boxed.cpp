#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "lstm_planner/common/boxed.hpp"

namespace lstm_planner::test_boxed {
namespace {

TEST(Boxed, TakesNoMoreRoomThanAPointer) { EXPECT_EQ(sizeof(Boxed<std::vector<int>>), sizeof(void*)); }

TEST(Boxed, CopiesHaveValuesOfTheirOwn) {
  Boxed<std::vector<int>> first(std::vector<int>{1, 2});
  const Boxed<std::vector<int>> second = first;
  first->push_back(3);
  EXPECT_EQ(*second, (std::vector<int>{1, 2}));
  first = second;
  EXPECT_EQ(*first, *second);
  EXPECT_NE(&*first, &*second);
}

TEST(Boxed, NoneIsCopiedAsNone) {
  const Boxed<int> none;
  Boxed<int> other(1);
  EXPECT_FALSE(none);
  EXPECT_TRUE(other);
  other = none;
  EXPECT_FALSE(other);
}

}  // namespace
}  // namespace lstm_planner::test_boxed
