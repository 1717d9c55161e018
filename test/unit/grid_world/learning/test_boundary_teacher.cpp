#include <gtest/gtest.h>

#include <cmath>

#include "grid_world/learning/boundary_teacher.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"
#include "unit/grid_world/agent/small_grids.hpp"

namespace lstm_planner::test_boundary_teacher {
namespace {

/// Does what is taught, but now and then something else.
class Pupil : public GridAgent {
 public:
  explicit Pupil(double errors) : errors_(errors) {}

  void start(CellIndex /*start*/, CellIndex /*goal*/) override { memory_.start(); }
  void observe(const GridObservation& observation) override {
    memory_.observe(observation);
    move_ = taughtMove(memory_, observation);
    if (uniform(random_) >= errors_) return;
    const int other = static_cast<int>(uniformIndex(random_, kGridMoveCount));
    if (movePossible(observation.ranges, other, CornerCutting::kForbidden)) move_ = other;
  }
  int decide() override { return move_; }
  GridLeader leader() const override { return GridLeader::kBoundary; }
  void step(int /*direction*/, bool /*moved*/) override {}
  std::size_t peakBytes() const override { return sizeof(*this); }

 private:
  double errors_;
  Random random_{3};
  BoundaryMemory memory_;
  int move_ = kNoPath;
};

/// Share of the small grids with a path where the pupil arrives.
double arrivals(double errors) {
  Pupil pupil(errors);
  int reachable = 0;
  int arrived = 0;
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    const SmallGrid world = smallGrid(seed);
    const GridDistances distances(world.grid, world.goal, CornerCutting::kForbidden);
    if (!std::isfinite(distances.at(world.start))) continue;
    ++reachable;
    const Walk walked = walk(world, &pupil, CornerCutting::kForbidden, 20 * world.grid.size());
    EXPECT_NE(walked.end, WalkEnd::kCollided) << "seed " << seed;
    EXPECT_NE(walked.end, WalkEnd::kNoPath) << "seed " << seed;
    if (walked.end == WalkEnd::kArrived) ++arrived;
  }
  EXPECT_GT(reachable, 1000);
  return static_cast<double>(arrived) / reachable;
}

TEST(BoundaryTeacher, WhoDoesWhatItSaysArrives) { EXPECT_EQ(arrivals(0.0), 1.0); }

TEST(BoundaryTeacher, ItKnowsTheWayFromWhereverAPupilHasStrayed) { EXPECT_EQ(arrivals(0.1), 1.0); }

}  // namespace
}  // namespace lstm_planner::test_boundary_teacher
