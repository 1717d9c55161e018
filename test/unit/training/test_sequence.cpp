#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "lstm_planner/training/sequence.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_sequence {
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
  EXPECT_NE(complaint(sequence).find("weight -1 at step 2"), std::string::npos);
  sequence = goodSequence();
  sequence.labels[3] = 2;
  EXPECT_EQ(complaint(sequence), "training sequence 1: has label 2 at step 3, expected one in [0, 2)");
}

/// The inputs are the numbers of the steps.
Sequence episodeOf(int steps) {
  Sequence episode{Eigen::MatrixXf(1, steps), Eigen::VectorXi::Zero(steps), Eigen::VectorXf::Ones(steps)};
  for (int step = 0; step < steps; ++step) episode.inputs(0, step) = static_cast<float>(step);
  return episode;
}

/// First step, steps and steps without weight of each piece.
using Pieces = std::vector<std::vector<int>>;
Pieces piecesOf(int steps, const SequenceCut& cut) {
  std::vector<Sequence> pieces;
  cutIntoPieces(episodeOf(steps), cut, &pieces);
  Pieces found;
  for (const Sequence& piece : pieces) {
    const auto length = static_cast<int>(piece.steps());
    const int counted = static_cast<int>(piece.weights.sum());
    EXPECT_EQ(piece.weights.tail(counted).sum(), static_cast<float>(counted)) << "those without weight come first";
    EXPECT_EQ(piece.labels.size(), length);
    found.push_back({static_cast<int>(piece.inputs(0, 0)), length, length - counted});
  }
  return found;
}

TEST(CutIntoPieces, EachStepHasItsWeightInOnePiece) {
  EXPECT_EQ(piecesOf(10, {4, 4, 0}), (Pieces{{0, 4, 0}, {4, 4, 0}, {8, 2, 0}}));
  EXPECT_EQ(piecesOf(10, {4, 4, 2}), (Pieces{{0, 4, 0}, {2, 6, 2}, {6, 4, 2}}));
  EXPECT_EQ(piecesOf(10, {4, 4, 6}), (Pieces{{0, 4, 0}, {0, 8, 4}, {2, 8, 6}})) << "there are no more before";
  EXPECT_EQ(piecesOf(4, {4, 4, 2}), (Pieces{{0, 4, 0}}));
  EXPECT_TRUE(piecesOf(0, {4, 4, 2}).empty());
}

TEST(CutIntoPieces, OverlappingPiecesAreOfOneLength) {
  EXPECT_EQ(piecesOf(10, overlappingPieces(6, 2)), (Pieces{{0, 6, 0}, {4, 6, 2}}));
}

TEST(Sequence, StepsWithWeightAreCounted) {
  Sequence sequence = goodSequence();
  sequence.weights << 0.0f, 0.5f, 2.0f, 0.0f;
  EXPECT_EQ(countWeighted({sequence, goodSequence()}), 6u);
  EXPECT_EQ(sequencesWithSteps(9, {sequence, goodSequence()}), 3);
  EXPECT_EQ(sequencesWithSteps(1, {sequence, goodSequence()}), 1);
}

}  // namespace
}  // namespace lstm_planner::test_sequence
