#include "lstm_planner/dataset/hindsight.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/perception/odometry_history.hpp"

namespace lstm_planner {

namespace {

/// Odometry from `first` to before `end`, without jump or gap.
struct Stretch {
  std::size_t first = 0;
  std::size_t end = 0;
};

/// One message of each moment: where stamps stand still, what stands would be looked at again and again.
std::vector<OdometryHeard> thinned(const std::vector<OdometryHeard>& path) {
  std::vector<OdometryHeard> thin;
  for (const OdometryHeard& heard : path) {
    if (thin.empty() || heard.stamp != thin.back().stamp) thin.push_back(heard);
  }
  return thin;
}

std::vector<Stretch> stretchesOf(const std::vector<OdometryHeard>& path, const RecorderParameters& recorder) {
  std::vector<Stretch> stretches;
  OdometryHistory history(recorder.max_speed);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const long jumps = history.jumps();
    history.add(path[i]);
    const bool follows = i > 0 && history.jumps() == jumps && path[i].stamp - path[i - 1].stamp <= recorder.max_gap;
    if (!follows) stretches.push_back({i, i});
    stretches.back().end = i + 1;
  }
  return stretches;
}

/// Finds the goals of one stretch.
class GoalFinder {
 public:
  GoalFinder(const std::vector<OdometryHeard>& path, const HindsightParameters& parameters,
             const RecorderParameters& recorder, const std::string& frame, std::vector<DriveEvent>* goals)
      : path_(path), parameters_(parameters), recorder_(recorder), frame_(frame), goals_(goals) {
    driven_.push_back(0.0);
    for (std::size_t i = 1; i < path.size(); ++i) {
      driven_.push_back(driven_.back() + distanceBetween(path[i - 1].pose, path[i].pose));
    }
  }

  void find(const Stretch& stretch) {
    std::size_t from = stretch.first;
    for (const std::size_t stop : stopsOf(stretch)) {
      const double length = pathBetween(from, stop);
      if (length >= parameters_.shortest) divide(from, stop);
      // After a short hop he is still on the way to the next place.
      if (length >= parameters_.shortest || length < recorder_.min_step_distance) from = stop;
    }
  }

 private:
  double pathBetween(std::size_t from, std::size_t to) const { return driven_[to] - driven_[from]; }

  bool hasMoved(std::size_t from, std::size_t to) const { return isStep(path_[from].pose, path_[to].pose, recorder_); }

  /// The last message before the robot left each place where it stood, and the end of the stretch.
  std::vector<std::size_t> stopsOf(const Stretch& stretch) const {
    std::vector<std::size_t> stops;
    std::size_t next = 0;  // where the robot had moved since the message before
    for (std::size_t i = stretch.first; i < stretch.end; ++i) {
      // Mostly it has moved there since this message, too, and there is no need to look at what lies between.
      const bool ends_early = i < next && next < stretch.end && hasMoved(i, next) &&
                              path_[next - 1].stamp - path_[i].stamp < parameters_.stop;
      if (ends_early) continue;
      std::size_t last = i;
      while (last + 1 < stretch.end && !hasMoved(i, last + 1)) ++last;
      next = last + 1;
      if (path_[last].stamp - path_[i].stamp < parameters_.stop && last + 1 < stretch.end) continue;
      stops.push_back(last);
      i = last;
    }
    return stops;
  }

  void divide(std::size_t from, std::size_t to) {
    while (pathBetween(from, to) >= parameters_.shortest) {
      const double parts = std::ceil(pathBetween(from, to) / parameters_.longest);
      const double length = std::max(pathBetween(from, to) / parts, parameters_.shortest);
      const std::size_t target = parts > 1.0 ? placeAfter(from, to, length) : to;
      const std::optional<std::size_t> goal = lastGoalUpTo(target, from);
      if (goal) add(from, *goal);
      from = goal ? *goal : placeAfter(from, to, parameters_.shortest);
    }
  }

  /// The first place after `length` (m) of path, or `to`.
  std::size_t placeAfter(std::size_t from, std::size_t to, double length) const {
    const auto begin = driven_.begin();
    const auto place = std::lower_bound(begin + static_cast<std::ptrdiff_t>(from),
                                        begin + static_cast<std::ptrdiff_t>(to), driven_[from] + length);
    return static_cast<std::size_t>(place - begin);
  }

  std::optional<std::size_t> lastGoalUpTo(std::size_t target, std::size_t from) const {
    for (std::size_t place = target; pathBetween(from, place) >= parameters_.shortest; --place) {
      if (!isPassed(place, from)) return place;
    }
    return std::nullopt;
  }

  /// Whether the robot was there already before it came to stay.
  bool isPassed(std::size_t place, std::size_t from) const {
    const auto near = [&](std::size_t i) {
      return distanceBetween(path_[i].pose, path_[place].pose) <= recorder_.goal_tolerance;
    };
    std::size_t i = place;
    while (i > from && near(i)) --i;
    while (i > from && !near(i)) --i;
    return near(i);
  }

  void add(std::size_t from, std::size_t to) {
    const GoalHeard goal{path_[from].stamp, {frame_, path_[to].pose}, "hindsight"};
    goals_->emplace_back(goal);
    goals_->emplace_back(GoalGivenUp{path_[to].stamp});
  }

  const std::vector<OdometryHeard>& path_;
  const HindsightParameters& parameters_;
  const RecorderParameters& recorder_;
  const std::string& frame_;
  std::vector<DriveEvent>* goals_;
  std::vector<double> driven_;  ///< m, until each place of the path
};

}  // namespace

void validate(const HindsightParameters& parameters) {
  visitHindsightParameters(parameters, RangeCheck());
  checkParameter(parameters.longest >= parameters.shortest, "longest", parameters.longest,
                 "at least shortest = " + numberText(parameters.shortest));
}

std::vector<DriveEvent> hindsightGoals(const std::vector<OdometryHeard>& messages,
                                       const HindsightParameters& parameters, const RecorderParameters& recorder,
                                       const std::string& frame) {
  validate(parameters);
  checkParameter(parameters.shortest > recorder.goal_tolerance, "shortest", parameters.shortest,
                 "more than the goal tolerance of " + numberText(recorder.goal_tolerance));
  const std::vector<OdometryHeard> path = thinned(messages);
  std::vector<DriveEvent> goals;
  GoalFinder finder(path, parameters, recorder, frame, &goals);
  for (const Stretch& stretch : stretchesOf(path, recorder)) finder.find(stretch);
  return goals;
}

void GoalSchedule::tell(double stamp, DriveRecorder* recorder) {
  // Stamps far ahead are those of another clock: the robot's was set.
  while (next_ < goals_.size() && stampOf(goals_[next_]) <= stamp && stamp - stampOf(goals_[next_]) <= max_gap_) {
    recorder->add(goals_[next_++]);
  }
}

}  // namespace lstm_planner
