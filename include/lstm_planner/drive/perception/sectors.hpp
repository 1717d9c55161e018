#pragma once

#include <array>
#include <limits>
#include <stdexcept>

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

constexpr int kSectorCount = 8;

/// Average range over each of eight equal angular sections of [-90, +90) degrees around the robot's heading, from right
/// (-90) to left (+90) (thesis 4.2, Fig. 4.4).
struct Sectors {
  std::array<double, kSectorCount> range{};  ///< m, in (0, range cap]; no return counts as the range cap
  std::array<double, kSectorCount> nearest;  ///< m, the nearest measured range, not capped; +inf where there is none
  std::array<int, kSectorCount> beams{};     ///< beams that fell into the sector
  std::array<int, kSectorCount> measured{};  ///< of these, beams with a measured range

  Sectors() { nearest.fill(std::numeric_limits<double>::infinity()); }

  /// False when nothing was measured in the sector: its range is then the cap and says only "nothing seen".
  bool hasMeasurement(int sector) const { return measured[sector] > 0; }
};

/// A scan that must not be used; what() is one sentence with the value and what was expected.
class UnusableScan : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Averages a scan. The angle of a beam is taken in the base frame (mount yaw and mounting upside down applied), so
/// that every beam inside [-90, +90) degrees falls in exactly one sector: 720 beams of the UTM-30LX-EW. Ranges beyond
/// `range_cap` (m) and no returns are averaged as the cap; what was not measured is left out. Ranges stay distances
/// from the sensor: where it sits on the robot is not corrected for, since that would move beams from one sector to
/// another. Beams of a second turn are left out; a full turn may start anywhere. At each edge of the window 3 degrees,
/// or half an increment, may be missing. Throws UnusableScan as checkScan() does, and when the scan covers less than
/// that, a sector gets no beam, or less than the share `least_measured` of a sector's beams was measured;
/// std::invalid_argument for a range cap that is not positive and finite.
Sectors averageSectors(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, double range_cap);

/// The same for the profile of a scan that checkScan() has let through.
Sectors averageSectors(const RangeProfile& profile, double least_measured, double range_cap);

/// Throws UnusableScan when less than the share `least_measured` was measured in one of the equal sections of about a
/// sector's width that the whole scan is divided into: for a scan that need not see ahead, let through by checkScan().
void checkMeasured(const RangeProfile& profile, double least_measured);

/// Throws UnusableScan when a scan's numbers cannot be those of a scanner: no beams or more than 100,000, angles that
/// are not finite or beyond two turns, an increment of less than 1e-5 rad, range_min not below range_max, a range_max
/// that is not positive, or a scanner that is farther than 100 m from the robot, or turned by more than two turns.
void checkScan(const LaserScan& scan, const SensorMount& mount);
/// Whether it lets the scan through.
bool isScan(const LaserScan& scan, const SensorMount& mount);

}  // namespace lstm_planner
