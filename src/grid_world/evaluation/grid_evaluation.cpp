#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <type_traits>

#include "lstm_planner/base/common/parallel_for.hpp"
#include "lstm_planner/base/common/quantile.hpp"

namespace lstm_planner {
namespace {

/// Tasks [first, last), dealt to ranks in blocks: those beside each other share a map, whose range table is costly, and
/// as they are sorted by length in the benchmark's files, each rank gets many blocks.
std::vector<std::vector<std::size_t>> dealTasks(std::size_t first, std::size_t last, int ranks) {
  constexpr std::size_t kBlocksARank = 16;
  std::vector<std::vector<std::size_t>> hands(static_cast<std::size_t>(ranks));
  const std::size_t block = std::max<std::size_t>(1, (last - first) / (kBlocksARank * hands.size()));
  for (std::size_t i = first; i < last; ++i) hands[(i - first) / block % hands.size()].push_back(i);
  return hands;
}

/// Range tables of the maps in use: made by the first task of a map, dropped after its last, so that a set of a hundred
/// maps needs no more memory than the few that are being run in.
class RangeTables {
 public:
  RangeTables(const GridTaskSet& set, const std::vector<std::size_t>& tasks) : set_(set), entries_(set.maps.size()) {
    for (const std::size_t i : tasks) ++entries_[set.tasks[i].map].tasks_left;
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

/// The episodes of these tasks, in their order.
std::vector<GridEpisode> runTasks(const GridTaskSet& set, const std::vector<std::size_t>& tasks,
                                  const GridAgentMaker& make_agent, const GridEvaluationOptions& options) {
  RangeTables tables(set, tasks);
  std::vector<GridEpisode> episodes(tasks.size());
  std::atomic<std::size_t> done{0};
  parallelFor(static_cast<int>(tasks.size()), options.threads, [&](int index, int thread) {
    const auto i = static_cast<std::size_t>(index);
    const GridTask& task = set.tasks[tasks[i]];
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
  static_assert(std::is_trivially_copyable_v<GridEpisode>, "episodes are sent as bytes");
  Communicator& ranks = *options.communicator;
  const std::vector<std::vector<std::size_t>> hands = dealTasks(first, last, ranks.size());
  std::vector<GridEpisode> by_rank(last - first);
  std::vector<std::size_t> bytes;
  auto next = by_rank.begin();
  for (std::size_t rank = 0; rank < hands.size(); ++rank) {
    bytes.push_back(hands[rank].size() * sizeof(GridEpisode));
    if (static_cast<int>(rank) == ranks.rank()) {
      const std::vector<GridEpisode> own = runTasks(set, hands[rank], make_agent, options);
      std::copy(own.begin(), own.end(), next);
    }
    next += static_cast<std::ptrdiff_t>(hands[rank].size());
  }
  ranks.exchangeBytes(by_rank.data(), bytes);
  std::vector<GridEpisode> episodes(by_rank.size());
  next = by_rank.begin();
  for (const std::vector<std::size_t>& hand : hands) {
    for (const std::size_t i : hand) episodes[i - first] = *next++;
  }
  return episodes;
}

namespace {

/// What led, over all episodes.
void addLeaders(const std::vector<GridEpisode>& episodes, GridSetSummary* summary) {
  double steps = 0.0;
  double as_searched = 0.0;
  for (const GridEpisode& episode : episodes) {
    steps += static_cast<double>(episode.steps());
    as_searched += static_cast<double>(episode.as_searched);
    for (std::size_t i = 0; i < summary->led.size(); ++i) summary->led[i] += static_cast<double>(episode.led[i]);
  }
  summary->as_searched = as_searched / summary->led[static_cast<std::size_t>(GridLeader::kNetwork)];
  for (double& share : summary->led) share /= std::max(1.0, steps);
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
  addLeaders(episodes, &summary);
  return summary;
}

}  // namespace lstm_planner
