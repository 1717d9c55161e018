#include "tools/dataset_report.hpp"

#include <cmath>
#include <cstdio>
#include <vector>

#include "lstm_planner/common/words.hpp"

namespace lstm_planner {

namespace {

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

double percent(long part, long whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string named(long count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

void printEpisodes(std::ostream& out, const DatasetSummary& summary) {
  out << named(summary.episodes, "episode") << (summary.ends.empty() ? "" : ": ") << endsText(summary);
  if (summary.empty_episodes > 0) out << "; " << summary.empty_episodes << " without a step";
  out << "\n";
  if (summary.discarded_episodes > 0) {
    out << named(summary.discarded_episodes, "discarded episode") << " of " << named(summary.discarded_steps, "step")
        << ", not counted here\n";
  }
}

void printRanges(std::ostream& out, const DatasetSummary& summary) {
  out << formatted("%-16s %12s %12s %12s %9s\n", "quantity", "smallest", "mean", "largest", "number");
  const auto print = [&](const QuantityRange& range) {
    out << formatted("%-16s %12.6g %12.6g %12.6g %9ld %s\n", range.name.c_str(), range.minimum, range.mean,
                     range.maximum, range.count, range.unit.c_str());
  };
  for (const QuantityRange& range : summary.ranges) print(range);
  print(summary.intervals);
}

}  // namespace

std::string endsText(const DatasetSummary& summary) {
  std::vector<std::string> words;
  for (const auto& [end, count] : summary.ends) words.push_back(std::to_string(count) + " " + toString(end));
  return joined(words);
}

void printLabels(std::ostream& out, const DatasetSummary& summary) {
  for (const LabelHistogram& labels : summary.labels) {
    long all = 0;
    for (const long count : labels.counts) all += count;
    out << "labels:";
    for (std::size_t i = 0; i < labels.counts.size(); ++i) {
      out << formatted("  %.0f deg %ld (%.1f %%)", labels.angles[i] * 180.0 / M_PI, labels.counts[i],
                       percent(labels.counts[i], all));
    }
    out << "\n";
  }
}

void printDatasetSummary(std::ostream& out, const DatasetSummary& summary) {
  out << named(summary.recordings, "recording");
  if (summary.unfinished > 0) out << ", " << summary.unfinished << " of them going on or cut off";
  out << "\n";
  printEpisodes(out, summary);
  out << named(summary.steps, "step") << ", " << summary.steps_with_scan << " with scan, "
      << formatted("%.1f min, %.1f m", summary.duration / 60.0, summary.distance);
  if (summary.gaps > 0) out << "; steps without a label were left out at " << named(summary.gaps, "place");
  out << "\n";
  printLabels(out, summary);
  const std::string rejected = textOf(summary.rejections);
  out << "rejected: " << (rejected.empty() ? "nothing" : rejected) << "\n";
  if (summary.steps > 0) printRanges(out, summary);
}

}  // namespace lstm_planner
