#pragma once

namespace lstm_planner {

/// What a number may be: least <= number <= most.
struct Range {
  double least = 0.0;
  double most = 0.0;

  /// {} stands for no range at all.
  bool isGiven() const { return least != 0.0 || most != 0.0; }
  bool contains(double number) const { return number >= least && number <= most; }
};

}  // namespace lstm_planner
