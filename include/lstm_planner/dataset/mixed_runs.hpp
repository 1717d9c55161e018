#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "lstm_planner/dataset/drive_events.hpp"

namespace lstm_planner {

/// The first and the last stamp (s) between which odometry jumps to and fro between several runs; empty if it does not.
/// A bag is like this where the clock was set back while it was recorded: its messages are in the order of their times,
/// so those of one run lie between those of another. Few become steps, and these to the goal that came last, whichever
/// run it was of. Single messages that are wrong are no run. `path`: in the order of its stamps; `max_speed`: m/s, what
/// moves faster has jumped.
std::optional<std::pair<double, double>> mixedRuns(const std::vector<OdometryHeard>& path, double max_speed);

}  // namespace lstm_planner
