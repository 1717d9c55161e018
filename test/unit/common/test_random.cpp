#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "lstm_planner/common/random.hpp"

namespace lstm_planner::test_random {
namespace {

TEST(Random, GivesTheSameNumbersOnEveryMachine) {
  // The standard fixes the 10000th number of a generator with the default seed.
  Random random;
  random.discard(9999);
  EXPECT_EQ(random(), 9981545732273789042ull);
  Random again;
  again.discard(9999);
  EXPECT_EQ(uniform(again), static_cast<double>(9981545732273789042ull >> 11) / 9007199254740992.0);
}

TEST(Random, IsUniformBelowOne) {
  Random random(1);
  std::array<int, 10> counts{};
  for (int i = 0; i < 10000; ++i) {
    const double value = uniform(random);
    ASSERT_TRUE(value >= 0.0 && value < 1.0);
    ++counts[static_cast<std::size_t>(value * 10.0)];
  }
  for (const int count : counts) EXPECT_NEAR(count, 1000, 4.0 * 30.0);  // standard deviation sqrt(10000 * 0.1 * 0.9)
}

TEST(Random, ChoosesEveryIndex) {
  Random random(2);
  std::array<int, 3> counts{};
  for (int i = 0; i < 9000; ++i) ++counts.at(uniformIndex(random, 3));
  for (const int count : counts) EXPECT_NEAR(count, 3000, 4.0 * 45.0);
  EXPECT_EQ(uniformIndex(random, 0), 0u);
  EXPECT_EQ(uniformIndex(random, 1), 0u);
}

TEST(Random, HasNormalMoments) {
  Random random(3);
  constexpr int kCount = 40000;
  double sum = 0.0;
  double squares = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double value = normal(random);
    sum += value;
    squares += value * value;
    beyond_two += std::abs(value) > 2.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 4.0 / std::sqrt(kCount));
  EXPECT_NEAR(squares / kCount, 1.0, 4.0 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(static_cast<double>(beyond_two) / kCount, 0.0455, 0.005)
      << "the normal law's share beyond two deviations";
}

TEST(Random, ShufflesWithoutLosingAnything) {
  std::vector<int> elements(50);
  std::iota(elements.begin(), elements.end(), 0);
  const std::vector<int> ordered = elements;
  Random random(4);
  shuffle(&elements, random);
  EXPECT_NE(elements, ordered);
  EXPECT_TRUE(std::is_permutation(elements.begin(), elements.end(), ordered.begin()));
}

}  // namespace
}  // namespace lstm_planner::test_random
