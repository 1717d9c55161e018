#pragma once

#include <map>
#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// How often each label was driven, in the recordings with the same allowed angles.
struct LabelHistogram {
  std::vector<double> angles;  ///< rad
  std::vector<long> counts;    ///< of each
};

/// Statistics of one quantity, over its numbers that are not infinite.
struct QuantityRange {
  std::string name;  ///< of the column in the table steps; for eight sectors without the sector's number
  std::string unit;
  long count = 0;
  double minimum = 0.0;
  double mean = 0.0;
  double maximum = 0.0;
};

/// What a dataset contains. Discarded episodes count only in the members named discarded_*.
struct DatasetSummary {
  long recordings = 0;
  long unfinished = 0;  ///< recordings that are still going on, or were cut off
  long episodes = 0;
  std::map<EpisodeEnd, long> ends;  ///< of the episodes
  long empty_episodes = 0;          ///< of the episodes, those without a step
  long discarded_episodes = 0;
  long discarded_steps = 0;
  long steps = 0;
  long steps_with_scan = 0;
  std::vector<LabelHistogram> labels;  ///< one for each set of allowed angles
  std::vector<QuantityRange> ranges;   ///< in the order of the columns
  QuantityRange intervals;             ///< s from a step to the next
  long gaps = 0;                       ///< places in episodes where steps without a label were left out
  double duration = 0.0;               ///< s of all steps together
  double distance = 0.0;               ///< m from pose to pose
  RejectionCounts rejections{};
};

/// Scans are counted only if they were read.
DatasetSummary summarise(const Dataset& dataset);

}  // namespace lstm_planner
