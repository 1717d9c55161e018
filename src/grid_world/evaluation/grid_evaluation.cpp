#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/common/quantile.hpp"

namespace lstm_planner {
namespace {

/// Tasks that a thread runs one after another, all in one map, whose range table is costly.
struct Batch {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Tasks [first, last) in the order in which they are run: the last ones first, as they are sorted by length in the
/// benchmark's files and nobody is to wait for a long one at the end; and ever smaller batches.
std::vector<Batch> batchesOf(const GridTaskSet& set, std::size_t first, std::size_t last, std::size_t workers) {
  constexpr std::size_t kLargest = 512;
  constexpr std::size_t kBatchesAWorker = 8;  // of what is left
  std::vector<Batch> batches;
  while (last > first) {
    const std::size_t wanted = std::clamp<std::size_t>((last - first) / (kBatchesAWorker * workers), 1, kLargest);
    std::size_t begin = last - 1;
    while (begin > first && last - begin < wanted && set.tasks[begin - 1].map == set.tasks[begin].map) --begin;
    batches.push_back({begin, last});
    last = begin;
  }
  return batches;
}

/// Range tables of the maps in which threads are at work: a set of a hundred maps needs no more memory than these.
class RangeTables {
 public:
  explicit RangeTables(const GridTaskSet& set) : set_(set), entries_(set.maps.size()) {}
  std::shared_ptr<const RangeTable> take(std::size_t map) {
    Entry& entry = entries_[map];
    const std::lock_guard<std::mutex> lock(entry.mutex);
    std::shared_ptr<const RangeTable> table = entry.table.lock();
    if (!table) {
      table = std::make_shared<RangeTable>(set_.maps[map]);
      entry.table = table;
    }
    return table;
  }

 private:
  struct Entry {
    std::mutex mutex;
    std::weak_ptr<const RangeTable> table;
  };
  const GridTaskSet& set_;
  std::vector<Entry> entries_;
};

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
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
  if (first > last || last > set.tasks.size()) {
    throw std::invalid_argument("the tasks from " + std::to_string(first) + " to " + std::to_string(last) +
                                " are to be run, expected a range of the set's " + std::to_string(set.tasks.size()));
  }
  const int threads = std::max(1, options.threads);
  const std::vector<Batch> batches = batchesOf(set, first, last, static_cast<std::size_t>(threads));
  RangeTables tables(set);
  // Each thread's is kept until its next batch has its own, which may be the same.
  std::vector<std::shared_ptr<const RangeTable>> ranges(static_cast<std::size_t>(threads));
  std::vector<GridEpisode> episodes(last - first);
  parallelFor(static_cast<int>(batches.size()), threads, [&](int index, int thread) {
    const Batch& batch = batches[static_cast<std::size_t>(index)];
    const std::size_t map = set.tasks[batch.first].map;
    std::shared_ptr<const RangeTable>& own_ranges = ranges[static_cast<std::size_t>(thread)];
    own_ranges = tables.take(map);
    for (std::size_t i = batch.last; i-- > batch.first;) {
      const GridTask& task = set.tasks[i];
      const std::unique_ptr<GridAgent> agent = make_agent(set.maps[map]);
      GridEpisode& episode = episodes[i - first];
      episode = runGridEpisode(set.maps[map], *own_ranges, task.start, task.goal, options.rules, agent.get());
      episode.optimal_length = task.optimal_length;
      // The last tasks are run first.
      if (thread == 0 && options.progress) {
        options.progress(static_cast<double>(last - i) / static_cast<double>(last - first));
      }
    }
  });
  return episodes;
}

namespace {

/// Who decided, over all episodes.
void addDecisions(const std::vector<GridEpisode>& episodes, GridSetSummary* summary) {
  double steps = 0.0;
  for (const GridEpisode& episode : episodes) steps += static_cast<double>(episode.steps());
  const auto share = [&](std::int64_t count) { return static_cast<double>(count) / std::max(1.0, steps); };
  for (const GridEpisode& episode : episodes) {
    for (std::size_t i = 0; i < summary->led.size(); ++i) summary->led[i] += share(episode.led[i]);
    summary->on_path += share(episode.on_path);
    summary->overruled_by_shield += share(episode.overruled_by_shield);
    summary->overruled_by_bound += share(episode.overruled_by_bound);
  }
}

}  // namespace

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
    summary.no_path += episode.end == GridEpisode::End::kNoPath ? 1 : 0;
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
  addDecisions(episodes, &summary);
  return summary;
}

}  // namespace lstm_planner
