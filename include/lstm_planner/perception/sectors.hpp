#pragma once

#include <array>
#include <limits>
#include <stdexcept>

#include "lstm_planner/perception/laser_scan.hpp"

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

/// A scan that cannot be averaged; what() is one sentence with the value and what was expected.
class UnusableScan : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Averages a scan. The angle of a beam is taken in the base frame (mount yaw and mounting upside down applied), so
/// that every beam inside [-90, +90) degrees falls in exactly one sector: 720 beams of the UTM-30LX-EW. Ranges beyond
/// `range_cap` (m) and no returns are averaged as the cap. Ranges stay distances from the sensor: where it sits on the
/// robot is not corrected for, since that would move beams from one sector to another. Beams of a second turn are left
/// out; a full turn may begin anywhere. Half an increment may be missing at each edge of the window.
/// Throws UnusableScan when the geometry is not finite, the scan is empty, it covers less than the 180 degrees, or a
/// sector gets no beam; std::invalid_argument for a range cap that is not positive and finite.
Sectors averageSectors(const LaserScan& scan, const SensorMount& mount, const ScanLimits& limits, double range_cap);

/// The same for the profile of a scan that checkScan() has let through.
Sectors averageSectors(const RangeProfile& profile, double range_cap);

/// Throws UnusableScan when the geometry of a scan is not finite or the scan is empty.
void checkScan(const LaserScan& scan, const SensorMount& mount);

}  // namespace lstm_planner
