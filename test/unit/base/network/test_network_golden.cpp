#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "lstm_planner/base/network/network.hpp"
#include "support/real_data.hpp"

// The networks of the thesis's author: each of the 11 features runs through its own copy of one stacked LSTM on a
// scalar, all copies sharing their weights, and one dense layer mixes the 11 outputs.

namespace lstm_planner {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::VectorXf;
using Rows = std::vector<std::vector<double>>;

constexpr int kFeatures = 11;

fs::path goldenFolder() { return realData("golden"); }

/// Rows of numbers; words (headers, the names in the first column) become 0.
Rows readCsv(const fs::path& path) {
  std::ifstream file(path);
  Rows rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::strtod(cell.c_str(), nullptr));
  }
  return rows;
}

MatrixXf matrixFrom(const nlohmann::json& rows) {
  MatrixXf matrix(rows.size(), rows.at(0).size());
  for (Index row = 0; row < matrix.rows(); ++row) {
    for (Index column = 0; column < matrix.cols(); ++column) matrix(row, column) = rows[row][column].get<float>();
  }
  return matrix;
}

VectorXf vectorFrom(const nlohmann::json& values) {
  VectorXf vector(values.size());
  for (Index index = 0; index < vector.size(); ++index) vector(index) = values[index].get<float>();
  return vector;
}

/// Caffe stacks the gates as input, forget, output, candidate; ours are input, output, forget, candidate.
template <typename Matrix>
Matrix fromCaffeGates(const Matrix& caffe) {
  const Index cells = caffe.rows() / 4;
  Matrix ours = caffe;
  ours.middleRows(cells, cells) = caffe.middleRows(2 * cells, cells);
  ours.middleRows(2 * cells, cells) = caffe.middleRows(cells, cells);
  return ours;
}

struct Steps {
  std::string mode;
  int reset_every;
};

class GoldenNetwork : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_REAL_DATA(goldenFolder());
    std::ifstream file(goldenFolder() / (GetParam() + "_weights.json"));
    const nlohmann::json weights = nlohmann::json::parse(file);
    const auto lstm = [&](const std::string& name) {
      return LstmLayer{fromCaffeGates(matrixFrom(weights.at(name + "_W_xc"))),
                       fromCaffeGates(matrixFrom(weights.at(name + "_W_hc"))),
                       fromCaffeGates(vectorFrom(weights.at(name + "_b_c"))), Activation::kTanh};
    };
    features_.assign(kFeatures, Network({lstm("lstm1"), lstm("lstm2")}));
    mixers_.emplace_back(LayerStack{DenseLayer{matrixFrom(weights.at("out_W")), vectorFrom(weights.at("out_b"))}});
  }

  VectorXf step(const std::vector<double>& row) {
    const Index cells = features_.front().outputSize();
    VectorXf hidden(kFeatures * cells);
    for (int feature = 0; feature < kFeatures; ++feature) {
      const VectorXf input = VectorXf::Constant(1, static_cast<float>(row.at(2 + feature)));
      hidden.segment(feature * cells, cells) = features_[feature].forward(input);
    }
    return mixers_.front().forward(hidden);
  }

  void expectFinalStates(const std::string& mode) const {
    const Rows rows = readCsv(goldenFolder() / (GetParam() + "_state_" + mode + ".csv"));
    const Index cells = features_.front().outputSize();
    ASSERT_EQ(rows.size(), 1u + 4 * kFeatures);
    // Four blocks of one row a feature: h1, c1, h2, c2, which is the order of our hidden state.
    for (int block = 0; block < 4; ++block) {
      for (int feature = 0; feature < kFeatures; ++feature) {
        const auto& row = rows[1 + block * kFeatures + feature];
        for (Index cell = 0; cell < cells; ++cell) {
          const double golden = row.at(2 + cell);
          // Cell states count up over the run, so their rounding is relative to their size.
          EXPECT_NEAR(features_[feature].hiddenState()(block * cells + cell), golden,
                      1e-4 * std::max(1.0, std::abs(golden)));
        }
      }
    }
  }

  std::vector<Network> features_;
  std::vector<Network> mixers_;
};

TEST_P(GoldenNetwork, EqualsTheAuthorsNetworkInAllModes) {
  const Rows inputs = readCsv(goldenFolder() / (GetParam() + "_inputs_300.csv"));
  ASSERT_EQ(inputs.size(), 301u);
  for (const Steps& steps : {Steps{"carry", 300}, Steps{"reset1", 1}, Steps{"reset10", 10}}) {
    const Rows golden = readCsv(goldenFolder() / (GetParam() + "_logits_" + steps.mode + ".csv"));
    const std::size_t header = golden.size() - 300;
    double largest = 0.0;
    for (int t = 0; t < 300; ++t) {
      if (t % steps.reset_every == 0) {
        for (Network& feature : features_) feature.reset();
      }
      const VectorXf logits = step(inputs[1 + t]);
      const auto& row = golden[header + t];
      const VectorXf expected = Eigen::Map<const Eigen::VectorXd>(row.data() + row.size() - 8, 8).cast<float>();
      largest = std::max(largest, double((logits - expected).cwiseAbs().maxCoeff()));
      Index ours = 0;
      Index theirs = 1;
      logits.maxCoeff(&ours);
      expected.maxCoeff(&theirs);
      ASSERT_EQ(ours, theirs) << steps.mode << ", row " << t;
    }
    EXPECT_LT(largest, 1e-4) << steps.mode;
    expectFinalStates(steps.mode);
  }
}

INSTANTIATE_TEST_SUITE_P(Thesis, GoldenNetwork,
                         testing::Values("lstm_2-8-512-11_iter367500", "lstm_ceil_2-16-2048-11_iter180000"),
                         [](const auto& info) { return std::string(info.index == 0 ? "EightCells" : "SixteenCells"); });

}  // namespace
}  // namespace lstm_planner
