#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <type_traits>

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

/// An episode and which task it is of.
struct TaskEpisode {
  std::size_t task = 0;
  GridEpisode episode;
};
static_assert(std::is_trivially_copyable_v<TaskEpisode>, "episodes are sent as bytes");

/// The tasks [first, last), which threads of all ranks run batch by batch.
class SharedTasks {
 public:
  SharedTasks(const GridTaskSet& set, std::size_t first, std::size_t last, const GridAgentMaker& make_agent,
              const GridEvaluationOptions& options, std::size_t threads)
      : set_(set),
        make_agent_(make_agent),
        options_(options),
        batches_(batchesOf(set, first, last, threads * static_cast<std::size_t>(options.communicator->size()))),
        tickets_(options.communicator->tickets(batches_.size())),
        tables_(set) {}

  /// One thread's part.
  void run(bool tells_progress, std::vector<TaskEpisode>* episodes) {
    std::shared_ptr<const RangeTable> ranges;  // kept until the next batch has its own, which may be the same
    for (std::size_t drawn = tickets_->draw(); drawn < batches_.size(); drawn = tickets_->draw()) {
      const Batch& batch = batches_[drawn];
      ranges = tables_.take(set_.tasks[batch.first].map);
      for (std::size_t i = batch.last; i-- > batch.first;) {
        episodes->push_back({i, episodeOf(set_.tasks[i], *ranges)});
        tickets_->letOthersDraw();
        if (tells_progress && options_.progress) options_.progress(shareDone(i));
      }
    }
  }

 private:
  GridEpisode episodeOf(const GridTask& task, const RangeTable& ranges) const {
    const PassableGrid& grid = set_.maps[task.map];
    const std::unique_ptr<GridAgent> agent = make_agent_(grid);
    GridEpisode episode = runGridEpisode(grid, ranges, task.start, task.goal, options_.rules, agent.get());
    episode.optimal_length = task.optimal_length;
    return episode;
  }

  /// With this task, as the last ones are run first.
  double shareDone(std::size_t task) const {
    const std::size_t last = batches_.front().last;
    return static_cast<double>(last - task) / static_cast<double>(last - batches_.back().first);
  }

  const GridTaskSet& set_;
  const GridAgentMaker& make_agent_;
  const GridEvaluationOptions& options_;
  std::vector<Batch> batches_;
  std::unique_ptr<Tickets> tickets_;
  RangeTables tables_;
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
  const int threads = std::max(1, options.threads);
  SharedTasks tasks(set, first, last, make_agent, options, static_cast<std::size_t>(threads));
  std::vector<std::vector<TaskEpisode>> by_thread(static_cast<std::size_t>(threads));
  parallelFor(threads, threads,
              [&](int part, int thread) { tasks.run(thread == 0, &by_thread[static_cast<std::size_t>(part)]); });
  std::vector<TaskEpisode> own;
  for (const auto& part : by_thread) own.insert(own.end(), part.begin(), part.end());
  std::vector<GridEpisode> episodes(last - first);
  for (const TaskEpisode& done : gatherFromRanks(options.communicator, own)) episodes[done.task - first] = done.episode;
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
