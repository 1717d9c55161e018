#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "lstm_planner/base/learning/sequence.hpp"
#include "support/refusal.hpp"

namespace lstm_planner {
namespace {

Sequence goodSequence() { return {Eigen::MatrixXf::Zero(3, 4), Eigen::VectorXi::Zero(4), Eigen::VectorXf::Ones(4)}; }

/// What is said about a second sequence after a good one; empty when nothing.
std::string complaint(const Sequence& sequence) {
  return test::refusalOf<std::invalid_argument>([&] {
    validateSequences({goodSequence(), sequence}, 3, 2, "training");
  });
}

TEST(Sequence, GoodOnesPass) { EXPECT_EQ(complaint(goodSequence()), ""); }

TEST(Sequence, LabelsOfStepsWithoutWeightAreNotLookedAt) {
  Sequence sequence = goodSequence();
  sequence.labels[1] = -1;
  EXPECT_EQ(complaint(sequence), "training sequence 1: has label -1 at step 1, expected one in [0, 2)");
  sequence.weights[1] = 0.0f;
  EXPECT_EQ(complaint(sequence), "");
}

TEST(Sequence, BadOnesAreNamed) {
  EXPECT_EQ(complaint({Eigen::MatrixXf(3, 0), Eigen::VectorXi(0), Eigen::VectorXf(0)}),
            "training sequence 1: has no steps, expected at least one");
  Sequence sequence = goodSequence();
  sequence.inputs = Eigen::MatrixXf::Zero(5, 4);
  EXPECT_EQ(complaint(sequence), "training sequence 1: has 5 features, the network expects 3");
  sequence = goodSequence();
  sequence.labels = Eigen::VectorXi::Zero(3);
  EXPECT_EQ(complaint(sequence), "training sequence 1: has 3 labels and 4 weights, expected 4 of each, one a step");
  sequence = goodSequence();
  sequence.inputs(2, 3) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(complaint(sequence), "training sequence 1: has an input that is not finite");
  sequence = goodSequence();
  sequence.weights[2] = -1.0f;
  EXPECT_NE(complaint(sequence).find("weight -1.000000 at step 2"), std::string::npos);
  sequence = goodSequence();
  sequence.labels[3] = 2;
  EXPECT_EQ(complaint(sequence), "training sequence 1: has label 2 at step 3, expected one in [0, 2)");
}

}  // namespace
}  // namespace lstm_planner
