#include "tools/dataset_report.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <vector>

#include "lstm_planner/common/gnuplot.hpp"
#include "lstm_planner/common/scratch_folder.hpp"
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

template <typename Work>
void forEachDrive(const Dataset& dataset, Work&& work) {
  for (std::size_t i = 0; i < dataset.recordings.size(); ++i) {
    for (const RecordedEpisode& episode : dataset.recordings[i].episodes) {
      if (!episode.episode.discarded && !episode.steps.empty()) work(i, episode);
    }
  }
}

void writeLabels(const std::string& path, const DatasetSummary& summary) {
  std::ofstream file(path);
  for (const LabelHistogram& labels : summary.labels) {
    for (std::size_t i = 0; i < labels.counts.size(); ++i) {
      file << std::round(labels.angles[i] * 180.0 / M_PI) << " " << labels.counts[i] << "\n";
    }
  }
}

/// How many sectors have a mean range in each quarter of a metre.
void writeRanges(const std::string& path, const Dataset& dataset) {
  constexpr double kBin = 0.25;  // m
  std::map<long, long> counts;
  forEachDrive(dataset, [&](std::size_t, const RecordedEpisode& episode) {
    for (const DriveStep& step : episode.steps) {
      for (const double range : step.observation.sector_ranges) ++counts[std::lround(std::floor(range / kBin))];
    }
  });
  std::ofstream file(path);
  for (const auto& [bin, count] : counts) file << (static_cast<double>(bin) + 0.5) * kBin << " " << count << "\n";
}

/// A block of lines for each drive, with the number of its recording, and the first and last line of each for the
/// marks.
void writePaths(const std::string& path, const std::string& ends_path, const Dataset& dataset) {
  std::ofstream file(path);
  std::ofstream ends(ends_path);
  forEachDrive(dataset, [&](std::size_t recording, const RecordedEpisode& episode) {
    const auto number = recording + 1;
    for (const DriveStep& step : episode.steps) file << step.pose.x << " " << step.pose.y << " " << number << "\n";
    const DriveStep& last = episode.steps.back();
    file << last.next_pose.x << " " << last.next_pose.y << " " << number << "\n\n";
    const Pose2& first = episode.steps.front().pose;
    ends << first.x << " " << first.y << " " << last.goal.x << " " << last.goal.y << " " << number << "\n";
  });
}

std::string scriptOf(const ScratchFolder& scratch) {
  const auto data = [&](const char* name) { return quotedForGnuplot(scratch / name); };
  std::ostringstream script;
  script << "set multiplot; set grid; set style fill solid 0.7; unset key; "
         << "set origin 0,0.5; set size 0.4,0.5; set title 'labels'; set xlabel 'steering angle [deg]'; "
         << "set ylabel 'steps'; set yrange [0:*]; set offsets graph 0.1, graph 0.1, graph 0.1, 0; set boxwidth 0.7 "
            "relative; "
         << "plot " << data("labels")
         << " using 1:2:xtic(1) with boxes lc rgb '#4472a8', '' using 1:2:2 with labels offset 0,0.7; "
         << "set origin 0,0; set size 0.4,0.5; set title 'mean ranges of the sectors'; set xlabel 'range [m]'; "
         << "set ylabel 'sectors'; set offsets 0, 0, graph 0.05, 0; set boxwidth 0.25 absolute; set xrange [0:*]; "
         << "plot " << data("ranges") << " using 1:2 with boxes lc rgb '#6aa84f'; "
         << "set origin 0.4,0; set size 0.6,1; set title 'driven paths, by recording'; set xlabel 'x [m]'; "
         << "set ylabel 'y [m]'; set autoscale; set size ratio -1; set offsets graph 0.05, graph 0.05, graph 0.05, "
            "graph 0.05; "
         << "set key below; "
         << "plot " << data("paths") << " using 1:2:3 with lines lc variable lw 1.5 title 'path', " << data("ends")
         << " using 1:2 with points pt 6 ps 1 lc rgb '#404040' title 'start', " << data("ends")
         << " using 3:4 with points pt 2 ps 1.5 lw 2 lc rgb '#d02020' title 'goal'; unset multiplot";
  return script.str();
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

void drawDataset(const std::string& path, const Dataset& dataset) {
  if (stepCount(dataset) == 0) throw std::runtime_error("picture '" + path + "': the dataset has no steps to draw");
  const ScratchFolder scratch("dataset");
  writeLabels(scratch / "labels", summarise(dataset));
  writeRanges(scratch / "ranges", dataset);
  writePaths(scratch / "paths", scratch / "ends", dataset);
  runGnuplot("picture", path, scratch / "paths", "1400,800", scriptOf(scratch));
}

}  // namespace lstm_planner
