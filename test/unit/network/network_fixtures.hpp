#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "lstm_planner/network/layers.hpp"

namespace lstm_planner::test {

/// Makes layers with seeded weights, uniform within 1 / sqrt(inputs) as trainers start them: such recurrent layers
/// forget, so that rounding errors do not grow from step to step.
class LayerMaker {
 public:
  explicit LayerMaker(unsigned seed) : random_(seed) {}

  LstmLayer lstm(int inputs, int cells, Activation candidate = Activation::kTanh) {
    return {matrix(4 * cells, inputs, cells), matrix(4 * cells, cells, cells), matrix(4 * cells, 1, cells), candidate};
  }
  RecurrentLayer recurrent(int inputs, int units) {
    return {matrix(units, inputs, units), matrix(units, units, units), matrix(units, 1, units)};
  }
  DenseLayer dense(int inputs, int outputs, Activation activation = Activation::kIdentity) {
    return {matrix(outputs, inputs, inputs), matrix(outputs, 1, inputs), activation};
  }
  /// 11 -> LSTM 8 -> LSTM 8 -> FC 8.
  LayerStack thesisNet() { return {lstm(11, 8), lstm(8, 8), dense(8, 8)}; }

  Eigen::VectorXf input(int size, float range = 1.0f) {
    std::uniform_real_distribution<float> uniform(-range, range);
    return Eigen::VectorXf::NullaryExpr(size, [&] { return uniform(random_); });
  }

 private:
  Eigen::MatrixXf matrix(int rows, int columns, int fan_in) {
    std::uniform_real_distribution<float> uniform(-1.0f / std::sqrt(float(fan_in)), 1.0f / std::sqrt(float(fan_in)));
    return Eigen::MatrixXf::NullaryExpr(rows, columns, [&] { return uniform(random_); });
  }

  std::mt19937 random_;
};

/// The equations once more, written from the thesis in double precision and plain loops, sharing no code with Network
/// and LaneNetwork.
class ReferenceNetwork {
 public:
  explicit ReferenceNetwork(const LayerStack& layers);
  /// With these weights, as of parameterVector(), in place of the layers' own.
  ReferenceNetwork(const LayerStack& layers, const Eigen::VectorXd& parameters);

  Eigen::VectorXd forward(const Eigen::VectorXd& input);

 private:
  /// A layer's weights, and its state.
  struct LayerInDouble {
    Layer layer;
    Eigen::MatrixXd input;
    Eigen::MatrixXd recurrent;
    Eigen::VectorXd bias;
    Eigen::VectorXd hidden;
    Eigen::VectorXd cell;

    double weightedSum(Eigen::Index row, const Eigen::VectorXd& inputs, const Eigen::VectorXd& previous) const;
    void stepLstm(Activation candidate, const Eigen::VectorXd& inputs);
    void stepRecurrent(const Eigen::VectorXd& inputs);
    Eigen::VectorXd dense(Activation activation, const Eigen::VectorXd& inputs) const;
  };

  std::vector<LayerInDouble> layers_;
};

/// Largest absolute difference of two vectors of the same size; infinity when the sizes differ or a value is not
/// finite.
double largestDifference(const Eigen::VectorXf& values, const Eigen::VectorXd& reference);

}  // namespace lstm_planner::test
