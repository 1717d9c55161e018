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

/// The same equations once more, written from the thesis in double precision and plain loops, sharing no code with
/// Network.
class ReferenceNetwork {
 public:
  explicit ReferenceNetwork(LayerStack layers);

  std::vector<double> forward(const Eigen::VectorXf& input);

 private:
  struct State {
    std::vector<double> hidden;
    std::vector<double> cell;
  };

  LayerStack layers_;
  std::vector<State> states_;
};

/// Largest absolute difference of two vectors of the same size; infinity when the sizes differ or a value is not
/// finite.
double largestDifference(const Eigen::VectorXf& values, const std::vector<double>& reference);

}  // namespace lstm_planner::test
