#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "lstm_planner/robot/memory/sight.hpp"
#include "robot/perception/scan_kernels.hpp"
#include "support/instruction_sets.hpp"

namespace lstm_planner::test_scan_kernels {
namespace {

constexpr std::size_t kPadding = 16;

class ScanKernelsOf : public ::testing::TestWithParam<InstructionSet> {
 protected:
  const ScanKernels& kernels_ = scanKernels(GetParam());
  std::mt19937 random_{5};
};

TEST_P(ScanKernelsOf, NameTheSquaresOfPlacesOnceWhereTheyFollowOneAnother) {
  const double yaw = 0.4;
  const double resolution = 0.05;
  const float per_metre = static_cast<float>(1.0 / resolution);
  const float bias = 300.0f;
  SquareFrame frame{std::cos(0.4f) * per_metre, std::sin(0.4f) * per_metre, bias, bias, 100, 50, 600, 100.0f};
  std::uniform_real_distribution<double> coordinate(-12.0, 12.0);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (const std::size_t count : {1, 3, 15, 16, 17, 100, 1081}) {
    std::vector<double> places;
    while (places.size() < 2 * count) {
      const double x = coordinate(random_);
      const double y = coordinate(random_);
      for (int i = 0; i < 4 && places.size() < 2 * count; ++i) {
        places.push_back(x + noise(random_));
        places.push_back(y + noise(random_));
      }
    }
    std::vector<std::uint32_t> work(count + 2 * kPadding);
    std::vector<std::uint32_t> keys(count + 2 * kPadding);
    keys.resize(kernels_.squaresOf(frame, places.data(), count, work.data(), keys.data()));
    // Each key is that of a place, in order, and each place within reach and the window has its key.
    std::size_t next = 0;
    bool have = false;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = places[2 * i];
      const double y = places[2 * i + 1];
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

TEST_P(ScanKernelsOf, NameNoSquareOfPlacesThatAreTooFarForAWholeNumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const SquareFrame frame{20.0f, 0.0f, 300.0f, 300.0f, 0, 0, 600, 100.0f};
  for (const double huge : {1.2e8, -1e10, 1e19, 1e300, kInf, -kInf, kNan}) {
    std::vector<double> places;
    for (int i = 0; i < 40; ++i) {
      places.insert(places.end(), {1.0 + 0.1 * i, 2.0});
      places.insert(places.end(), {i % 2 == 0 ? huge : 1.0, i % 2 == 0 ? 1.0 : huge});
    }
    const std::size_t count = places.size() / 2;
    std::vector<std::uint32_t> work(count + 2 * kPadding);
    std::vector<std::uint32_t> keys(count + 2 * kPadding);
    keys.resize(kernels_.squaresOf(frame, places.data(), count, work.data(), keys.data()));
    EXPECT_EQ(keys.size(), 40u) << huge;
    for (const std::uint32_t key : keys) EXPECT_EQ(key >> 16, 340u) << huge;
  }
}

TEST_P(ScanKernelsOf, NameNoSquareOfARobotThatIsTooFarAway) {
  constexpr int kFar = 2000000000;
  for (const int first : {kFar, -kFar}) {
    const SquareFrame frame{20.0f, 0.0f, 300.0f, 300.0f, first, first, 600, 100.0f};
    const std::vector<double> places(2 * 20, 1.0);
    std::vector<std::uint32_t> work(20 + 2 * kPadding);
    std::vector<std::uint32_t> keys(20 + 2 * kPadding);
    EXPECT_EQ(kernels_.squaresOf(frame, places.data(), 20, work.data(), keys.data()), 0u) << first;
  }
}

/// A scan of walls at many distances, with some beams that know nothing.
RangeProfile scanOf(double increment, std::size_t beams, std::mt19937* random) {
  RangeProfile profile;
  profile.first_direction = -2.3;
  profile.increment = increment;
  std::uniform_real_distribution<float> range(0.5f, 12.0f);
  std::bernoulli_distribution is_corner(0.05);
  float now = 5.0f;
  for (std::size_t i = 0; i < beams; ++i) {
    if (is_corner(*random)) now = range(*random);
    profile.ranges.push_back(i % 97 == 5 ? 0.0f : now);
  }
  return profile;
}

TEST_P(ScanKernelsOf, ClearWhatThePlainDefinitionClears) {
  constexpr double kResolution = 0.05;
  constexpr double kYaw = 1.1;
  constexpr int kSide = 4;
  constexpr int kCells = 120;
  const float corner = -12.01f;  // no square is just where the scanner is: it has no direction
  const SquareGrid grid{corner, corner, static_cast<float>(kResolution)};
  for (const double increment : {0.00436332, -0.00436332, 2.0 * M_PI / 720.0}) {
    const RangeProfile profile = scanOf(increment, increment < 0.006 ? 1081 : 720, &random_);
    Sight sight(std::hypot(1.5, 1.5) * kResolution);
    sight.show(profile, kYaw);
    const SightBeams beams = sight.beams();
    std::size_t cleared = 0;
    std::size_t cells_in_sight = 0;
    for (int row = 0; row < kCells; ++row) {
      std::vector<std::uint32_t> cells(kCells + kPadding);
      std::vector<float> limits(kCells + kPadding);
      for (int column = 0; column < kCells; ++column) {
        cells[static_cast<std::size_t>(column)] = static_cast<std::uint32_t>((row * kSide) << 16 | column * kSide);
      }
      const std::size_t count = kernels_.cellsInSight(beams, grid, cells.data(), kCells, limits.data());
      cells_in_sight += count;
      const std::vector<std::uint16_t> occupied(count, 0xffff);
      std::vector<std::uint32_t> clear(kCells * kSide * kSide + kPadding);
      clear.resize(
          kernels_.clearSquares(beams, grid, cells.data(), limits.data(), occupied.data(), count, clear.data()));
      cleared += clear.size();
      std::sort(clear.begin(), clear.end());
      for (int square_row = row * kSide; square_row < (row + 1) * kSide; ++square_row) {
        for (int column = 0; column < kCells * kSide; ++column) {
          const double x = corner + column * kResolution;
          const double y = corner + square_row * kResolution;
          const double distance = std::hypot(x, y);
          const auto reachOf = [&](double towards) {  // how far away a place may lie to be cleared
            const long beam = profile.beamTowards(towards - kYaw);
            if (beam < 0) return -1.0;
            double nearest = 1e9;
            for (long i = std::max(0L, beam - 2); i <= beam + 2; ++i) {
              if (i < static_cast<long>(profile.ranges.size())) {
                nearest = std::min<double>(nearest, profile.ranges[static_cast<std::size_t>(i)]);
              }
            }
            return nearest - 0.1;
          };
          const double towards = std::atan2(y, x);
          const double a = reachOf(towards - 3e-5);
          const double b = reachOf(towards + 3e-5);
          const auto key = static_cast<std::uint32_t>(square_row << 16 | column);
          const bool is_clear = std::binary_search(clear.begin(), clear.end(), key);
          if (distance < std::min(a, b) - 1e-4) {
            ASSERT_TRUE(is_clear) << x << ", " << y;
          }
          if (distance > std::max(a, b) + 1e-4) {
            ASSERT_FALSE(is_clear) << x << ", " << y;
          }
        }
      }
    }
    EXPECT_GT(cleared, 10000u);
    EXPECT_LT(cells_in_sight, static_cast<std::size_t>(kCells * kCells * 9 / 10));
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, ScanKernelsOf, ::testing::ValuesIn(runnableInstructionSets()), test::instructionSetName);

}  // namespace
}  // namespace lstm_planner::test_scan_kernels
