#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "lstm_planner/base/common/geometry.hpp"
#include "robot/driving/shield_kernels.hpp"
#include "support/instruction_sets.hpp"

namespace lstm_planner::test_shield_kernels {
namespace {

constexpr double kReach = 6.0;

/// Groups that a kernel made of places.
struct Made {
  std::size_t dealt_with = 0;
  std::size_t count = 0;
  std::vector<double> places;
  std::vector<float> boxes;

  ReturnGroups view() const { return {count, places.data(), boxes.data()}; }
};

Made makeGroups(const ShieldKernels& kernels, const std::vector<Point2>& places) {
  const std::size_t groups = places.size() / kReturnsAGroup;
  Made made;
  made.places.resize(2 * places.size());
  made.boxes.resize((groups + kGroupsABlock - 1) / kGroupsABlock * kNumbersABlock);
  made.dealt_with =
      kernels.add(&places.front().x, groups, kReach * kReach, made.places.data(), made.boxes.data(), &made.count);
  return made;
}

class ShieldKernelsOf : public ::testing::TestWithParam<InstructionSet> {
 protected:
  /// Walls around the robot, `nearest` to `farthest` m away.
  std::vector<Point2> walls(std::size_t groups, double nearest, double farthest) {
    std::uniform_real_distribution<double> range(nearest, farthest);
    std::vector<Point2> places;
    for (std::size_t group = 0; group < groups; ++group) {
      const double wall = range(random_);
      for (std::size_t i = 0; i < kReturnsAGroup; ++i) {
        places.push_back(pointAlong(Point2{}, 0.06 * static_cast<double>(places.size()), wall));
      }
    }
    return places;
  }

  const ShieldKernels& kernels_ = shieldKernels(GetParam());
  const ShieldKernels& baseline_ = shieldKernels(InstructionSet::kBaseline);
  std::mt19937 random_{11};
};

TEST_P(ShieldKernelsOf, GroupWhatIsWithinReachAndLeaveOutWhatIsBeyond) {
  std::vector<Point2> places = walls(3, 1.0, 5.0);
  const std::vector<Point2> far = walls(2, 8.0, 12.0);
  places.insert(places.begin() + kReturnsAGroup, far.begin(), far.end());
  const Made made = makeGroups(kernels_, places);
  EXPECT_EQ(made.dealt_with, 5u);
  EXPECT_EQ(made.count, 3u);
  double sum = 0.0;
  for (std::size_t i = 0; i < 2 * kReturnsAGroup; ++i) sum += made.places[i];
  double expected = 0.0;
  for (std::size_t i = 0; i < kReturnsAGroup; ++i) expected += places[i].x + places[i].y;
  EXPECT_NEAR(sum, expected, 1e-12) << "the first group holds the first places, in any order";
  EXPECT_EQ(made.boxes, makeGroups(baseline_, places).boxes);
}

TEST_P(ShieldKernelsOf, StopAtTheFirstGroupThatIsNeither) {
  std::vector<Point2> places = walls(4, 1.0, 5.0);
  for (const double odd : {7.0, std::numeric_limits<double>::infinity()}) {
    places[2 * kReturnsAGroup + 5] = {odd, 0.0};
    const Made made = makeGroups(kernels_, places);
    EXPECT_EQ(made.dealt_with, 2u) << odd;
    EXPECT_EQ(made.count, 2u) << odd;
  }
}

TEST_P(ShieldKernelsOf, PassOverWhatIsNoNumber) {
  const Point2 ahead{2.0, 0.0};
  std::vector<Point2> places(kReturnsAGroup, ahead);
  places[3].x = std::numeric_limits<double>::quiet_NaN();
  const Made made = makeGroups(kernels_, places);
  EXPECT_EQ(made.count, 1u);
  const DiscLine line{0.0, 0.0, 1.0, 0.0, 5.0, 0.25, 0.2, 0.0, 1e-5};
  EXPECT_DOUBLE_EQ(kernels_.freeLine(made.view(), line), 1.75);
}

TEST_P(ShieldKernelsOf, MeasureFreeLinesToTheLastBitAsTheBaselineDoes) {
  std::uniform_real_distribution<double> offset(-0.4, 0.4);
  std::uniform_real_distribution<double> direction(-M_PI, M_PI);
  int shortened = 0;
  int stopped = 0;
  for (const std::size_t groups : {1, 4, 8, 17, 68}) {
    const Made made = makeGroups(kernels_, walls(groups, 0.2, 5.0));
    for (int i = 0; i < 500; ++i) {
      const double towards = direction(random_);
      const double limit = i % 2 == 0 ? 0.5 : 7.0;
      const double wanted = 0.25;
      const double hard = i % 3 == 0 ? wanted : 0.2;
      const double enough = i % 5 == 0 ? limit : 0.0;
      const DiscLine line{
          offset(random_), offset(random_), std::cos(towards), std::sin(towards), limit, wanted, hard, enough, 1e-5};
      const double free = kernels_.freeLine(made.view(), line);
      ASSERT_EQ(free, baseline_.freeLine(made.view(), line));
      shortened += free > 0.0 && free < limit ? 1 : 0;
      stopped += free == 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(shortened, 500);
  EXPECT_GT(stopped, 50);
}

INSTANTIATE_TEST_SUITE_P(Sets, ShieldKernelsOf, ::testing::ValuesIn(runnableInstructionSets()),
                         test::instructionSetName);

}  // namespace
}  // namespace lstm_planner::test_shield_kernels
