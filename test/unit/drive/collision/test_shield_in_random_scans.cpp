#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/drive/collision/shield.hpp"

namespace lstm_planner::test_shield_in_random_scans {
namespace {

constexpr double kRadius = 0.17425;
constexpr double kHardMargin = 0.03;
constexpr double kReach = 6.0;

/// The rule of Shield::freeDistance(), return by return.
double plainFreeDistance(const std::vector<Point2>& obstacles, const Point2& from, double direction, double limit,
                         double clearance) {
  const double wanted = kRadius + clearance;
  const double hard = kRadius + std::min(kHardMargin, clearance);
  double free = limit;
  for (const Point2& obstacle : obstacles) {
    if (std::hypot(obstacle.x, obstacle.y) > kReach) continue;
    const Point2 off{obstacle.x - from.x, obstacle.y - from.y};
    const double along = std::cos(direction) * off.x + std::sin(direction) * off.y;
    const double aside = std::abs(std::cos(direction) * off.y - std::sin(direction) * off.x);
    if (along <= 0.0 || aside >= wanted || along - wanted >= free) continue;
    const double now = std::hypot(off.x, off.y);
    if (now <= hard) return 0.0;
    const double radius = std::max(hard, std::min(wanted, now - 1e-3));
    if (aside < radius) free = std::min(free, std::max(0.0, along - std::sqrt(radius * radius - aside * aside)));
  }
  return free;
}

double plainGap(const std::vector<Point2>& obstacles, const Point2& from) {
  double nearest = kReach + kRadius;
  for (const Point2& obstacle : obstacles) {
    if (std::hypot(obstacle.x, obstacle.y) <= kReach) nearest = std::min(nearest, distanceBetween(from, obstacle));
  }
  return nearest - kRadius;
}

/// Walls, gaps and single posts in the order of the beams; some out of reach.
std::vector<Point2> randomScan(std::mt19937* random) {
  std::uniform_real_distribution<double> range(0.15, 8.0);
  std::uniform_int_distribution<int> length(1, 60);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::vector<Point2> obstacles;
  int left = 0;
  double wall = 0.0;
  for (int beam = 0; beam < 1081; ++beam, --left) {
    if (left == 0) {
      wall = range(*random);
      left = length(*random);
    }
    if (left % 17 != 0) obstacles.push_back(pointAlong(Point2{}, -2.356 + 0.00436 * beam, wall + noise(*random)));
  }
  return obstacles;
}

class ShieldInRandomScans : public ::testing::Test {
 protected:
  template <typename Ask>
  void forManyQuestions(int questions, const Ask& ask) {
    std::uniform_real_distribution<double> direction(-M_PI, M_PI);
    std::uniform_real_distribution<double> limit(0.05, 7.0);
    std::uniform_real_distribution<double> offset(-2.0, 2.0);
    for (int scan = 0; scan < 60; ++scan) {
      std::vector<Point2> obstacles = randomScan(&random_);
      if (scan % 4 == 3) std::shuffle(obstacles.begin(), obstacles.end(), random_);  // no order helps
      obstacles.resize(obstacles.size() - static_cast<std::size_t>(scan));
      shield_.show(obstacles);
      for (int i = 0; i < questions; ++i) {
        const Point2 from = i % 2 == 0 ? Point2{} : Point2{offset(random_), offset(random_)};
        ask(obstacles, Pose2{from.x, from.y, direction(random_)}, i % 3 == 0 ? 0.4 : limit(random_));
      }
    }
  }

  std::mt19937 random_{5};
  Shield shield_{Footprint(kRadius), kHardMargin, kReach};
};

TEST_F(ShieldInRandomScans, FreesNoPathThatAReturnBlocks) {
  int shortened = 0;
  forManyQuestions(60, [&](const std::vector<Point2>& obstacles, const Pose2& from, double limit) {
    for (const double clearance : {0.07, 0.03, 0.0}) {
      const double expected = plainFreeDistance(obstacles, {from.x, from.y}, from.yaw, limit, clearance);
      ASSERT_NEAR(shield_.freeDistance({from.x, from.y}, from.yaw, limit, clearance), expected, 1e-9);
      shortened += expected > 0.0 && expected < limit ? 1 : 0;
    }
  });
  EXPECT_GT(shortened, 2000);
}

TEST_F(ShieldInRandomScans, TellsWhetherAPathIsFreeAsItMeasuresIt) {
  int blocked = 0;
  forManyQuestions(60, [&](const std::vector<Point2>&, const Pose2& from, double limit) {
    const bool is_free = shield_.freeDistance({from.x, from.y}, from.yaw, limit, 0.07) >= limit;
    ASSERT_EQ(shield_.isFree({from.x, from.y}, from.yaw, limit, 0.07), is_free);
    blocked += is_free ? 0 : 1;
  });
  EXPECT_GT(blocked, 1000);
}

TEST_F(ShieldInRandomScans, MeasuresTheGapToTheNearestReturn) {
  forManyQuestions(6, [&](const std::vector<Point2>& obstacles, const Pose2& from, double) {
    ASSERT_NEAR(shield_.gap({from.x, from.y}), plainGap(obstacles, {from.x, from.y}), 1e-12);
  });
}

TEST_F(ShieldInRandomScans, MeasuresTheSmallestGapOnAnArc) {
  forManyQuestions(6, [&](const std::vector<Point2>& obstacles, const Pose2& from, double limit) {
    const double curvature = std::sin(10.0 * limit);
    const double length = 0.2 * limit;
    double sampled = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 50; ++i) {
      const Pose2 at = alongArc(from, curvature, length * i / 50);
      sampled = std::min(sampled, plainGap(obstacles, {at.x, at.y}));
    }
    // Between two samples the arc may come nearer by no more than half their distance.
    const double gap = shield_.arcGap(from, curvature, length);
    ASSERT_LE(gap, sampled + 1e-9);
    ASSERT_GE(gap, sampled - 0.5 * length / 50 - 1e-9);
  });
}

TEST_F(ShieldInRandomScans, GoesAlongAFreeArcThroughNothing) {
  int shortened = 0;
  forManyQuestions(6, [&](const std::vector<Point2>& obstacles, const Pose2& from, double limit) {
    const double curvature = 2.0 * std::sin(10.0 * limit);
    const double free = shield_.freeArc(from, curvature, 0.3 * limit, 0.07);
    const double start = plainGap(obstacles, {from.x, from.y});
    if (start <= 0.07 + 1e-3) {
      return;  // What it may do that near is told in other tests.
    }
    for (int i = 0; i <= 20; ++i) {
      const Pose2 at = alongArc(from, curvature, free * i / 20);
      ASSERT_GE(plainGap(obstacles, {at.x, at.y}), 0.07 - 1e-6);
    }
    const Pose2 beyond = alongArc(from, curvature, free + 0.02);
    if (free < 0.3 * limit) {
      ASSERT_LT(plainGap(obstacles, {beyond.x, beyond.y}), 0.07 + 0.02);
      ++shortened;
    }
  });
  EXPECT_GT(shortened, 20);
}

}  // namespace
}  // namespace lstm_planner::test_shield_in_random_scans
