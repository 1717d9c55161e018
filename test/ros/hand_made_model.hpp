#pragma once

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/base/network/model_file.hpp"
#include "lstm_planner/robot/driving/drive_policy.hpp"
#include "support/scratch_folder.hpp"

namespace lstm_planner {

inline Eigen::MatrixXf randomMatrix(int rows, int columns, std::mt19937* random) {
  std::uniform_real_distribution<float> weight(-0.5F, 0.5F);
  return Eigen::MatrixXf::NullaryExpr(rows, columns, [&] { return weight(*random); });
}

/// A model that fits the default parameters. Nobody taught it anything, but its preferences depend on all it has seen.
inline Model untaughtModel(const PolicyDescription& description = {}) {
  constexpr int kCells = 8;
  std::mt19937 random(7);
  const int inputs = static_cast<int>(description.encoder.input_layout.size());
  const int actions = description.actions.size();
  Model model;
  model.layers.push_back(LstmLayer{randomMatrix(4 * kCells, inputs, &random), randomMatrix(4 * kCells, kCells, &random),
                                   randomMatrix(4 * kCells, 1, &random), Activation::kTanh});
  model.layers.push_back(
      DenseLayer{randomMatrix(actions, kCells, &random), randomMatrix(actions, 1, &random), Activation::kIdentity});
  writeMetadata(description, &model.metadata);
  return model;
}

/// A model that always prefers the steering angle that leads most directly to the goal: cos(angle - bearing).
/// test/models/goal_seeking.onnx holds it, for tests that start their nodes from a launch file.
inline Model goalSeekingModel(const PolicyDescription& description = {}) {
  const std::vector<std::string>& layout = description.encoder.input_layout;
  const int actions = description.actions.size();
  DenseLayer layer{Eigen::MatrixXf::Zero(actions, static_cast<int>(layout.size())), Eigen::VectorXf::Zero(actions),
                   Activation::kIdentity};
  for (int input = 0; input < static_cast<int>(layout.size()); ++input) {
    for (int action = 0; action < actions; ++action) {
      const double angle = description.actions.angle(action);
      const std::string& name = layout[static_cast<std::size_t>(input)];
      if (name == "goal_bearing_sin") layer.weights(action, input) = static_cast<float>(std::sin(angle));
      if (name == "goal_bearing_cos") layer.weights(action, input) = static_cast<float>(std::cos(angle));
    }
  }
  Model model;
  model.layers.push_back(layer);
  writeMetadata(description, &model.metadata);
  return model;
}

/// A model that always prefers to go straight on.
inline Model straightAheadModel(const PolicyDescription& description = {}) {
  const int actions = description.actions.size();
  DenseLayer layer{Eigen::MatrixXf::Zero(actions, static_cast<int>(description.encoder.input_layout.size())),
                   Eigen::VectorXf::Zero(actions), Activation::kIdentity};
  for (int action = 0; action < actions; ++action) {
    layer.bias(action) = static_cast<float>(std::cos(description.actions.angle(action)));
  }
  Model model;
  model.layers.push_back(layer);
  writeMetadata(description, &model.metadata);
  return model;
}

/// A model file that lives as long as the object.
class TemporaryModelFile {
 public:
  explicit TemporaryModelFile(const Model& model) { writeModelFile(path_, model); }

  const std::string& path() const { return path_; }

  /// Only the first half of the file stays.
  void truncate() const {
    const std::string content = folder_.read("model.onnx");
    folder_.write("model.onnx", content.substr(0, content.size() / 2));
  }

 private:
  test::ScratchFolder folder_;
  std::string path_ = folder_ / "model.onnx";
};

}  // namespace lstm_planner
