#pragma once

namespace lstm_planner {

/// Where a scan's beams start, and how they follow one another: what it takes to tell towards which beam a place lies.
struct FirstBeam {
  float along_x = 1.0f;  ///< its direction
  float along_y = 0.0f;
  float aside = 1.0f;           ///< -1 where beams follow one another clockwise
  float beams_a_radian = 0.0f;  ///< more than 0
};

}  // namespace lstm_planner
