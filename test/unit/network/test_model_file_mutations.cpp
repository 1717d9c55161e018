#include <random>

#include "lstm_planner/network/network.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "unit/network/model_file_fixtures.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner::test_model_file_mutations {
namespace {

using test::LayerMaker;

class ModelFileMutations : public test::ModelFileTest {
 protected:
  enum class Outcome { kRead, kRefused };

  /// Anything but a network that runs or a ModelFileError ends the test.
  Outcome readMutation(const std::string& bytes) {
    writeBytes(bytes);
    try {
      Network network(readModelFile(path_).layers);
      try {
        network.forward(Eigen::VectorXf::Ones(network.inputSize()));
      } catch (const std::invalid_argument&) {
        // A mutated weight may be finite and yet overflow a sum.
      }
      return Outcome::kRead;
    } catch (const ModelFileError&) {
      return Outcome::kRefused;
    }
  }

  std::string validFile() {
    LayerMaker make(1);
    layers_ = {make.dense(3, 2, Activation::kRelu), make.lstm(2, 2, Activation::kSigmoid), make.recurrent(2, 2),
               make.dense(2, 2), SoftmaxLayer{}};
    writeModelFile(path_, {layers_, {{"key", "value"}}});
    return readBytes();
  }

  LayerStack layers_;  ///< of the valid file
};

TEST_F(ModelFileMutations, AFlippedBitChangesOneWeightWhereItIsOneOfAWeightAndNeverTheSizes) {
  const std::string valid = validFile();
  const Eigen::VectorXf weights = parameterVector(layers_);
  int bytes_of_weights = 0;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    std::string bytes = valid;
    bytes[i] = static_cast<char>(bytes[i] ^ 1);
    writeBytes(bytes);
    try {
      const LayerStack layers = readModelFile(path_).layers;
      ASSERT_EQ(layers.size(), layers_.size()) << "byte " << i;
      const Eigen::VectorXf read = parameterVector(layers);
      ASSERT_EQ(read.size(), weights.size()) << "byte " << i;
      bytes_of_weights += (read.array() != weights.array()).count() == 1 ? 1 : 0;
    } catch (const ModelFileError& error) {
      EXPECT_NE(std::string(error.what()).find(path_), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(bytes_of_weights, 4 * weights.size());
}

TEST_F(ModelFileMutations, ChangedBytesAreReadOrRefused) {
  const std::string valid = validFile();
  std::mt19937 random(20);
  int read = 0;
  int refused = 0;
  for (int round = 0; round < 6000; ++round) {
    std::string bytes = valid;
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int change = 0; change < changes; ++change) bytes[random() % bytes.size()] = static_cast<char>(random());
    (readMutation(bytes) == Outcome::kRead ? read : refused) += 1;
  }
  // Both must have been met.
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 100);
}

TEST_F(ModelFileMutations, RemovedRepeatedAndExchangedPiecesAreReadOrRefused) {
  const std::string valid = validFile();
  std::mt19937 random(21);
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = valid;
    const std::size_t from = random() % bytes.size();
    const std::size_t to = random() % bytes.size();
    const std::string piece = valid.substr(from, random() % 40);
    if (round % 3 == 0) bytes.erase(from, piece.size());
    if (round % 3 == 1) bytes.insert(to, piece);
    if (round % 3 == 2) bytes.replace(to, piece.size(), piece);
    readMutation(bytes);
  }
}

TEST_F(ModelFileMutations, GarbageIsRefused) {
  std::mt19937 random(22);
  for (int round = 0; round < 1000; ++round) {
    std::string bytes(random() % 300, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    EXPECT_EQ(readMutation(bytes), Outcome::kRefused);
  }
}

}  // namespace
}  // namespace lstm_planner::test_model_file_mutations
