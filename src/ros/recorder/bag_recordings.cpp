#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "lstm_planner/common/input_file.hpp"
#include "lstm_planner/ros/recorder/bag_drive.hpp"

namespace lstm_planner {
namespace {

namespace fs = std::filesystem;

// The last messages of a part are sometimes stamped after the first ones of the next.
constexpr double kOverlap = 1.0;  // s

struct TimedBag {
  std::string path;
  double begin = 0.0;  ///< s
  double end = 0.0;    ///< s; before `begin` where the bag is empty or cannot be read
};

/// Bags whose recording was cut off, too. Not the copy x.orig.bag that rosbag compress and reindex leave beside x.bag:
/// the same drive a second time.
bool isBag(const std::string& path) {
  const std::string copy = ".orig.bag";
  if (boost::algorithm::ends_with(path, copy) && fs::exists(path.substr(0, path.size() - copy.size()) + ".bag"))
    return false;
  return boost::algorithm::ends_with(path, ".bag") || boost::algorithm::ends_with(path, ".bag.active");
}

std::vector<std::string> bagsIn(const std::string& folder) {
  std::vector<std::string> bags;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (isBag(entry.path().string()) && entry.is_regular_file()) bags.push_back(entry.path().string());
  }
  if (bags.empty()) {
    const bool is_of_ros2 = fs::exists(fs::path(folder) / "metadata.yaml");
    throw std::invalid_argument("the folder " + folder + " holds no bags, expected files *.bag" +
                                (is_of_ros2 ? ": it is a recording of ROS 2, rosbags-convert makes a bag of it" : ""));
  }
  std::sort(bags.begin(), bags.end());
  return bags;
}

TimedBag timed(const std::string& path) {
  try {
    checkInputFile(path, std::numeric_limits<std::uintmax_t>::max());
    const rosbag::Bag bag(path, rosbag::bagmode::Read);
    rosbag::View view(bag);
    if (view.size() > 0) return {path, view.getBeginTime().toSec(), view.getEndTime().toSec()};
  } catch (const std::exception&) {
    // Whoever reads it says what is wrong.
  }
  return {path, 0.0, -1.0};
}

struct JoinedBags {
  BagParts parts;
  double end = 0.0;  ///< s
};

}  // namespace

std::vector<BagParts> bagRecordings(const std::vector<std::string>& paths, double max_gap) {
  std::vector<TimedBag> bags;
  for (const std::string& path : paths) {
    std::error_code error;  // what cannot be looked at is no folder
    const std::vector<std::string> files =
        fs::is_directory(path, error) ? bagsIn(path) : std::vector<std::string>{path};
    for (const std::string& file : files) {
      const auto isThis = [&](const TimedBag& bag) { return fs::equivalent(bag.path, file, error); };
      if (std::none_of(bags.begin(), bags.end(), isThis)) bags.push_back(timed(file));
    }
  }
  const auto readable_end =
      std::stable_partition(bags.begin(), bags.end(), [](const TimedBag& bag) { return bag.begin <= bag.end; });
  std::stable_sort(bags.begin(), readable_end, [](const TimedBag& a, const TimedBag& b) { return a.begin < b.begin; });

  std::vector<JoinedBags> recordings;
  for (auto bag = bags.begin(); bag != bags.end(); ++bag) {
    const auto distance = [&](const JoinedBags& joined) { return std::abs(bag->begin - joined.end); };
    const auto nearest = std::min_element(recordings.begin(), recordings.end(),
                                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    const bool goes_on = bag < readable_end && nearest != recordings.end() && bag->begin - nearest->end <= max_gap &&
                         bag->begin >= nearest->end - kOverlap;
    if (goes_on) {
      nearest->parts.push_back(bag->path);
      nearest->end = std::max(nearest->end, bag->end);
    } else {
      recordings.push_back({{bag->path}, bag->end});
    }
  }
  std::vector<BagParts> all;
  for (JoinedBags& joined : recordings) all.push_back(std::move(joined.parts));
  return all;
}

}  // namespace lstm_planner
