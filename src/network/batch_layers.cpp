#include "network/batch_layers.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace lstm_planner {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::VectorXf;

/// A little below the largest float, for what rounding adds.
constexpr double kLargestSum = std::numeric_limits<float>::max() / 4.0;

/// The weighted sums of a layer in the order in which the kernels make them, a whole number of blocks.
struct Product {
  MatrixXf weights;  ///< of the layer's inputs, then of its last outputs
  VectorXf bias;
};

/// From the ONNX operator's order, gate by gate, to cell by cell.
Product lstmProduct(const LstmLayer& layer) {
  const Index cells = layer.recurrent.cols();
  const Index inputs = layer.input.cols();
  Product product{MatrixXf(4 * cells, inputs + cells), VectorXf(4 * cells)};
  for (Index gate = 0; gate < 4; ++gate) {
    const float scale = gate < 3 || layer.candidate == Activation::kSigmoid ? 0.5f : 1.0f;
    for (Index cell = 0; cell < cells; ++cell) {
      const Index from = gate * cells + cell;
      const Index to = cell * 4 + gate;
      product.weights.row(to) << scale * layer.input.row(from), scale * layer.recurrent.row(from);
      product.bias[to] = scale * layer.bias[from];
    }
  }
  return product;
}

Product unitProduct(const MatrixXf& input, const MatrixXf& recurrent, const VectorXf& bias, float scale) {
  const Index units = bias.size();
  const Index rows = (units + kBatchBlock - 1) / kBatchBlock * kBatchBlock;
  Product product{MatrixXf::Zero(rows, input.cols() + recurrent.cols()), VectorXf::Zero(rows)};
  product.weights.topLeftCorner(units, input.cols()) = scale * input;
  product.weights.topRightCorner(units, recurrent.cols()) = scale * recurrent;
  product.bias.head(units) = scale * bias;
  return product;
}

BatchFunction unitFunction(Activation activation) {
  switch (activation) {
    case Activation::kTanh:
      return BatchFunction::kTanh;
    case Activation::kSigmoid:
      return BatchFunction::kSigmoid;
    case Activation::kRelu:
      return BatchFunction::kRelu;
    case Activation::kIdentity:
      break;
  }
  return BatchFunction::kIdentity;
}

/// Packs one layer after the other.
class Packer {
 public:
  explicit Packer(int inputs) : width_(inputs) { packed_.rows = inputs; }

  void operator()(const LstmLayer& layer) {
    const int cells = static_cast<int>(layer.recurrent.cols());
    const bool sigmoid = layer.candidate == Activation::kSigmoid;
    BatchLayer packed = begin(sigmoid ? BatchFunction::kLstmWithSigmoidCandidate : BatchFunction::kLstm, cells, true);
    packed.cell_row = takeRows(cells);
    remember(packed.cell_row, packed.cell_row, cells);
    append(lstmProduct(layer), packed);
  }
  void operator()(const RecurrentLayer& layer) {
    append(unitProduct(layer.input, layer.recurrent, layer.bias, 1.0f),
           begin(BatchFunction::kTanh, static_cast<int>(layer.bias.size()), true));
  }
  void operator()(const DenseLayer& layer) {
    const float scale = layer.activation == Activation::kSigmoid ? 0.5f : 1.0f;
    append(unitProduct(layer.weights, MatrixXf(layer.weights.rows(), 0), layer.bias, scale),
           begin(unitFunction(layer.activation), static_cast<int>(layer.bias.size()), false));
  }
  void operator()(const SoftmaxLayer& /*layer*/) { append({}, begin(BatchFunction::kSoftmax, width_, false)); }

  BatchLayers finish() {
    packed_.input_limit = static_cast<float>(input_limit_);
    packed_.weights.shrink_to_fit();
    return std::move(packed_);
  }

 private:
  int takeRows(int count) { return std::exchange(packed_.rows, packed_.rows + count); }

  void remember(int even_row, int odd_row, int count) {
    for (int i = 0; i < count; ++i) {
      packed_.state_rows[0].push_back(even_row + i);
      packed_.state_rows[1].push_back(odd_row + i);
    }
  }

  BatchLayer begin(BatchFunction function, int outputs, bool recurrent) {
    BatchLayer layer = {};
    layer.function = function;
    layer.inputs = width_;
    layer.recurrent = recurrent ? outputs : 0;
    layer.outputs = outputs;
    std::copy_n(input_row_, 2, layer.input_row);
    layer.output_row[0] = takeRows(outputs);
    layer.output_row[1] = recurrent ? takeRows(outputs) : layer.output_row[0];
    if (recurrent) remember(layer.output_row[1], layer.output_row[0], outputs);
    return layer;
  }

  void append(const Product& product, BatchLayer layer) {
    if (product.bias.size() > 0) limitInput(product, layer);
    layer.weights = appendBlocks(product.weights);
    layer.bias = appendBlocks(product.bias);
    packed_.layers.push_back(layer);
    width_ = layer.outputs;
    std::copy_n(layer.output_row, 2, input_row_);
  }

  /// kBatchBlock rows at a time, column by column.
  long appendBlocks(const MatrixXf& rows) {
    const long begin = static_cast<long>(packed_.weights.size());
    for (Index block = 0; block < rows.rows(); block += kBatchBlock) {
      for (Index column = 0; column < rows.cols(); ++column) {
        for (Index row = block; row < block + kBatchBlock; ++row) packed_.weights.push_back(rows(row, column));
      }
    }
    return begin;
  }

  /// The sums are at most slope * largest input + offset. What follows a layer that saturates does not depend on the
  /// input's size.
  void limitInput(const Product& product, const BatchLayer& layer) {
    const MatrixXf weights = product.weights.cwiseAbs();
    const double by_input = weights.leftCols(layer.inputs).cast<double>().rowwise().sum().maxCoeff();
    const double by_state = weights.rightCols(layer.recurrent).cast<double>().rowwise().sum().maxCoeff();
    const double slope = by_input * slope_;
    const double offset = by_input * offset_ + by_state * kLargestState + product.bias.cwiseAbs().maxCoeff();
    if (!(offset < kLargestSum)) {
      throw std::invalid_argument("the network's weights are too large: a weighted sum may leave the range of float");
    }
    if (slope > 0.0) input_limit_ = std::min(input_limit_, (kLargestSum - offset) / slope);
    const bool keeps_size = layer.function == BatchFunction::kIdentity || layer.function == BatchFunction::kRelu;
    slope_ = keeps_size ? slope : 0.0;
    offset_ = keeps_size ? offset : 1.0;
  }

  BatchLayers packed_;
  int width_;                  ///< of what the next layer gets
  int input_row_[2] = {0, 0};  ///< where it is
  double slope_ = 1.0;         ///< how large it is at most
  double offset_ = 0.0;
  double input_limit_ = kLargestSum;
};

}  // namespace

BatchLayers packBatchLayers(const LayerStack& layers) {
  validateLayers(layers);
  Packer packer(inputSize(layers));
  for (const Layer& layer : layers) std::visit(packer, layer);
  return packer.finish();
}

}  // namespace lstm_planner
