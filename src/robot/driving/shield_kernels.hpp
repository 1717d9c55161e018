#pragma once

#include <cstddef>

#include "lstm_planner/base/network/instruction_set.hpp"

namespace lstm_planner {

// What Shield does with each return of each scan: functions that are compiled for each instruction set from one source.
// This header is seen by code for machines of different ages, so that whatever it defines must have internal linkage.
// All sets answer the same to the last bit.

/// Neighbours of a scan lie near one another: whole groups of them need not be looked at.
constexpr std::size_t kReturnsAGroup = 16;

/// The boxes around groups come in blocks of so many, as many as there are lanes in the widest vector.
constexpr std::size_t kGroupsABlock = 16;
constexpr std::size_t kNumbersABlock = 4 * kGroupsABlock;

/// A return must come this much nearer before it counts as coming nearer, m: less than the noise of any scanner.
constexpr double kShieldTouchSlack = 1e-3;

/// Groups of returns in the base frame, m.
struct ReturnGroups {
  std::size_t count;
  const double* places;  ///< kReturnsAGroup x, then as many y, of each group
  const float* boxes;    ///< kGroupsABlock x of the middles, then as many y, half widths, half heights, of each block
};

/// A straight drive of a disc. Base frame, m.
struct DiscLine {
  double from_x;
  double from_y;
  double along_x;  ///< of length 1
  double along_y;
  double limit;   ///< longer ones are not asked for
  double wanted;  ///< radius with the clearance
  double hard;    ///< radius into which nothing may come
  double enough;  ///< a free length below this need not be exact, only below this
  double blur;    ///< more than what is lost of a coordinate in a float
};

struct ShieldKernels {
  /// Adds groups of places (pairs x, y) that all are within reach, leaves out those that are all beyond it, and stops
  /// at the first group that is neither. Returns how many groups it has dealt with. `count`: of groups in `into_places`
  /// and `into_boxes` before and after.
  std::size_t (*add)(const double* places, std::size_t groups, double reach_squared, double* into_places,
                     float* into_boxes, std::size_t* count);

  /// Shield::freeDistance(), or something else below `enough` if that is below it.
  double (*freeLine)(const ReturnGroups& groups, const DiscLine& line);
};

ShieldKernels baselineShieldKernels();
ShieldKernels avx2ShieldKernels();
ShieldKernels avx512ShieldKernels();

/// For one of runnableInstructionSets().
const ShieldKernels& shieldKernels(InstructionSet set);

/// For the fastest.
const ShieldKernels& shieldKernels();

}  // namespace lstm_planner
