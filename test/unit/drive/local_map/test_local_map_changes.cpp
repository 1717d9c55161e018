#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "lstm_planner/drive/local_map/local_map.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/local_map/memory_fixtures.hpp"

namespace lstm_planner::test_local_map_changes {
namespace {

using test::returnsAt;

const AgentParameters kDefaults;
const double kResolution = kDefaults.memory.resolution;

LocalMap smallMemory() {
  MemoryParameters parameters = kDefaults.memory;
  parameters.width = 20.0;
  return LocalMap(parameters, kDefaults.shield);
}

using Square = std::pair<int, int>;  // column, row in the odometry frame

Square squareAt(const Point2& place) {
  return {static_cast<int>(std::floor(place.x / kResolution)), static_cast<int>(std::floor(place.y / kResolution))};
}

Point2 centerOf(const Square& square) {
  return {(square.first + 0.5) * kResolution, (square.second + 0.5) * kResolution};
}

/// What LocalMap::add() is meant to do, square by square. Where the last digits of single precision decide, it
/// says that it does not know.
class PlainMemory {
 public:
  void add(const Situation& situation) {
    doubtful_.clear();
    std::set<Square> returned;
    for (const Point2& obstacle : situation.obstacles) {
      const Point2 place = toParentFrame(situation.pose, obstacle);
      for (const double dx : {-kBlur, kBlur}) {
        for (const double dy : {-kBlur, kBlur}) doubtful_.insert(squareAt({place.x + dx, place.y + dy}));
      }
      const double distance = std::hypot(obstacle.x, obstacle.y);
      if (std::abs(distance - kDefaults.memory.reach) < kBlur) continue;
      if (distance <= kDefaults.memory.reach) returned.insert(squareAt(place));
      // Without doubt in the one square.
      if (distance > kDefaults.memory.reach || isInside(place)) doubtful_.erase(squareAt(place));
    }
    for (auto square = squares_.begin(); square != squares_.end();) {
      square =
          returned.count(*square) == 0 && isCleared(*square, situation) ? squares_.erase(square) : std::next(square);
    }
    squares_.insert(returned.begin(), returned.end());
    const double radius = 0.9 * kDefaults.shield.footprint_radius;
    for (auto square = squares_.begin(); square != squares_.end();) {
      square = distanceBetween(centerOf(*square), situation.pose) < radius ? squares_.erase(square) : std::next(square);
    }
  }

  /// Takes over what is occupied where it is in doubt itself.
  void settleDoubts(const std::set<Square>& occupied) {
    for (const Square& square : doubtful_) {
      squares_.erase(square);
      if (occupied.count(square) != 0) squares_.insert(square);
    }
  }

  const std::set<Square>& squares() const { return squares_; }

 private:
  static constexpr double kBlur = 1e-5;  // m

  static bool isInside(const Point2& place) {
    return squareAt({place.x - kBlur, place.y - kBlur}) == squareAt({place.x + kBlur, place.y + kBlur}) &&
           squareAt({place.x - kBlur, place.y + kBlur}) == squareAt({place.x + kBlur, place.y - kBlur});
  }

  bool isCleared(const Square& square, const Situation& situation) {
    const RangeProfile& profile = situation.profile;
    const Point2 scanner = toParentFrame(situation.pose, profile.origin);
    const double direction = directionTo(scanner, centerOf(square)) - situation.pose.yaw;
    const long beam = profile.beamTowards(direction);
    if (profile.beamTowards(direction - 3e-5) != profile.beamTowards(direction + 3e-5)) doubtful_.insert(square);
    if (beam < 0) return false;
    const long last = static_cast<long>(profile.ranges.size()) - 1;
    double nearest = 1e9;
    for (long i = std::max(0L, beam - 2); i <= std::min(beam + 2, last); ++i) {
      nearest = std::min<double>(nearest, profile.ranges[static_cast<std::size_t>(i)]);
    }
    const double needed = distanceBetween(scanner, centerOf(square)) + 0.1;
    if (std::abs(nearest - needed) < kBlur) doubtful_.insert(square);
    return nearest > needed;
  }

  std::set<Square> squares_;
  std::set<Square> doubtful_;
};

/// Scans with noise of a hall with boxes that come and go.
class ComingAndGoing {
 public:
  explicit ComingAndGoing(unsigned seed) : random_(seed), scanner_(HokuyoParameters(), seed) {}

  Situation next(const Pose2& pose) {
    OccupancyGrid grid = test::emptyHall(14.0, 9.0);
    std::uniform_real_distribution<double> x(1.0, 13.0);
    std::uniform_real_distribution<double> y(1.0, 8.0);
    for (int i = 0; i < 8; ++i) {
      const Point2 corner{x(random_), y(random_)};
      if (std::hypot(corner.x + 0.2 - pose.x, corner.y + 0.2 - pose.y) > 1.0) {
        test::fillBox(corner.x, corner.y, corner.x + 0.4, corner.y + 0.4, &grid);
      }
    }
    LaserScan scan;
    scanner_.scan(GridWorld(grid), pose, 0.0, &scan);
    Situation situation;
    perceive(scan, scanner_.parameters().mount, {}, 6.0, &situation);
    situation.pose = pose;
    return situation;
  }

 private:
  std::mt19937 random_;
  Hokuyo scanner_;
};

TEST(LocalMapChanges, AreWhatAPlainMemoryForgetsAndMarks) {
  long forgotten = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    ComingAndGoing world(seed);
    LocalMap memory = smallMemory();
    PlainMemory plain;
    std::set<Square> before;
    for (int i = 0; i < 40; ++i) {
      const Situation situation = world.next({4.0 + 0.04 * i, 4.5 + 0.5 * std::sin(0.1 * i), 0.1 * i - 1.0});
      memory.add(situation);
      std::set<Square> occupied;
      for (const Point2& place : memory.obstacles()) occupied.insert(squareAt(place));
      forgotten += std::count_if(before.begin(), before.end(),
                                 [&](const Square& square) { return occupied.count(square) == 0; });
      before = occupied;
      plain.add(situation);
      plain.settleDoubts(occupied);
      ASSERT_EQ(occupied, plain.squares()) << "seed " << seed << ", look " << i;
    }
  }
  EXPECT_GT(forgotten, 1000);  // boxes that went away
}

TEST(LocalMapChanges, LeaveNoJudgementBehindThatIsOutOfDate) {
  ComingAndGoing world(7);
  LocalMap memory = smallMemory();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(2.0, 7.0);
  for (int i = 0; i < 12; ++i) {
    memory.add(world.next({4.0 + 0.1 * i, 4.5, 0.3 * i}));
    if (i % 3 == 2) memory.block({place(random), place(random)});
    LocalMap anew = memory;
    anew.relaxClearance(true);
    anew.relaxClearance(false);
    for (int cell = 0; cell < memory.side() * memory.side(); ++cell) {
      ASSERT_EQ(static_cast<int>(memory.passage(cell)), static_cast<int>(anew.passage(cell))) << "cell " << cell;
      ASSERT_EQ(memory.exits(cell), anew.exits(cell)) << "cell " << cell;
      ASSERT_EQ(distanceBetween(memory.bestPlace(cell), anew.bestPlace(cell)), 0.0) << "cell " << cell;
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_local_map_changes
