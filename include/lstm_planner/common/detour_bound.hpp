#pragma once

namespace lstm_planner {

/// How much longer than the remembered path the network may make the path (DetourBound).
struct DetourParameters {
  double allowance = 0.1;  ///< m, or cells of the grid world
  double share = 0.08;     ///< of the driven distance
};

/// Limits how much longer the path becomes because the network chooses the steps.
///
/// What a choice costs is its regret: the length of the step, plus the remembered path from its end to the goal, minus
/// the remembered path from here (m, or cells of the grid world; never below 0). A choice may be carried out while the
/// sum of all regrets since the goal was set stays within an allowance plus a share of the driven distance. So a
/// network that always chooses well is never stopped, and a bad one cannot make the path longer than that sum:
/// learning-augmented algorithms call these two consistency and robustness (Lykouris and Vassilvitskii, "Competitive
/// caching with machine learned advice", 2018).
class DetourBound {
 public:
  explicit DetourBound(const DetourParameters& parameters) : parameters_(parameters) {}

  /// A new goal: nothing is used.
  void start() {
    past_ = 0.0;
    now_ = 0.0;
  }

  /// Ends the step. `driven` (0 to 1): the share of the step that was carried out; this share of its regret counts.
  void endStep(double driven) {
    past_ += driven * now_;
    now_ = 0.0;
  }

  /// Whether a choice of that regret may be carried out in this step; `driven`: distance since the goal was set.
  bool allows(double regret, double driven) const { return past_ + regret <= allowed(driven); }

  /// The choice of this step, in place of an earlier one in the same step.
  void choose(double regret) { now_ = regret; }

  double used() const { return past_ + now_; }
  double allowed(double driven) const { return parameters_.allowance + parameters_.share * driven; }

 private:
  DetourParameters parameters_;
  double past_ = 0.0;  ///< regrets of the steps before
  double now_ = 0.0;   ///< of this step
};

}  // namespace lstm_planner
