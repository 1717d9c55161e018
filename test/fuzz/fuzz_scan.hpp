#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "fuzz/fuzz_input.hpp"
#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner::fuzz {

inline Pose2 anyPose(FuzzInput* input) {
  const double x = input->number();
  const double y = input->number();
  return {x, y, input->number()};
}

/// A scan of 0 to 255 beams. Every second one has a sound geometry, or hardly any input would get beyond the checks.
inline LaserScan anyScan(FuzzInput* input) {
  LaserScan scan;
  const int kind = input->byte();
  const int beams = input->byte();
  scan.angle_min = -M_PI_2;
  scan.angle_increment = M_PI / std::max(1, beams - 1);
  scan.range_min = 0.1;
  scan.range_max = 30.0;
  if ((kind & 1) != 0) {
    const int field = input->byte();
    if ((field & 1) != 0) scan.angle_min = input->number();
    if ((field & 2) != 0) scan.angle_increment = input->number();
    if ((field & 4) != 0) scan.range_min = input->number();
    if ((field & 8) != 0) scan.range_max = input->number();
    if ((field & 16) != 0) scan.angle_increment = M_PI * 2.0 / std::max(1, beams - 1) * (input->flag() ? 1.0 : -1.0);
  }
  using Limits = std::numeric_limits<float>;
  static constexpr std::array<float, 12> kSpecial = {Limits::quiet_NaN(),
                                                     Limits::infinity(),
                                                     -Limits::infinity(),
                                                     0.0f,
                                                     -1.0f,
                                                     0.099f,
                                                     Limits::max(),
                                                     Limits::denorm_min(),
                                                     65.53f,
                                                     30.0f,
                                                     30.001f,
                                                     1e-3f};
  const bool all_alike = (kind & 2) != 0;
  float reading = 0.0f;
  for (int i = 0; i < beams; ++i) {
    if (i == 0 || !all_alike) {
      const std::uint8_t code = input->byte();
      reading =
          code < 240 ? static_cast<float>(code) * 0.02f : kSpecial[static_cast<std::size_t>(code) % kSpecial.size()];
    }
    scan.ranges.push_back(reading);
  }
  return scan;
}

/// Near the base's middle, looking ahead, three times out of four.
inline SensorMount anyMount(FuzzInput* input) {
  const int kind = input->byte();
  SensorMount mount;
  mount.upside_down = (kind & 1) != 0;
  if ((kind & 6) == 6) mount.pose = anyPose(input);
  return mount;
}

}  // namespace lstm_planner::fuzz
