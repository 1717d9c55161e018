#include "lstm_planner/grid_world/world/scenario_generator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"

namespace lstm_planner {
namespace {

constexpr int kGoalsPerScenario = 3;

/// The length of the shortest path without the rounding of the distances, which add up floats: its straight and
/// diagonal moves are counted on the way down.
double lengthOfPath(const PassableGrid& grid, const GridDistances& distances, CellIndex cell, CellIndex goal) {
  int straight = 0;
  int diagonal = 0;
  while (cell != goal) {
    int best = 0;
    float best_length = std::numeric_limits<float>::infinity();
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      if (!movePossible(grid, cell, direction, CornerCutting::kForbidden)) continue;
      const float length = distances.at(cellBeside(cell, direction)) + static_cast<float>(moveLength(direction));
      if (length >= best_length) continue;
      best = direction;
      best_length = length;
    }
    ++(best % 2 == 0 ? straight : diagonal);
    cell = cellBeside(cell, best);
  }
  return lengthOfMoves(straight, diagonal);
}

class Draw {
 public:
  Draw(const PassableGrid& grid, const std::string& map_name, std::uint64_t seed)
      : grid_(grid), map_name_(map_name), random_(seed) {
    for (const CellIndex cell : grid.cells()) {
      if (grid.passable(cell)) cells_.push_back(cell);
    }
  }

  bool possible() const { return cells_.size() > 1; }

  /// Adds at most one scenario to every bucket that is not full. Returns whether all buckets that were ever met are.
  bool addGoal(std::size_t per_bucket) {
    const CellIndex goal = cells_[uniformIndex(random_, cells_.size())];
    const GridDistances distances(grid_, goal, CornerCutting::kForbidden);
    for (const Candidate& candidate : drawStarts(distances, goal, per_bucket)) {
      if (candidate.seen == 0) continue;
      const double length = lengthOfPath(grid_, distances, candidate.start, goal);
      const auto bucket = static_cast<std::size_t>(length / kBucketLength);
      if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
      if (buckets_[bucket].size() >= per_bucket) continue;  // a rounded distance had it in the bucket beside
      buckets_[bucket].push_back(
          {static_cast<int>(bucket), map_name_, grid_.columns(), grid_.rows(), candidate.start, goal, length});
    }
    return std::all_of(buckets_.begin(), buckets_.end(),
                       [&](const std::vector<Scenario>& bucket) { return bucket.size() >= per_bucket; });
  }

  std::vector<Scenario> scenarios() const {
    std::vector<Scenario> all;
    for (const std::vector<Scenario>& bucket : buckets_) all.insert(all.end(), bucket.begin(), bucket.end());
    return all;
  }

 private:
  /// A start drawn from one bucket's cells, of which `seen` were seen so far.
  struct Candidate {
    std::size_t seen = 0;
    CellIndex start;
  };

  std::vector<Candidate> drawStarts(const GridDistances& distances, CellIndex goal, std::size_t per_bucket) {
    std::vector<Candidate> candidates;
    for (const CellIndex cell : cells_) {
      const float length = distances.at(cell);
      if (!std::isfinite(length) || cell == goal) continue;
      const auto bucket = static_cast<std::size_t>(length / static_cast<float>(kBucketLength));
      if (bucket < buckets_.size() && buckets_[bucket].size() >= per_bucket) continue;
      if (bucket >= candidates.size()) candidates.resize(bucket + 1);
      Candidate& candidate = candidates[bucket];
      if (uniformIndex(random_, ++candidate.seen) == 0) candidate.start = cell;  // each with the same probability
    }
    return candidates;
  }

  const PassableGrid& grid_;
  std::string map_name_;
  Random random_;
  std::vector<CellIndex> cells_;
  std::vector<std::vector<Scenario>> buckets_;
};

}  // namespace

void validate(const ScenarioDrawParameters& parameters) {
  constexpr int kMost = 10000;
  checkParameter(parameters.per_bucket >= 1 && parameters.per_bucket <= kMost, "per_bucket", parameters.per_bucket,
                 "a number from 1 to 10000");
}

std::vector<Scenario> drawScenarios(const PassableGrid& grid, const std::string& map_name,
                                    const ScenarioDrawParameters& parameters, std::uint64_t seed,
                                    const std::function<void(double)>& progress) {
  validate(parameters);
  Draw draw(grid, map_name, seed);
  if (!draw.possible()) return {};
  const int most_goals = kGoalsPerScenario * parameters.per_bucket;
  for (int goals = 1; goals <= most_goals; ++goals) {
    const bool complete = draw.addGoal(static_cast<std::size_t>(parameters.per_bucket));
    if (progress) progress(static_cast<double>(goals) / most_goals);
    if (complete && goals >= parameters.per_bucket) break;
  }
  return draw.scenarios();
}

}  // namespace lstm_planner
