#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "support/real_data.hpp"
#include "support/thesis_network.hpp"

namespace lstm_planner::test_network_golden {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::VectorXf;
using Rows = std::vector<std::vector<double>>;

constexpr int kFeatures = ThesisNetwork::kInputs;

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

struct Steps {
  std::string mode;
  int reset_every;
};

class GoldenNetwork : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_REAL_DATA(goldenFolder());
    network_.emplace(goldenFolder(), GetParam());
  }

  VectorXf step(const std::vector<double>& row) {
    std::array<float, ThesisNetwork::kInputs> inputs{};
    for (std::size_t i = 0; i < inputs.size(); ++i) inputs[i] = static_cast<float>(row.at(2 + i));
    return network_->forward(inputs);
  }

  void expectFinalStates(const std::string& mode) const {
    const Rows rows = readCsv(goldenFolder() / (GetParam() + "_state_" + mode + ".csv"));
    const Index cells = network_->cells();
    ASSERT_EQ(rows.size(), 1u + 4 * kFeatures);
    // Four blocks of one row a feature: h1, c1, h2, c2, which is the order of our hidden state.
    for (int block = 0; block < 4; ++block) {
      for (int feature = 0; feature < kFeatures; ++feature) {
        const auto& row = rows[1 + block * kFeatures + feature];
        for (Index cell = 0; cell < cells; ++cell) {
          const double golden = row.at(2 + cell);
          // Cell states count up over the run, so their rounding is relative to their size.
          EXPECT_NEAR(network_->hiddenState(feature)(block * cells + cell), golden,
                      1e-4 * std::max(1.0, std::abs(golden)));
        }
      }
    }
  }

  std::optional<ThesisNetwork> network_;
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
        network_->reset();
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
}  // namespace lstm_planner::test_network_golden
