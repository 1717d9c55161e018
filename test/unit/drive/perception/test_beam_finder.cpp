#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lstm_planner/drive/perception/beam_finder.hpp"

namespace lstm_planner::test_beam_finder {
namespace {

struct Fan {
  double first;      ///< rad
  double increment;  ///< rad
  std::size_t beams;
};

class BeamFinderFan : public ::testing::TestWithParam<Fan> {};

TEST_P(BeamFinderFan, FindsTheBeamThatTheProfileNames) {
  RangeProfile profile;
  profile.first_direction = GetParam().first;
  profile.increment = GetParam().increment;
  profile.ranges.resize(GetParam().beams);
  const double yaw = 0.7;
  const BeamFinder finder(profile, yaw);
  constexpr int kPlaces = 4000;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> direction(-M_PI, M_PI);
  std::uniform_real_distribution<double> distance(0.05, 20.0);
  // Where the nearest beam changes either may be named: within the 2e-5 rad that are promised.
  constexpr double kError = 2e-5;
  int seen = 0;
  int blind = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Point2 place = pointAlong(Point2{}, direction(random), distance(random));
    const auto x = static_cast<float>(place.x);
    const auto y = static_cast<float>(place.y);
    const double towards = std::atan2(y, x) - yaw;
    const long beam = finder.beamTowards(x, y);
    ASSERT_TRUE(beam == profile.beamTowards(towards - kError) || beam == profile.beamTowards(towards + kError))
        << "beam " << beam << " towards " << towards << " rad, expected " << profile.beamTowards(towards);
    ++(beam < 0 ? blind : seen);
  }
  EXPECT_GT(seen, 1000);
  EXPECT_EQ(blind == 0, std::abs(GetParam().increment) * static_cast<double>(GetParam().beams) > 6.28);
}

INSTANTIATE_TEST_SUITE_P(Fans, BeamFinderFan,
                         ::testing::Values(Fan{-2.35619, 0.00436332, 1081}, Fan{2.35619, -0.00436332, 1081},
                                           Fan{-M_PI, 2.0 * M_PI / 720.0, 720}, Fan{0.3, 2.0 * M_PI / 360.0, 361},
                                           Fan{-1.6, 0.01, 320}),
                         [](const auto& info) {
                           return std::to_string(info.param.beams) +
                                  (info.param.increment < 0.0 ? "Clockwise" : "Beams");
                         });

TEST(BeamFinder, AnswersForThePlaceOfTheScannerItself) {
  RangeProfile profile;
  profile.first_direction = -1.0;
  profile.increment = 0.1;
  profile.ranges.resize(21);
  EXPECT_EQ(BeamFinder(profile, 0.0).beamTowards(0.0f, 0.0f), 0);
}

}  // namespace
}  // namespace lstm_planner::test_beam_finder
