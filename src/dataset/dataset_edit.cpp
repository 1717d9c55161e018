#include "lstm_planner/dataset/dataset_edit.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

namespace {

std::string textOf(const std::vector<double>& angles) {
  std::ostringstream text;
  for (const double angle : angles) text << (text.tellp() > 0 ? ", " : "") << angle;
  return text.str();
}

bool isSameStep(const DriveStep& a, const DriveStep& b) {
  return a.stamp == b.stamp && a.pose.x == b.pose.x && a.pose.y == b.pose.y && a.pose.yaw == b.pose.yaw &&
         a.observation.sector_ranges == b.observation.sector_ranges;
}

/// Of a drive that is in two datasets one may have been copied while it went on.
bool isSameDrive(const RecordedEpisode& a, const RecordedEpisode& b) {
  const std::size_t common = std::min(a.steps.size(), b.steps.size());
  return std::equal(a.steps.begin(), a.steps.begin() + static_cast<std::ptrdiff_t>(common), b.steps.begin(),
                    isSameStep);
}

/// Finds episodes that come a second time.
class KnownDrives {
 public:
  void add(const RecordedEpisode& episode, const std::string& path) {
    if (episode.steps.empty()) return;
    const DriveStep& first = episode.steps.front();
    const auto key = std::make_tuple(first.stamp, first.pose.x, first.pose.y);
    const auto [begin, end] = known_.equal_range(key);
    for (auto known = begin; known != end; ++known) {
      if (!isSameDrive(*known->second.first, episode)) continue;
      std::ostringstream sentence;
      sentence.precision(12);
      sentence << "the drive that starts at " << first.stamp << " s is in '" << known->second.second << "' and in '"
               << path << "'; a dataset holds it once";
      throw DatasetError(sentence.str());
    }
    known_.emplace(key, std::make_pair(&episode, path));
  }

 private:
  std::multimap<std::tuple<double, double, double>, std::pair<const RecordedEpisode*, std::string>> known_;
};

bool isToLearnFrom(const RecordedEpisode& episode) { return !episode.episode.discarded && !episode.steps.empty(); }

/// Recording and episode.
using EpisodeIndex = std::pair<std::size_t, std::size_t>;

double sizeOf(const Dataset& dataset, const EpisodeIndex& index) {
  return static_cast<double>(dataset.recordings[index.first].episodes[index.second].steps.size());
}

std::vector<EpisodeIndex> drawValidationEpisodes(const Dataset& dataset, double share, std::uint64_t seed) {
  std::vector<EpisodeIndex> all;
  for (std::size_t i = 0; i < dataset.recordings.size(); ++i) {
    for (std::size_t k = 0; k < dataset.recordings[i].episodes.size(); ++k) {
      if (isToLearnFrom(dataset.recordings[i].episodes[k])) all.emplace_back(i, k);
    }
  }
  if (all.size() < 2) {
    throw std::invalid_argument("a dataset with " + std::to_string(all.size()) +
                                " episodes cannot be split, expected at least 2 with steps");
  }
  Random random(seed);
  shuffle(&all, random);
  const double wanted = share * static_cast<double>(stepCount(dataset));
  double taken = 0.0;
  std::vector<EpisodeIndex> chosen;
  std::vector<EpisodeIndex> others;
  for (const EpisodeIndex& index : all) {
    const double more = sizeOf(dataset, index);
    const bool fits = taken + more <= wanted && chosen.size() + 1 < all.size();
    (fits ? chosen : others).push_back(index);
    if (fits) taken += more;
  }
  const auto smallest = std::min_element(
      others.begin(), others.end(),
      [&](const EpisodeIndex& a, const EpisodeIndex& b) { return sizeOf(dataset, a) < sizeOf(dataset, b); });
  const bool is_nearer = taken + sizeOf(dataset, *smallest) - wanted < wanted - taken;
  if (chosen.empty() || (is_nearer && others.size() > 1)) chosen.push_back(*smallest);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

Dataset mergeDatasets(const std::vector<std::string>& paths) {
  std::vector<Dataset> datasets;
  datasets.reserve(paths.size());
  for (const std::string& path : paths) datasets.push_back(readDataset(path, true));
  KnownDrives known;
  const std::vector<double>* angles = nullptr;
  std::string path_of_angles;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (const Recording& recording : datasets[i].recordings) {
      const std::vector<double>& its_angles = recording.description.parameters.action_angles;
      if (angles != nullptr && its_angles != *angles) {
        throw DatasetError("the labels of '" + paths[i] + "' stand for the angles " + textOf(its_angles) +
                           " rad, those of '" + path_of_angles + "' for " + textOf(*angles));
      }
      if (angles == nullptr) path_of_angles = paths[i];
      angles = &its_angles;
      for (const RecordedEpisode& episode : recording.episodes) known.add(episode, paths[i]);
    }
  }
  Dataset merged;
  for (Dataset& dataset : datasets) {
    std::move(dataset.recordings.begin(), dataset.recordings.end(), std::back_inserter(merged.recordings));
  }
  return merged;
}

DatasetSplit splitDataset(const Dataset& dataset, double share, std::uint64_t seed) {
  if (!(share > 0.0 && share < 1.0)) {
    throw std::invalid_argument("the share of the validation set is " + numberText(share) +
                                ", expected more than 0 and less than 1");
  }
  const std::vector<EpisodeIndex> chosen = drawValidationEpisodes(dataset, share, seed);
  DatasetSplit split;
  for (std::size_t i = 0; i < dataset.recordings.size(); ++i) {
    const Recording& recording = dataset.recordings[i];
    Recording training{recording.description, recording.finished, recording.rejections, {}};
    Recording validation{recording.description, recording.finished, {}, {}};
    for (std::size_t k = 0; k < recording.episodes.size(); ++k) {
      const bool is_chosen = std::binary_search(chosen.begin(), chosen.end(), EpisodeIndex(i, k));
      (is_chosen ? validation : training).episodes.push_back(recording.episodes[k]);
    }
    split.training.recordings.push_back(std::move(training));
    if (!validation.episodes.empty()) split.validation.recordings.push_back(std::move(validation));
  }
  return split;
}

}  // namespace lstm_planner
