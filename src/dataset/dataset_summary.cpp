#include "lstm_planner/dataset/dataset_summary.hpp"

#include <algorithm>
#include <cmath>

#include "dataset/step_quantities.hpp"

namespace lstm_planner {

namespace {

void add(double number, QuantityRange* range) {
  if (!std::isfinite(number)) return;
  range->minimum = range->count == 0 ? number : std::min(range->minimum, number);
  range->maximum = range->count == 0 ? number : std::max(range->maximum, number);
  ++range->count;
  range->mean += (number - range->mean) / static_cast<double>(range->count);
}

/// Adds the numbers of a step to the ranges of its quantities, which are made at the first step.
class RangeCollector {
 public:
  explicit RangeCollector(std::vector<QuantityRange>* ranges) : ranges_(*ranges) {}

  void add(const DriveStep& step) {
    next_ = 0;
    visitQuantities(
        step, [this](const std::string& name, const char* unit, const auto& quantity) { visit(name, unit, quantity); });
  }

 private:
  template <typename Number>
  void visit(const std::string& name, const char* unit, const std::array<Number, kSectorCount>& numbers) {
    QuantityRange& range = rangeOf(name, unit);
    for (const Number number : numbers) lstm_planner::add(static_cast<double>(number), &range);
  }

  template <typename Quantity>
  void visit(const std::string& name, const char* unit, const Quantity& quantity) {
    visitNumbers(name, unit, quantity, [this](const std::string& column, const char* its_unit, const auto& number) {
      lstm_planner::add(static_cast<double>(number), &rangeOf(column, its_unit));
    });
  }

  QuantityRange& rangeOf(const std::string& name, const char* unit) {
    if (next_ == ranges_.size()) ranges_.push_back({name, unit});
    return ranges_[next_++];
  }

  std::vector<QuantityRange>& ranges_;
  std::size_t next_ = 0;
};

LabelHistogram& histogramOf(const std::vector<double>& angles, std::vector<LabelHistogram>* histograms) {
  const auto found = std::find_if(histograms->begin(), histograms->end(),
                                  [&](const LabelHistogram& histogram) { return histogram.angles == angles; });
  if (found != histograms->end()) return *found;
  histograms->push_back({angles, std::vector<long>(angles.size(), 0)});
  return histograms->back();
}

void add(const RecordedEpisode& episode, LabelHistogram* labels, RangeCollector* ranges, DatasetSummary* summary) {
  const auto steps = static_cast<long>(episode.steps.size());
  if (episode.episode.discarded) {
    ++summary->discarded_episodes;
    summary->discarded_steps += steps;
    return;
  }
  ++summary->episodes;
  ++summary->ends[episode.episode.end];
  summary->empty_episodes += steps == 0 ? 1 : 0;
  summary->steps += steps;
  long expected = 0;
  for (const DriveStep& step : episode.steps) {
    if (step.number != expected) ++summary->gaps;
    expected = step.number + 1;
    summary->steps_with_scan += step.ranges.empty() ? 0 : 1;
    const auto label = static_cast<std::size_t>(step.label);
    if (label < labels->counts.size()) ++labels->counts[label];
    ranges->add(step);
    add(step.next_stamp - step.stamp, &summary->intervals);
    summary->duration += step.next_stamp - step.stamp;
    summary->distance += distanceBetween(step.pose, step.next_pose);
  }
}

}  // namespace

DatasetSummary summarise(const Dataset& dataset) {
  DatasetSummary summary;
  summary.intervals.name = "interval";
  summary.intervals.unit = "s";
  RangeCollector ranges(&summary.ranges);
  for (const Recording& recording : dataset.recordings) {
    ++summary.recordings;
    summary.unfinished += recording.finished ? 0 : 1;
    for (std::size_t i = 0; i < summary.rejections.size(); ++i) summary.rejections[i] += recording.rejections[i];
    LabelHistogram& labels = histogramOf(recording.description.parameters.action_angles, &summary.labels);
    for (const RecordedEpisode& episode : recording.episodes) add(episode, &labels, &ranges, &summary);
  }
  return summary;
}

}  // namespace lstm_planner
