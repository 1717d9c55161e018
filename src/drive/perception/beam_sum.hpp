#pragma once

#include <cstddef>
#include <limits>

namespace lstm_planner {

/// What some neighbouring beams see.
struct BeamSum {
  double range = 0.0;                                      ///< m, of those that are known; each at most the cap
  float nearest = std::numeric_limits<float>::infinity();  ///< m; +inf where nothing is measured
  int measured = 0;                                        ///< with a range
  int known = 0;                                           ///< with a range, or seeing nothing
};

/// Of `count` neighbouring beams of a RangeProfile. `cap`: m.
BeamSum sumOfBeams(const float* ranges, std::size_t count, double cap);

}  // namespace lstm_planner
