#pragma once

#include <cstddef>

namespace lstm_planner {

/// What some neighbouring beams see.
struct BeamSum {
  double range;   ///< m, of those that are known; each at most the cap
  float nearest;  ///< m; +inf where nothing is measured
  int measured;   ///< with a range
  int known;      ///< with a range, or seeing nothing
  int silent;     ///< of the known ones those whose driver may mean that nothing could be measured
};

/// Of `count` neighbouring beams of a RangeProfile. `cap`: m.
BeamSum sumOfBeams(const float* ranges, std::size_t count, double cap);

}  // namespace lstm_planner
