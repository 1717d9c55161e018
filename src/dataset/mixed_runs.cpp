#include "lstm_planner/dataset/mixed_runs.hpp"

#include <algorithm>

#include "lstm_planner/drive/perception/odometry_jump.hpp"

namespace lstm_planner {

namespace {

constexpr double kSilence = 1.0;   // s without a message, after which a run has ended
constexpr int kLongestInARow = 3;  // messages of one run that lie between those of another: rates may differ
constexpr int kChanges = 20;       // from one run to another and back, in one go: less may be faults of a driver

/// Finds out to which run each message belongs.
class Runs {
 public:
  explicit Runs(double max_speed) : max_speed_(max_speed) {}

  /// Whether the message goes on with another run than the message before.
  bool changesWith(const OdometryHeard& heard) {
    const auto has_ended = [&](const OdometryHeard& newest) {
      return heard.stamp < newest.stamp || heard.stamp - newest.stamp > kSilence;
    };
    newest_.erase(std::remove_if(newest_.begin(), newest_.end(), has_ended), newest_.end());
    const auto goes_on = [&](const OdometryHeard& newest) {
      return !isOdometryJump(newest.pose, heard.pose, heard.stamp - newest.stamp, max_speed_);
    };
    const auto run = std::find_if(newest_.rbegin(), newest_.rend(), goes_on);
    const bool is_known = run != newest_.rend();
    const bool is_last = run == newest_.rbegin();
    if (is_known) newest_.erase(std::next(run).base());
    newest_.push_back(heard);
    return is_known && !is_last;
  }

 private:
  double max_speed_;
  std::vector<OdometryHeard> newest_;  ///< of each run, the run of the last message at the end
};

}  // namespace

std::optional<std::pair<double, double>> mixedRuns(const std::vector<OdometryHeard>& path, double max_speed) {
  std::optional<std::pair<double, double>> mixed;
  Runs runs(max_speed);
  int changes = 0;
  int in_a_row = 0;
  double first = 0.0;
  for (const OdometryHeard& heard : path) {
    if (!runs.changesWith(heard)) {
      if (++in_a_row > kLongestInARow) changes = 0;
      continue;
    }
    in_a_row = 1;
    if (changes++ == 0) first = heard.stamp;
    if (changes >= kChanges) mixed = {mixed ? mixed->first : first, heard.stamp};
  }
  return mixed;
}

}  // namespace lstm_planner
