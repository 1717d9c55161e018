#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/common/quantile.hpp"

namespace lstm_planner::test_quantile {
namespace {

TEST(Quantile, IsAValueByNearestRank) {
  const std::vector<double> values{5.0, 1.0, 3.0, 2.0, 4.0};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.2), 1.0);
  EXPECT_EQ(quantile(values, 0.5), 3.0);
  EXPECT_EQ(quantile(values, 0.95), 5.0);
  EXPECT_EQ(quantile(values, 1.0), 5.0);
}

TEST(Quantile, OfNothingIsNotANumber) { EXPECT_TRUE(std::isnan(quantile({}, 0.5))); }

}  // namespace
}  // namespace lstm_planner::test_quantile
