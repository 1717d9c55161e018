#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/perception/beam_finder.hpp"

namespace lstm_planner {

/// Tells through which places a scan looks: the beam towards them and two on each side end 0.1 m behind them at least.
/// For thousands of places a scan: all that can be is done once a scan, or for a whole neighbourhood.
///
/// Places are relative to the scanner, m, in a frame in which the base has the yaw that show() was told. Arrays are
/// used up to the next multiple of four.
class Sight {
 public:
  /// `neighbourhood`: radius of the neighbourhoods of limits(), m.
  explicit Sight(double neighbourhood) : neighbourhood_(static_cast<float>(neighbourhood)) {}

  /// Replaces the scan. Nothing is looked through when it has no beams.
  void show(const RangeProfile& profile, double yaw);

  /// 1 for the places that the scan looks through, 0 for the others.
  void looksThrough(const float* x, const float* y, std::size_t count, std::uint8_t* through);

  /// Square of the distance, m^2, from which on the scan surely looks through no place of the neighbourhoods; 0 when
  /// it does so nowhere in it.
  void limits(const float* x, const float* y, std::size_t count, float* limits);

 private:
  static constexpr std::size_t kBlock = 4;   ///< beams
  static constexpr std::size_t kLevels = 6;  ///< of neighbourhoods, each twice as wide as the last, in blocks

  void measureBeams(const RangeProfile& profile);
  float farthest(std::size_t first, std::size_t last) const;

  float neighbourhood_;
  BeamFinder finder_;
  std::vector<float> padded_;     ///< m, the ranges, and some more at both ends
  std::vector<float> limits_;     ///< m^2; a beam each: farther places are not looked through
  std::array<std::vector<float>, kLevels> farthest_;  ///< m; the most of 2^level blocks from each one on
  std::vector<float> positions_;                      ///< of find()
};

}  // namespace lstm_planner
