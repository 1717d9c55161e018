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

/// A place to go to: the true distance to it from everywhere (known while learning only), and where to start from, by
/// length of the shortest path.
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
  double short_share = 0.5;   ///< of the episodes whose length is drawn in proportion to 1 / length, not uniformly
  double long_share = 0.05;   ///< of the episodes that are longer than max_length
  double longest = 1500.0;    ///< cells; of those
  int goals = 600;            ///< kept at a time, over all maps
  bool mirrored = true;       ///< every map also mirrored at its diagonal
  /// Share of the episodes that start where deadEndBelow() the drawn start is, far from the goal: in a blind spot
  /// (thesis ch. 5), from which the path leads away from the goal at first.
  double dead_end_share = 0.0;
  CornerCutting corner_cutting = CornerCutting::kForbidden;
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridCourseParameters& parameters);

/// Where an agent ends that moves from `start` to the neighbour nearest to the goal as the crow flies, as long as one
/// is nearer than where it is: the goal, or a dead end.
CellIndex deadEndBelow(const PassableGrid& grid, CellIndex start, CellIndex goal, CornerCutting corner_cutting);

/// Draws the episodes to learn from: as many of each set of maps, and lengths of the shortest path uniformly in their
/// range or, for a share of the episodes, in proportion to 1 / length: what counts in the mean of length / optimum are
/// short paths. A few are much longer.
class GridCourse {
 public:
  /// One walk to learn from.
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

  /// Replaces the oldest `count` goals by new ones; not while others draw.
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
