#pragma once

namespace lstm_planner {

/// The range of a number: least <= number <= most.
struct Range {
  double least = 0.0;
  double most = 0.0;

  /// {} means that there is no range.
  bool isGiven() const { return least != 0.0 || most != 0.0; }
  bool contains(double number) const { return number >= least && number <= most; }
};

}  // namespace lstm_planner
