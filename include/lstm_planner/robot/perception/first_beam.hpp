#pragma once

namespace lstm_planner {

/// Direction of a scan's first beam, and the order of the beams: needed to find the beam that points to a place.
struct FirstBeam {
  float along_x = 1.0f;  ///< its direction
  float along_y = 0.0f;
  float aside = 1.0f;           ///< -1 where beams follow one another clockwise
  float beams_a_radian = 0.0f;  ///< more than 0
};

}  // namespace lstm_planner
