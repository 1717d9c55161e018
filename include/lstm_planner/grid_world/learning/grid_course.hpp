#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid/passable_grid.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"
#include "lstm_planner/grid_world/world/range_table.hpp"

namespace lstm_planner {

/// A map to learn on, with what is computed once for it.
struct CourseMap {
  PassableGrid grid;
  RangeTable ranges;
};

/// A goal: the true distance to it from everywhere (known only while learning), and possible starts by the length of
/// the shortest path.
struct CourseGoal {
  std::shared_ptr<const CourseMap> map;
  CellIndex goal;
  GridDistances distances;
  std::vector<std::vector<CellIndex>> starts;                ///< by length: bucket i from shortest + i * bucket width
  CornerCutting corner_cutting = CornerCutting::kForbidden;  ///< of the paths
};

/// Which episodes are drawn.
struct GridCourseParameters {
  double min_length = 10.0;   ///< cells; of the shortest path, >= 2
  double max_length = 300.0;  ///< cells
  double short_share = 0.5;   ///< share of episodes whose length has a probability in proportion to 1 / length
  double long_share = 0.05;   ///< share of episodes that are longer than max_length
  double longest = 1500.0;    ///< cells; largest length of those
  int goals = 600;            ///< kept at a time, over all maps
  bool mirrored = true;       ///< every map is also used mirrored at its diagonal
  /// Share of the episodes that start at deadEndBelow() of the drawn start: in a blind spot (thesis ch. 5), from which
  /// the path at first leads away from the goal.
  double dead_end_share = 0.0;
  CornerCutting corner_cutting = CornerCutting::kForbidden;
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridCourseParameters& parameters);

/// The cell where an agent stops that moves from `start` always to the neighbour nearest to the goal, as long as one is
/// nearer than its own cell: the goal, or a dead end.
CellIndex deadEndBelow(const PassableGrid& grid, CellIndex start, CellIndex goal, CornerCutting corner_cutting);

/// Draws the episodes to learn from, equally often from each set of maps. The length of the shortest path is uniform in
/// its range or, for a share of the episodes, has a probability in proportion to 1 / length, because short paths count
/// most in the mean of length / optimum. A few paths are much longer.
class GridCourse {
 public:
  /// One episode to learn from.
  struct Episode {
    std::shared_ptr<const CourseGoal> goal;
    CellIndex start;
  };

  using Set = std::vector<PassableGrid>;
  /// Throws std::invalid_argument when there is no map, or a set has none.
  GridCourse(const GridCourseParameters& parameters, const std::vector<Set>& sets, std::uint64_t seed, int threads);

  CornerCutting cornerCutting() const { return parameters_.corner_cutting; }

  /// May be called from several threads at once, with different generators.
  Episode draw(Random& random) const;

  /// Replaces the oldest `count` goals by new ones. Must not be called while another thread draws.
  void renew(int count);

 private:
  /// The maps of a Set, and the goals that are kept in them.
  struct CourseSet {
    std::vector<std::shared_ptr<const CourseMap>> maps;
    std::vector<std::shared_ptr<const CourseGoal>> goals;
    std::size_t oldest = 0;
  };
  std::size_t drawBucket(Random& random) const;
  std::size_t drawSet(Random& random) const;
  std::shared_ptr<const CourseGoal> makeGoal(const CourseSet& set, Random& random) const;

  GridCourseParameters parameters_;
  std::vector<CourseSet> sets_;
  std::size_t buckets_ = 0;       ///< of lengths up to max_length
  std::size_t long_buckets_ = 0;  ///< of those beyond
  Random random_;
};

}  // namespace lstm_planner
