#include <gtest/gtest.h>

#include "lstm_planner/simulation/contact_count.hpp"

namespace lstm_planner::test_contact_count {
namespace {

TEST(ContactCount, TouchingForAWhileIsOneContact) {
  ContactCount count;
  for (const bool touches : {false, true, true, true, false, false, true}) count.note(touches);
  EXPECT_EQ(count.contacts(), 2);
  EXPECT_TRUE(count.isTouching());
  count.add();
  EXPECT_EQ(count.contacts(), 3);
}

}  // namespace
}  // namespace lstm_planner::test_contact_count
