#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lstm_planner/network/network.hpp"

namespace lstm_planner {

/// A network of the thesis's author with the weights that he published: each of the 11 inputs runs through its own copy
/// of one stacked LSTM on a scalar, all copies sharing their weights, and one dense layer mixes the 11 outputs.
class ThesisNetwork {
 public:
  static constexpr int kInputs = 11;

  /// Reads NAME_weights.json.
  ThesisNetwork(const std::filesystem::path& folder, const std::string& name) {
    std::ifstream file(folder / (name + "_weights.json"));
    const nlohmann::json weights = nlohmann::json::parse(file);
    const auto lstm = [&](const std::string& layer) {
      return LstmLayer{fromCaffeGates(matrixFrom(weights.at(layer + "_W_xc"))),
                       fromCaffeGates(matrixFrom(weights.at(layer + "_W_hc"))),
                       fromCaffeGates(vectorFrom(weights.at(layer + "_b_c"))), Activation::kTanh};
    };
    inputs_.assign(kInputs, Network({lstm("lstm1"), lstm("lstm2")}));
    mixer_.emplace_back(LayerStack{DenseLayer{matrixFrom(weights.at("out_W")), vectorFrom(weights.at("out_b"))}});
  }

  Eigen::Index cells() const { return inputs_.front().outputSize(); }
  Eigen::VectorXf hiddenState(int input) const { return inputs_[static_cast<std::size_t>(input)].hiddenState(); }

  void reset() {
    for (Network& input : inputs_) input.reset();
  }

  /// The preferences over the eight moves, in the order of his program.
  Eigen::VectorXf forward(const std::array<float, kInputs>& values) {
    Eigen::VectorXf hidden(kInputs * cells());
    for (int i = 0; i < kInputs; ++i) {
      const auto place = static_cast<std::size_t>(i);
      hidden.segment(i * cells(), cells()) = inputs_[place].forward(Eigen::VectorXf::Constant(1, values[place]));
    }
    return mixer_.front().forward(hidden);
  }

 private:
  static Eigen::MatrixXf matrixFrom(const nlohmann::json& rows) {
    Eigen::MatrixXf matrix(rows.size(), rows.at(0).size());
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      for (Eigen::Index column = 0; column < matrix.cols(); ++column)
        matrix(row, column) = rows[row][column].get<float>();
    }
    return matrix;
  }

  static Eigen::VectorXf vectorFrom(const nlohmann::json& values) {
    Eigen::VectorXf vector(values.size());
    for (Eigen::Index index = 0; index < vector.size(); ++index) vector(index) = values[index].get<float>();
    return vector;
  }

  /// Caffe stacks the gates as input, forget, output, candidate; ours are input, output, forget, candidate.
  template <typename Matrix>
  static Matrix fromCaffeGates(const Matrix& caffe) {
    const Eigen::Index cells = caffe.rows() / 4;
    Matrix ours = caffe;
    ours.middleRows(cells, cells) = caffe.middleRows(2 * cells, cells);
    ours.middleRows(2 * cells, cells) = caffe.middleRows(cells, cells);
    return ours;
  }

  std::vector<Network> inputs_;
  std::vector<Network> mixer_;  ///< one
};

}  // namespace lstm_planner
