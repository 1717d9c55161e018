#pragma once

#include "lstm_planner/common/range.hpp"

namespace lstm_planner {

// What several commands' options may be. Sizes end where a computer of today does.
constexpr Range kAnyShare{0.0, 1.0};
constexpr Range kAnyLength{0.0, 1e6};  ///< m or cells
constexpr Range kAnyTime{0.001, 1e7};  ///< s
constexpr Range kAnyCount{1, 1e6};     ///< of what is done one after the other: drives, rounds
constexpr Range kAnySteps{1, 1e9};     ///< of drives or of walks on a grid
constexpr Range kAnyThreads{1, 1024};

// Of trainings.
constexpr Range kAnyLayer{1, 4096};  ///< cells or units
constexpr Range kAnyWindow{1, 1e5};  ///< steps that errors go back
constexpr Range kAnyRate{1e-9, 100.0};
constexpr Range kAnyWeight{0.0, 1000.0};

}  // namespace lstm_planner
