#pragma once

#include <cstddef>
#include <cstdint>

#include "lstm_planner/base/network/instruction_set.hpp"
#include "lstm_planner/robot/perception/first_beam.hpp"

namespace lstm_planner {

// What is done with each beam of each scan, or with hundreds of places: functions that are compiled for each
// instruction set from one source. This header is seen by code for machines of different ages, so that whatever it
// defines must have internal linkage. All sets answer the same but for the rounding of products and sums.

/// What the readings of one scan mean: see readingBounds(). Masks are all bits or none.
struct ReadingBounds {
  float least;                   ///< m, of what counts as measured
  float most;                    ///< m
  float nothing_from;            ///< m; such readings and greater ones are no returns
  float code_first;              ///< m; from here to
  float code_last;               ///< m, a reading is no return
  std::int32_t nan_is_silent;    ///< a mask
  std::int32_t zero_is_silent;   ///< a mask
  std::int32_t below_is_silent;  ///< a mask
};

/// What some neighbouring beams see.
struct BeamSum {
  double range;   ///< m, of those that are known; each at most the cap
  float nearest;  ///< m; +inf where nothing is measured
  int measured;   ///< with a range
  int known;      ///< with a range, or seeing nothing
  int silent;     ///< of the known ones those whose driver may mean that nothing could be measured
};

/// What Sight knows of a scan.
struct SightBeams {
  FirstBeam first;
  int beams = 0;
  float beams_a_turn = 0.0f;
  const float* limits = nullptr;    ///< m^2, a beam each: places farther away are not cleared
  const float* farthest = nullptr;  ///< m; the most of 2^level blocks of four beams from each block on, level by level
  int blocks = 0;                   ///< from one level to the next
  int levels = 0;
  float neighbourhood = 0.0f;  ///< m, radius
};

/// Squares by their keys: row << 16 | column.
struct SquareGrid {
  float left;  ///< m from the scanner to the middle of the square with the key 0
  float bottom;
  float resolution;  ///< m
};

/// From places in the base frame to keys. Numbers are squares.
struct SquareFrame {
  float cosine;  ///< of the yaw, in squares a metre
  float sine;
  float x;  ///< the base in a frame in which all returns have positive coordinates
  float y;
  int first_column;  ///< of that frame's square (0, 0)
  int first_row;
  int sides;       ///< columns and rows that there are
  float farthest;  ///< m^2; what is farther has no key
};

/// Of a place that has none, or is out of reach.
constexpr std::uint32_t kNoSquare = ~std::uint32_t{0};

struct ScanKernels {
  /// As RangeProfile::ranges what the readings of `count` beams mean.
  void (*meanings)(const ReadingBounds& bounds, const float* readings, std::size_t count, float* ranges);

  /// Of `count` neighbouring beams of a RangeProfile. `cap`: m.
  BeamSum (*sum)(const float* ranges, std::size_t count, double cap);

  /// toPoints(), with the beams' directions and the points as pairs x, y. There is room for all beams. Returns how many
  /// points there are.
  std::size_t (*points)(const float* ranges, std::size_t count, double nearest_range, const double* origin,
                        const double* directions, double* points);

  /// BeamFinder::find().
  void (*find)(const FirstBeam& first, const float* x, const float* y, std::size_t count, float* positions);

  /// Keys of the squares of `count` places (pairs x, y), in order, once where several places follow one another in a
  /// square. Returns how many. `keys` and `work` have room for 16 more than `count`, `work` twice.
  std::size_t (*squaresOf)(const SquareFrame& frame, const double* places, std::size_t count, std::uint32_t* work,
                           std::uint32_t* keys);

  /// Keeps of some cells, given by the keys of their first squares, those in which the scan may clear some
  /// square. `limits`: m^2, from which on it surely clears none. Returns how many. There is room for 16 more.
  std::size_t (*cellsInSight)(const SightBeams& beams, const SquareGrid& grid, std::uint32_t* cells, std::size_t count,
                              float* limits);

  /// Keys of the squares that the scan clears, of those in cells of four by four that `occupied` has a bit for,
  /// row by row. Returns how many. There is room for 16 more than all squares.
  std::size_t (*clearSquares)(const SightBeams& beams, const SquareGrid& grid, const std::uint32_t* cells,
                              const float* limits, const std::uint16_t* occupied, std::size_t count,
                              std::uint32_t* clear);
};

ScanKernels baselineScanKernels();
ScanKernels avx2ScanKernels();
ScanKernels avx512ScanKernels();

/// For one of runnableInstructionSets().
const ScanKernels& scanKernels(InstructionSet set);

/// For the fastest.
const ScanKernels& scanKernels();

}  // namespace lstm_planner
