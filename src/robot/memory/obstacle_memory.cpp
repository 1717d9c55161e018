#include "lstm_planner/robot/memory/obstacle_memory.hpp"

#include "robot/perception/reach.hpp"

namespace lstm_planner {

namespace {

/// More changes than this since they were cleared count as everything.
constexpr std::size_t kMostChanges = 1024;

}  // namespace

ObstacleMemory::ObstacleMemory(const MemoryParameters& parameters, const ShieldParameters& shield)
    : footprint_radius_(shield.footprint_radius),
      window_(parameters.width, parameters.resolution),
      scan_changes_(parameters.reach, parameters.resolution),
      passability_(parameters, shield, window_) {
  changes_.reserve(kMostChanges);
  forget();
}

void ObstacleMemory::forget() {
  window_.clear();
  passability_.forget();
  everything_changed_ = true;
}

void ObstacleMemory::add(const Situation& situation) {
  if (!isInReach(situation.pose)) {
    return;
  }
  if (window_.moveTo(situation.pose)) {
    outdateAll();
  }
  passability_.beginChanges();
  scan_changes_.find(situation, window_);
  for (const std::uint32_t key : scan_changes_.seenThrough()) {
    set(squareOf(key), false);
  }
  for (std::size_t i = 0; i < scan_changes_.returnsCount(); ++i) {
    const Square square = squareOf(scan_changes_.returns()[i]);
    if (!window_.isOccupied(square)) {
      set(square, true);
    }
  }
  // Where the robot stands nothing else can be.
  forgetUnderneath(situation.pose);
}

void ObstacleMemory::block(const Point2& place) {
  if (const std::optional<Point2> oldest = passability_.block(window_, place)) {
    noteChange(*oldest, false);
  }
  noteChange(place, true);
}

void ObstacleMemory::squeeze(bool on) {
  if (passability_.squeeze(on)) {
    outdateAll();
  }
}

void ObstacleMemory::clearChanges() {
  changes_.clear();
  everything_changed_ = false;
}

void ObstacleMemory::forgetUnderneath(const Pose2& pose) {
  const Square here = window_.squareAt({pose.x, pose.y});
  const int first_column = here.column - kSide * window_.originColumn();
  const int first_row = here.row - kSide * window_.originRow();
  const BitRows& occupied = window_.squares();
  const int squares = static_cast<int>(footprint_radius_ / window_.resolution());
  for (int row = -squares; row <= squares; ++row) {
    for (int column = -squares; column <= squares; ++column) {
      const Square square{first_column + column, first_row + row};
      if (square.column >= 0 && square.column < occupied.columns() && square.row >= 0 && square.row < occupied.rows() &&
          window_.isOccupied(square) && distanceBetween(window_.centerOf(square), pose) < 0.9 * footprint_radius_) {
        set(square, false);
      }
    }
  }
}

void ObstacleMemory::set(const Square& square, bool occupied) {
  passability_.outdate(window_.set(square, occupied));
  noteChange(window_.centerOf(square), occupied);
}

void ObstacleMemory::noteChange(const Point2& place, bool occupied) {
  if (changes_.size() < kMostChanges) {
    changes_.push_back({place, occupied});
  } else {
    everything_changed_ = true;
  }
}

void ObstacleMemory::outdateAll() {
  passability_.outdateAll();
  everything_changed_ = true;
}

}  // namespace lstm_planner
