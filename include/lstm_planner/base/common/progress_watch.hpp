#pragma once

namespace lstm_planner {

/// Knows the least distance to a goal so far, and how many steps have been made since without coming nearer.
class ProgressWatch {
 public:
  /// `least`: by how much a distance must be less than the best one to be progress.
  explicit ProgressWatch(double least) : least_(least) {}

  /// Nothing is noted.
  void clear() {
    restart(0.0);
    has_best_ = false;
  }

  /// A step has ended at this distance: whether that is progress, as the first one is.
  bool note(double distance) {
    if (!has_best_ || distance < target()) {
      restart(distance);
      return true;
    }
    ++steps_;
    return false;
  }

  /// This distance is the best from now on, whatever was noted before.
  void restart(double distance) {
    best_ = distance;
    has_best_ = true;
    steps_ = 0;
  }

  /// The goal has moved, and with it the best distance; nothing else changes.
  void moveBest(double distance) { best_ = distance; }

  bool hasBest() const { return has_best_; }
  double best() const { return best_; }
  double target() const { return best_ - least_; }  ///< less than this is progress
  int steps() const { return steps_; }              ///< since the best

 private:
  double least_;
  double best_ = 0.0;
  int steps_ = 0;
  bool has_best_ = false;
};

/// The same, with the length of the path that was driven without coming nearer.
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
