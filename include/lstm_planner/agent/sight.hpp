#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/perception/beam_finder.hpp"

namespace lstm_planner {

/// Tells through which places a scan looks: the beams towards them and beside them end behind them. For thousands of
/// places a scan: all that can be is done once a scan, or for a whole neighbourhood.
///
/// Places are relative to the scanner, m, in a frame in which the base has the yaw that show() was told. Arrays are used
/// up to the next multiple of four.
class Sight {
 public:
  /// `behind`: how far behind a place the beams must end, m. `beside`: how many beams on each side must do so.
  /// `neighbourhood`: radius of mayLookThrough(), m.
  Sight(double behind, int beside, double neighbourhood)
      : behind_(static_cast<float>(behind)), beside_(beside), neighbourhood_(static_cast<float>(neighbourhood)) {}

  /// Replaces the scan. Nothing is looked through when it has no beams.
  void show(const RangeProfile& profile, double yaw);

  /// 1 for the places that the scan looks through, 0 for the others.
  void looksThrough(const float* x, const float* y, std::size_t count, std::uint8_t* through);

  /// 0 where the scan surely looks through no place of the neighbourhood, 1 elsewhere.
  void mayLookThrough(const float* x, const float* y, std::size_t count, std::uint8_t* may);

 private:
  static constexpr std::size_t kBlock = 8;  ///< beams
  /// For places from a distance on: a neighbourhood there is no wider than some beams.
  struct Horizon {
    float from = 0.0f;         ///< m
    float beams = 0.0f;        ///< on each side of its middle
    std::vector<float> limits;  ///< m^2; a block each: farther places' neighbourhoods are not looked through
  };

  void measureBeams(const RangeProfile& profile);
  void measureBlocks(Horizon* horizon);
  bool mayLookThrough(float position, float squared) const;

  float behind_;
  int beside_;
  float neighbourhood_;
  BeamFinder finder_;
  std::vector<float> padded_;     ///< the ranges, and some more at both ends
  std::vector<float> limits_;     ///< m^2; a beam each: farther places are not looked through
  std::vector<float> blocks_;     ///< m; the farthest that any beam of a block sees, and some more at both ends
  std::vector<float> positions_;  ///< of find()
  Horizon near_;
  Horizon far_;
};

}  // namespace lstm_planner
