#pragma once

#include "lstm_planner/perception/encoder.hpp"

namespace lstm_planner {

/// What an observation says of directions, except those of which there are eight, as seen in direction heading +
/// `angle` (rad).
void turnBearings(const ViewBearings& bearings, double angle, Observation* observation);

}  // namespace lstm_planner
