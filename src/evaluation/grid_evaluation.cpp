#include "lstm_planner/evaluation/grid_evaluation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "learning/parallel_for.hpp"

namespace lstm_planner {
namespace {

/// Range tables of the maps in use: made by the first task of a map, dropped after its last, so that a set of a hundred
/// maps needs no more memory than the few that are being run in.
class RangeTables {
 public:
  RangeTables(const GridTaskSet& set, std::size_t first, std::size_t last) : set_(set), entries_(set.maps.size()) {
    for (std::size_t i = first; i < last; ++i) ++entries_[set.tasks[i].map].tasks_left;
  }
  std::shared_ptr<const RangeTable> take(std::size_t map) {
    Entry& entry = entries_[map];
    const std::lock_guard<std::mutex> lock(entry.mutex);
    if (!entry.table) entry.table = std::make_shared<RangeTable>(set_.maps[map]);
    std::shared_ptr<const RangeTable> table = entry.table;
    if (--entry.tasks_left == 0) entry.table.reset();
    return table;
  }

 private:
  struct Entry {
    std::mutex mutex;
    std::size_t tasks_left = 0;
    std::shared_ptr<const RangeTable> table;
  };
  const GridTaskSet& set_;
  std::vector<Entry> entries_;
};

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// By nearest rank; not a number for no values.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto place = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

template <typename Value>
std::vector<double> ofArrived(const std::vector<GridEpisode>& episodes, const Value& value) {
  std::vector<double> values;
  for (const GridEpisode& episode : episodes) {
    if (episode.end == GridEpisode::End::kArrived) values.push_back(static_cast<double>(value(episode)));
  }
  return values;
}

}  // namespace

std::vector<GridEpisode> evaluateGridTasks(const GridTaskSet& set, std::size_t first, std::size_t last,
                                           const GridAgentMaker& make_agent, const GridEvaluationOptions& options) {
  RangeTables tables(set, first, last);
  std::vector<GridEpisode> episodes(last - first);
  std::atomic<std::size_t> done{0};
  parallelFor(static_cast<int>(episodes.size()), options.threads, [&](int index, int thread) {
    const auto i = static_cast<std::size_t>(index);
    const GridTask& task = set.tasks[first + i];
    const PassableGrid& grid = set.maps[task.map];
    const std::shared_ptr<const RangeTable> ranges = tables.take(task.map);
    const std::unique_ptr<GridAgent> agent = make_agent(grid);
    episodes[i] = runGridEpisode(grid, *ranges, task.start, task.goal, options.rules, agent.get());
    episodes[i].optimal_length = task.optimal_length;
    ++done;
    if (thread == 0 && options.progress) {
      options.progress(static_cast<double>(done) / static_cast<double>(episodes.size()));
    }
  });
  return episodes;
}

GridSetSummary summarizeGridEpisodes(const std::string& name, const std::vector<GridEpisode>& episodes) {
  if (episodes.empty()) throw std::invalid_argument("set " + name + " has no episodes, expected at least one");
  GridSetSummary summary;
  summary.name = name;
  summary.scenarios = episodes.size();
  double seconds = 0.0;
  double steps = 0.0;
  for (const GridEpisode& episode : episodes) {
    summary.arrived += episode.end == GridEpisode::End::kArrived ? 1 : 0;
    summary.collisions += episode.end == GridEpisode::End::kCollision ? 1 : 0;
    summary.timeouts += episode.end == GridEpisode::End::kTimeout ? 1 : 0;
    summary.no_way += episode.end == GridEpisode::End::kNoWay ? 1 : 0;
    summary.peak_bytes = std::max(summary.peak_bytes, episode.peak_bytes);
    seconds += episode.seconds;
    steps += static_cast<double>(episode.steps());
  }
  const std::vector<double> ratios = ofArrived(episodes, [](const GridEpisode& e) { return e.ratio(); });
  summary.mean_ratio = mean(ratios);
  summary.median_ratio = quantile(ratios, 0.5);
  summary.p95_ratio = quantile(ratios, 0.95);
  summary.mean_length = mean(ofArrived(episodes, [](const GridEpisode& e) { return e.length(); }));
  summary.mean_optimal = mean(ofArrived(episodes, [](const GridEpisode& e) { return e.optimal_length; }));
  summary.mean_time = mean(ofArrived(episodes, [](const GridEpisode& e) { return e.seconds; }));
  summary.mean_expanded = mean(ofArrived(episodes, [](const GridEpisode& e) { return e.expanded; }));
  summary.ns_per_step = steps > 0.0 ? 1e9 * seconds / steps : std::nan("");
  return summary;
}

}  // namespace lstm_planner
