#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "drive/local_map/return_squares.hpp"

namespace lstm_planner::test_return_squares {
namespace {

std::vector<std::uint32_t> squaresOf(const SquareFrame& frame, const std::vector<Point2>& places) {
  std::vector<std::uint32_t> keys;
  findSquares(frame, places, &keys);
  return keys;
}

TEST(FindSquares, NamesTheSquaresOfPlacesOnceWhereTheyFollowOneAnother) {
  const double yaw = 0.4;
  const double resolution = 0.05;
  const float per_metre = static_cast<float>(1.0 / resolution);
  const float bias = 300.0f;
  SquareFrame frame{std::cos(0.4f) * per_metre, std::sin(0.4f) * per_metre, bias, bias, 100, 50, 600, 100.0f};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-12.0, 12.0);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (const std::size_t count : {1, 3, 15, 16, 17, 100, 1081}) {
    std::vector<Point2> places;
    while (places.size() < count) {
      const double x = coordinate(random);
      const double y = coordinate(random);
      for (int i = 0; i < 4 && places.size() < count; ++i) {
        places.push_back({x + noise(random), y + noise(random)});
      }
    }
    const std::vector<std::uint32_t> keys = squaresOf(frame, places);
    // Each key is that of a place, in order, and each place within reach and the window has its key.
    std::size_t next = 0;
    bool have = false;
    for (std::size_t i = 0; i < count; ++i) {
      const auto [x, y] = places[i];
      const double column = (std::cos(yaw) * x - std::sin(yaw) * y) / resolution + bias;
      const double row = (std::sin(yaw) * x + std::cos(yaw) * y) / resolution + bias;
      const int keyed_column = static_cast<int>(column) + 100;
      const int keyed_row = static_cast<int>(row) + 50;
      const auto matches = [&](std::uint32_t key) {
        constexpr double kRounding = 1e-3;  // squares; floats of up to 600
        const double in_column = column + 100 - (key & 0xffff);
        const double in_row = row + 50 - (key >> 16);
        return in_column > -kRounding && in_column < 1 + kRounding && in_row > -kRounding && in_row < 1 + kRounding;
      };
      const bool outside =
          x * x + y * y > 100.0 || keyed_column < 0 || keyed_row < 0 || keyed_column >= 600 || keyed_row >= 600;
      if (outside) {
        have = false;
      } else if (!have || !matches(keys[next - 1])) {
        ASSERT_LT(next, keys.size()) << "place " << i << " of " << count;
        ASSERT_TRUE(matches(keys[next])) << "place " << i << " of " << count;
        ++next;
        have = true;
      }
    }
    EXPECT_EQ(next, keys.size());
  }
}

TEST(FindSquares, NamesNoSquareOfPlacesThatAreTooFarForAWholeNumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const SquareFrame frame{20.0f, 0.0f, 300.0f, 300.0f, 0, 0, 600, 100.0f};
  for (const double huge : {1.2e8, -1e10, 1e19, 1e300, kInf, -kInf, kNan}) {
    std::vector<Point2> places;
    for (int i = 0; i < 40; ++i) {
      places.push_back({1.0 + 0.1 * i, 2.0});
      places.push_back({i % 2 == 0 ? huge : 1.0, i % 2 == 0 ? 1.0 : huge});
    }
    const std::vector<std::uint32_t> keys = squaresOf(frame, places);
    EXPECT_EQ(keys.size(), 40u) << huge;
    for (const std::uint32_t key : keys) EXPECT_EQ(key >> 16, 340u) << huge;
  }
}

TEST(FindSquares, NamesNoSquareOfARobotThatIsTooFarAway) {
  constexpr int kFar = 2000000000;
  for (const int first : {kFar, -kFar}) {
    const SquareFrame frame{20.0f, 0.0f, 300.0f, 300.0f, first, first, 600, 100.0f};
    EXPECT_TRUE(squaresOf(frame, std::vector<Point2>(20, {1.0, 1.0})).empty()) << first;
  }
}

}  // namespace
}  // namespace lstm_planner::test_return_squares
