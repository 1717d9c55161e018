#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lstm_planner {

/// One epoch of learning by reinforcement.
struct GridCurvePoint {
  int epoch = 0;                ///< from 1
  double steps = 0.0;           ///< of all agents since the start
  double reward = 0.0;          ///< mean a step, cells
  double arrival = 0.0;         ///< share of the training episodes
  double ratio = 0.0;           ///< mean length / optimum of those that arrived
  std::vector<double> success;  ///< share of each validation set's scenarios
  double mean_success = 0.0;
  bool best = false;
};

nlohmann::json toJson(const GridCurvePoint& point);
GridCurvePoint curvePointFrom(const nlohmann::json& json);

/// Writes the points as CSV beside the picture and draws them over the steps with gnuplot: success on the validation
/// sets and arrival above, length / optimum below. Throws std::runtime_error when a file cannot be written or gnuplot
/// is missing or fails; the CSV file is complete by then.
void writeGridCurve(const std::string& png_path, const std::vector<std::string>& set_names,
                    const std::vector<GridCurvePoint>& points);

}  // namespace lstm_planner
