#include "lstm_planner/grid_world/learning/grid_course.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/common/parameter_check.hpp"

namespace lstm_planner {
namespace {

constexpr double kBucketWidth = 10.0;  ///< cells
constexpr std::size_t kStartsABucket = 12;

/// Cells; a start this near to the goal as the crow flies is no dead end.
constexpr double kNearGoal = 3.0;

double straightDistance(CellIndex a, CellIndex b) {
  return std::hypot(static_cast<double>(a.column - b.column), static_cast<double>(a.row - b.row));
}

PassableGrid mirrored(const PassableGrid& grid) {
  PassableGrid result(grid.rows(), grid.columns(), false);
  for (const CellIndex cell : grid.cells()) {
    if (grid.passable(cell)) result.set({cell.row, cell.column}, true);
  }
  return result;
}

double longestOf(const GridCourseParameters& parameters) {
  return parameters.long_share > 0.0 ? std::max(parameters.longest, parameters.max_length) : parameters.max_length;
}

std::size_t bucketsUpTo(double length, const GridCourseParameters& parameters) {
  return static_cast<std::size_t>(std::ceil((length - parameters.min_length) / kBucketWidth));
}

/// Keeps some of the starts of each length, every one equally likely (reservoir sampling).
std::vector<std::vector<CellIndex>> drawStarts(const CourseMap& map, const GridDistances& distances,
                                               const GridCourseParameters& parameters, Random& random) {
  std::vector<std::vector<CellIndex>> starts(bucketsUpTo(longestOf(parameters), parameters));
  std::vector<std::size_t> seen(starts.size(), 0);
  for (const CellIndex cell : map.grid.cells()) {
    const double length = static_cast<double>(distances.at(cell));
    if (!(length >= parameters.min_length && length <= longestOf(parameters))) continue;
    const std::size_t bucket =
        std::min(static_cast<std::size_t>((length - parameters.min_length) / kBucketWidth), starts.size() - 1);
    ++seen[bucket];
    if (starts[bucket].size() < kStartsABucket) {
      starts[bucket].push_back(cell);
    } else if (uniform(random) * static_cast<double>(seen[bucket]) < static_cast<double>(kStartsABucket)) {
      starts[bucket][uniformIndex(random, kStartsABucket)] = cell;
    }
  }
  // Lengths far beyond all paths may be allowed.
  while (!starts.empty() && starts.back().empty()) starts.pop_back();
  starts.shrink_to_fit();
  return starts;
}

}  // namespace

void validate(const GridCourseParameters& parameters) {
  checkParameter(parameters.min_length >= 2.0, "min_length", parameters.min_length, "at least 2 cells");
  checkParameter(parameters.max_length > parameters.min_length, "max_length", parameters.max_length,
                 "more than min_length");
  checkParameter(parameters.long_share >= 0.0 && parameters.long_share <= 1.0, "long_share", parameters.long_share,
                 "a number in [0, 1]");
  checkParameter(parameters.longest <= 1e5, "longest", parameters.longest, "at most 100000 cells");
  checkParameter(parameters.short_share >= 0.0 && parameters.short_share <= 1.0, "short_share", parameters.short_share,
                 "a number in [0, 1]");
  checkParameter(parameters.dead_end_share >= 0.0 && parameters.dead_end_share <= 1.0, "dead_end_share",
                 parameters.dead_end_share, "a number in [0, 1]");
  checkAtLeastOne("goals", parameters.goals);
}

CellIndex deadEndBelow(const PassableGrid& grid, CellIndex start, CellIndex goal, CornerCutting corner_cutting) {
  CellIndex cell = start;
  double nearest = straightDistance(start, goal);
  for (bool nearer = true; nearer;) {
    nearer = false;
    const CellIndex from = cell;
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      const CellIndex beside = cellBeside(from, direction);
      const double distance = straightDistance(beside, goal);
      if (distance >= nearest || !movePossible(grid, from, direction, corner_cutting)) continue;
      nearest = distance;
      cell = beside;
      nearer = true;
    }
  }
  return cell;
}

