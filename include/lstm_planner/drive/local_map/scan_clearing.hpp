#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/drive/perception/beam_finder.hpp"

namespace lstm_planner {

/// Finds the places that a scan shows clear: the beam towards the place and two on each side end at least 0.1 m behind
/// it. Made for thousands of places per scan: as much as possible is done once per scan, or for a whole neighbourhood.
///
/// Places are relative to the scanner, m, in a frame in which the base has the yaw that was given to show().
class ScanClearing {
 public:
  /// `neighbourhood`: radius around the middle of a cell in which its squares' middles lie, m.
  explicit ScanClearing(double neighbourhood) : neighbourhood_(static_cast<float>(neighbourhood)) {}

  /// Replaces the scan.
  void show(const RangeProfile& profile, double yaw);

  /// Nothing is cleared by a scan without beams.
  bool isBlind() const { return finder_.beams() == 0; }

  /// That many places are looked at together, at most. All arrays are used up to the next multiple of four.
  static constexpr std::size_t kMost = 256;

  /// Square of the distance, m^2, from which on the scan surely clears no place of the neighbourhoods of some places; 0
  /// when it does so nowhere in it. Not while isBlind().
  void findLimits(const float* x, const float* y, std::size_t count, float* limits) const;

  /// Whether the scan clears the places: 1 or 0. Not while isBlind().
  void findClear(const float* x, const float* y, std::size_t count, std::uint8_t* clear) const;

 private:
  static constexpr std::size_t kBlock = 4;   ///< beams
  static constexpr std::size_t kLevels = 6;  ///< of neighbourhoods, each twice as wide as the last, in blocks

  void measureBeams(const RangeProfile& profile);
  /// The most of the blocks from the first to the last, m.
  float farthest(std::size_t first, std::size_t last) const;
  /// Of a neighbourhood that has a distance squared, m^2, and lies between two positions among the beams.
  float limitOf(float squared, float first, float beyond) const;

  float neighbourhood_;
  BeamFinder finder_;
  std::vector<float> padded_;    ///< m, the ranges, and some more at both ends
  std::vector<float> limits_;    ///< m^2; a beam each: farther places are not cleared
  std::vector<float> farthest_;  ///< m; the most of 2^level blocks from each one on, level by level
  std::size_t blocks_ = 0;       ///< from one level of farthest_ to the next
};

}  // namespace lstm_planner
