#pragma once

namespace lstm_planner {

/// Keeps the least distance to a goal so far, and counts the steps since then.
class ProgressWatch {
 public:
  /// `least`: a distance is progress if it is less than the best one by more than this.
  explicit ProgressWatch(double least) : least_(least) {}

  /// Forgets everything.
  void clear() {
    restart(0.0);
    has_best_ = false;
  }

  /// Adds the distance at the end of a step. Returns whether it is progress; the first distance is.
  bool note(double distance) {
    if (!has_best_ || distance < target()) {
      restart(distance);
      return true;
    }
    ++steps_;
    return false;
  }

  /// Makes this distance the best one.
  void restart(double distance) {
    best_ = distance;
    has_best_ = true;
    steps_ = 0;
  }

  /// Changes the best distance only, because the goal has moved.
  void moveBest(double distance) { best_ = distance; }

  bool hasBest() const { return has_best_; }
  double best() const { return best_; }
  double target() const { return best_ - least_; }  ///< distances below this are progress
  int steps() const { return steps_; }              ///< since the best

 private:
  double least_;
  double best_ = 0.0;
  int steps_ = 0;
  bool has_best_ = false;
};

/// As ProgressWatch, and sums up the length of the path driven since the best distance.
class DrivenProgressWatch : public ProgressWatch {
 public:
  using ProgressWatch::ProgressWatch;

  void clear() {
    ProgressWatch::clear();
    driven_ = 0.0;
  }
  /// `driven`: length of the step.
  bool note(double distance, double driven) {
    const bool is_progress = ProgressWatch::note(distance);
    driven_ = is_progress ? 0.0 : driven_ + driven;
    return is_progress;
  }
  void restart(double distance) {
    ProgressWatch::restart(distance);
    driven_ = 0.0;
  }

  double driven() const { return driven_; }  ///< since the best

 private:
  double driven_ = 0.0;
};

}  // namespace lstm_planner