GridCourse::GridCourse(const GridCourseParameters& parameters, const std::vector<Set>& sets, std::uint64_t seed,
                       int threads)
    : parameters_(parameters), random_(seed) {
  validate(parameters);
  if (sets.empty()) throw std::invalid_argument("there are no maps to learn or to validate on, expected at least one");
  const int goals = std::max(1, parameters.goals / static_cast<int>(sets.size()));
  for (const Set& set : sets) {
    if (set.empty()) {
      throw std::invalid_argument("a set of maps to learn or to validate on is empty, expected at least one map");
    }
    CourseSet course;
    const std::size_t copies = parameters.mirrored ? 2 : 1;
    course.maps.resize(set.size() * copies);
    parallelFor(static_cast<int>(course.maps.size()), threads, [&](int index, int) {
      const PassableGrid& grid = set[static_cast<std::size_t>(index) / copies];
      auto map = std::make_shared<CourseMap>();
      map->grid = static_cast<std::size_t>(index) % copies == 0 ? grid : mirrored(grid);
      map->ranges = RangeTable(map->grid);
      course.maps[static_cast<std::size_t>(index)] = std::move(map);
    });
    course.goals.resize(static_cast<std::size_t>(goals));
    std::vector<std::uint64_t> seeds(course.goals.size());
    for (std::uint64_t& goal_seed : seeds) goal_seed = random_();
    parallelFor(goals, threads, [&](int index, int) {
      Random random(seeds[static_cast<std::size_t>(index)]);
      course.goals[static_cast<std::size_t>(index)] = makeGoal(course, random);
    });
    sets_.push_back(std::move(course));
  }
  buckets_ = bucketsUpTo(parameters.max_length, parameters);
  long_buckets_ = bucketsUpTo(longestOf(parameters), parameters) - buckets_;
}

std::shared_ptr<const CourseGoal> GridCourse::makeGoal(const CourseSet& set, Random& random) const {
  // A cell in a tiny enclosed corner has no start: it is drawn again, but not for ever on a map without any path.
  constexpr int kAttempts = 10000;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const auto& map = set.maps[uniformIndex(random, set.maps.size())];
    const CellIndex cell{static_cast<int>(uniformIndex(random, static_cast<std::size_t>(map->grid.columns()))),
                         static_cast<int>(uniformIndex(random, static_cast<std::size_t>(map->grid.rows())))};
    if (!map->grid.passable(cell)) continue;
    auto goal = std::make_shared<CourseGoal>();
    goal->map = map;
    goal->goal = cell;
    goal->corner_cutting = parameters_.corner_cutting;
    goal->distances = GridDistances(map->grid, cell, parameters_.corner_cutting);
    goal->starts = drawStarts(*map, goal->distances, parameters_, random);
    if (!goal->starts.empty()) return goal;
  }
  throw std::invalid_argument("no path of the wanted length was found on the maps");
}

/// One draw of `random`, also where there is one set only, which uniformIndex() does not promise.
std::size_t GridCourse::drawSet(Random& random) const {
  return static_cast<std::size_t>(uniform(random) * static_cast<double>(sets_.size()));
}

std::size_t GridCourse::drawBucket(Random& random) const {
  if (long_buckets_ > 0 && uniform(random) < parameters_.long_share)
    return buckets_ + uniformIndex(random, long_buckets_);
  if (uniform(random) >= parameters_.short_share) return uniformIndex(random, buckets_);
  // The logarithm of the length is uniform.
  const double length =
      parameters_.min_length * std::pow(parameters_.max_length / parameters_.min_length, uniform(random));
  return std::min(static_cast<std::size_t>((length - parameters_.min_length) / kBucketWidth), buckets_ - 1);
}

GridCourse::Episode GridCourse::draw(Random& random) const {
  const CourseSet& set = sets_[drawSet(random)];
  // The length is drawn before the map: small maps, which have no long paths, are not to make short paths more
  // frequent.
  const std::size_t bucket = drawBucket(random);
  constexpr int kAttempts = 1000;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const auto& goal = set.goals[uniformIndex(random, set.goals.size())];
    if (bucket >= goal->starts.size() || goal->starts[bucket].empty()) continue;
    const auto& starts = goal->starts[bucket];
    CellIndex start = starts[uniformIndex(random, starts.size())];
    if (parameters_.dead_end_share > 0.0 && uniform(random) < parameters_.dead_end_share) {
      const CellIndex end = deadEndBelow(goal->map->grid, start, goal->goal, parameters_.corner_cutting);
      if (straightDistance(end, goal->goal) > kNearGoal) start = end;
    }
    return {goal, start};
  }
  return draw(random);
}

void GridCourse::renew(int count) {
  for (int i = 0; i < count; ++i) {
    CourseSet& set = sets_[drawSet(random_)];
    set.goals[set.oldest] = makeGoal(set, random_);
    set.oldest = (set.oldest + 1) % set.goals.size();
  }
}

}  // namespace lstm_planner
