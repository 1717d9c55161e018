#include "training/layer_gradient.hpp"

namespace lstm_planner {
namespace {

using Eigen::Index;

template <typename Scalar>
using Matrix = typename LayerGradient<Scalar>::Matrix;
template <typename Scalar>
using ConstantMap = Eigen::Map<const Matrix<Scalar>>;
template <typename Scalar>
using VariableMap = Eigen::Map<Matrix<Scalar>>;
template <typename Scalar>
using BiasMap = Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>;
template <typename Scalar>
using BiasGradientMap = Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>;

template <typename Scalar>
ConstantMap<Scalar> columnsOf(const Matrix<Scalar>& matrix, Index first, Index width) {
  return {matrix.data() + first * matrix.rows(), matrix.rows(), width};
}

template <typename Scalar>
VariableMap<Scalar> columnsOf(Matrix<Scalar>* matrix, Index first, Index width) {
  return {matrix->data() + first * matrix->rows(), matrix->rows(), width};
}

// Eigen's products take seconds to compile for each type of their factors, so each of the three has one.

/// sum += a * b
template <typename Scalar>
void addProduct(const ConstantMap<Scalar>& a, const ConstantMap<Scalar>& b, VariableMap<Scalar> sum) {
  sum.noalias() += a * b;
}

/// sum += a^T * b
template <typename Scalar>
void addTransposedProduct(const ConstantMap<Scalar>& a, const ConstantMap<Scalar>& b, VariableMap<Scalar> sum) {
  sum.noalias() += a.transpose() * b;
}

/// sum += a * b^T
template <typename Scalar>
void addProductTransposed(const ConstantMap<Scalar>& a, const ConstantMap<Scalar>& b, VariableMap<Scalar> sum) {
  sum.noalias() += a * b.transpose();
}

/// The logistic function by way of tanh, which Eigen vectorises in every version.
template <typename Array>
auto sigmoid(const Array& x) {
  using Scalar = typename Array::Scalar;
  return (x * Scalar(0.5)).tanh() * Scalar(0.5) + Scalar(0.5);
}

template <typename Block>
void activate(Activation activation, Block values) {
  using Scalar = typename Block::Scalar;
  if (activation == Activation::kTanh) values.array() = values.array().tanh();
  if (activation == Activation::kSigmoid) values.array() = sigmoid(values.array());
  if (activation == Activation::kRelu) values.array() = values.array().max(Scalar(0));
}

/// Multiplies `gradient` by the activation's derivative, written in terms of its result.
template <typename Block, typename Results>
void multiplyByDerivative(Activation activation, const Results& results, Block gradient) {
  using Scalar = typename Block::Scalar;
  const auto y = results.array();
  if (activation == Activation::kTanh) gradient.array() *= Scalar(1) - y * y;
  if (activation == Activation::kSigmoid) gradient.array() *= y * (Scalar(1) - y);
  if (activation == Activation::kRelu) gradient.array() *= (y > Scalar(0)).template cast<Scalar>();
}

/// Weights that act on what comes from below, for all columns at once: the same for each kind of layer.
template <typename Scalar>
class InputConnection {
 public:
  using Matrix = typename LayerGradient<Scalar>::Matrix;

  InputConnection(Index units, Index inputs) : units_(units), inputs_(inputs) {}

  Index weights() const { return units_ * inputs_; }
  Index units() const { return units_; }

  void forward(const Scalar* weights, const Scalar* bias, Index columns, const Matrix& inputs, Matrix& sums) const {
    reserveColumns(units_, columns, sums);
    sums.leftCols(columns).colwise() = BiasMap<Scalar>(bias, units_);
    addProduct<Scalar>({weights, units_, inputs_}, columnsOf<Scalar>(inputs, 0, columns),
                       columnsOf<Scalar>(&sums, 0, columns));
  }

  void backward(const Scalar* weights, Index columns, const Matrix& inputs, const Matrix& sum_gradient,
                Scalar* weight_gradient, Scalar* bias_gradient, Matrix* input_gradient) const {
    const ConstantMap<Scalar> gradient = columnsOf<Scalar>(sum_gradient, 0, columns);
    addProductTransposed<Scalar>(gradient, columnsOf<Scalar>(inputs, 0, columns), {weight_gradient, units_, inputs_});
    BiasGradientMap<Scalar>(bias_gradient, units_) += gradient.rowwise().sum();
    if (input_gradient == nullptr) return;
    reserveColumns(inputs_, columns, *input_gradient);
    input_gradient->leftCols(columns).setZero();
    addTransposedProduct<Scalar>({weights, units_, inputs_}, gradient, columnsOf<Scalar>(input_gradient, 0, columns));
  }

 private:
  Index units_;
  Index inputs_;
};

template <typename Scalar>
class DenseGradient : public LayerGradient<Scalar> {
 public:
  using typename LayerGradient<Scalar>::Matrix;

  explicit DenseGradient(const DenseLayer& layer)
      : connection_(layer.weights.rows(), layer.weights.cols()), activation_(layer.activation) {}

  Index parameterCount() const override { return connection_.weights() + connection_.units(); }

  void forward(const Scalar* parameters, const StepLayout& layout, const Matrix& inputs) override {
    const Scalar* bias = parameters + connection_.weights();
    connection_.forward(parameters, bias, layout.columns, inputs, this->outputs_);
    activate(activation_, this->outputs_.leftCols(layout.columns));
  }

  void backward(const Scalar* parameters, const StepLayout& layout, const Matrix& inputs, Matrix& output_gradient,
                Scalar* gradient, Matrix* input_gradient) override {
    multiplyByDerivative(activation_, this->outputs_.leftCols(layout.columns),
                         output_gradient.leftCols(layout.columns));
    connection_.backward(parameters, layout.columns, inputs, output_gradient, gradient,
                         gradient + connection_.weights(), input_gradient);
  }

 private:
  InputConnection<Scalar> connection_;
  Activation activation_;
};

/// What the two recurrent kinds share: outputs of the step before, as columns beside those they go into.
template <typename Scalar>
class RecurrentGradientBase : public LayerGradient<Scalar> {
 public:
  using typename LayerGradient<Scalar>::Matrix;

  RecurrentGradientBase(Index units, Index cells, Index inputs) : connection_(units, inputs), cells_(cells) {}

  Index parameterCount() const override {
    return connection_.weights() + connection_.units() * cells_ + connection_.units();
  }

  void forward(const Scalar* parameters, const StepLayout& layout, const Matrix& inputs) override {
    const ConstantMap<Scalar> recurrent(parameters + connection_.weights(), connection_.units(), cells_);
    connection_.forward(parameters, parameters + biasOffset(), layout.columns, inputs, sums_);
    reserveColumns(cells_, layout.columns, this->outputs_);
    reserveColumns(cells_, layout.columns, previous_outputs_);
    reserveStates(layout.columns);
    previous_outputs_.leftCols(layout.width[0]).setZero();
    for (std::size_t step = 0; step < layout.steps(); ++step) {
      const Index first = layout.first[step];
      const Index width = layout.width[step];
      if (step > 0) {
        previous_outputs_.middleCols(first, width) = this->outputs_.middleCols(layout.first[step - 1], width);
        addProduct<Scalar>(recurrent, columnsOf<Scalar>(previous_outputs_, first, width),
                           columnsOf<Scalar>(&sums_, first, width));
      }
      forwardStep(first, width, step > 0 ? layout.first[step - 1] : Index(-1));
    }
  }

  void backward(const Scalar* parameters, const StepLayout& layout, const Matrix& inputs, Matrix& output_gradient,
                Scalar* gradient, Matrix* input_gradient) override {
    const ConstantMap<Scalar> recurrent(parameters + connection_.weights(), connection_.units(), cells_);
    prepareBackward(layout.width[0]);
    for (std::size_t step = layout.steps(); step-- > 0;) {
      const Index first = layout.first[step];
      const Index width = layout.width[step];
      const Index previous = step > 0 ? layout.first[step - 1] : Index(-1);
      backwardStep(first, width, previous, output_gradient.middleCols(first, width));
      if (step > 0) {
        addTransposedProduct<Scalar>(recurrent, columnsOf<Scalar>(sums_, first, width),
                                     columnsOf<Scalar>(&output_gradient, previous, width));
      }
    }
    connection_.backward(parameters, layout.columns, inputs, sums_, gradient, gradient + biasOffset(), input_gradient);
    addProductTransposed<Scalar>(columnsOf<Scalar>(sums_, 0, layout.columns),
                                 columnsOf<Scalar>(previous_outputs_, 0, layout.columns),
                                 {gradient + connection_.weights(), connection_.units(), cells_});
  }

 protected:
  using Columns = Eigen::Block<Matrix, Eigen::Dynamic, Eigen::Dynamic, true>;

  virtual void reserveStates(Index columns) = 0;
  virtual void prepareBackward(Index width) = 0;

  /// From the sums of a step to its outputs. `previous` is the first column of the step before, -1 when there is none.
  virtual void forwardStep(Index first, Index width, Index previous) = 0;

  /// From the derivative by a step's outputs to that by its sums, which takes the sums' place.
  virtual void backwardStep(Index first, Index width, Index previous, Columns output_gradient) = 0;

  Index cells() const { return cells_; }

  Matrix sums_;

 private:
  Index biasOffset() const { return connection_.weights() + connection_.units() * cells_; }

  InputConnection<Scalar> connection_;
  Index cells_;
  Matrix previous_outputs_;
};

template <typename Scalar>
class RecurrentGradient : public RecurrentGradientBase<Scalar> {
 public:
  using typename RecurrentGradientBase<Scalar>::Columns;

  explicit RecurrentGradient(const RecurrentLayer& layer)
      : RecurrentGradientBase<Scalar>(layer.input.rows(), layer.input.rows(), layer.input.cols()) {}

 protected:
  void reserveStates(Index) override {}
  void prepareBackward(Index) override {}

  void forwardStep(Index first, Index width, Index) override {
    this->outputs_.middleCols(first, width).array() = this->sums_.middleCols(first, width).array().tanh();
  }

  void backwardStep(Index first, Index width, Index, Columns output_gradient) override {
    multiplyByDerivative(Activation::kTanh, this->outputs_.middleCols(first, width), output_gradient);
    this->sums_.middleCols(first, width) = output_gradient;
  }
};

/// The rows of the sums are the gates in the order of LstmLayer: input, output, forget, candidate.
template <typename Scalar>
class LstmGradient : public RecurrentGradientBase<Scalar> {
 public:
  using typename LayerGradient<Scalar>::Matrix;
  using typename RecurrentGradientBase<Scalar>::Columns;

  explicit LstmGradient(const LstmLayer& layer)
      : RecurrentGradientBase<Scalar>(layer.input.rows(), layer.input.rows() / 4, layer.input.cols()),
        candidate_(layer.candidate) {}

 protected:
  void reserveStates(Index columns) override {
    reserveColumns(this->cells(), columns, states_);
    reserveColumns(this->cells(), columns, squashed_states_);
  }

  void prepareBackward(Index width) override { state_gradient_.setZero(this->cells(), width); }

  void forwardStep(Index first, Index width, Index previous) override {
    const Index cells = this->cells();
    auto gates = this->sums_.middleCols(first, width);
    activate(Activation::kSigmoid, gates.topRows(3 * cells));
    activate(candidate_, gates.bottomRows(cells));
    auto state = states_.middleCols(first, width).array();
    state = gates.topRows(cells).array() * gates.bottomRows(cells).array();
    if (previous >= 0)
      state += gates.middleRows(2 * cells, cells).array() * states_.middleCols(previous, width).array();
    auto squashed = squashed_states_.middleCols(first, width).array();
    squashed = state.tanh();
    this->outputs_.middleCols(first, width).array() = squashed * gates.middleRows(cells, cells).array();
  }

  void backwardStep(Index first, Index width, Index previous, Columns output_gradient) override {
    const Index cells = this->cells();
    auto gates = this->sums_.middleCols(first, width);
    auto input = gates.topRows(cells).array();
    auto output = gates.middleRows(cells, cells).array();
    auto forget = gates.middleRows(2 * cells, cells).array();
    auto candidate = gates.bottomRows(cells).array();
    auto squashed = squashed_states_.middleCols(first, width).array();
    auto state_gradient = state_gradient_.leftCols(width).array();

    state_gradient += output_gradient.array() * output * (Scalar(1) - squashed * squashed);
    output = output_gradient.array() * squashed * output * (Scalar(1) - output);
    // The outputs' derivative has been used; gates are factors of each other's derivatives, so new values wait here.
    auto scratch = output_gradient.array();
    scratch = state_gradient * input;
    input = state_gradient * candidate * input * (Scalar(1) - input);
    multiplyByDerivative(candidate_, candidate.matrix(), scratch.matrix());
    candidate = scratch;
    if (previous < 0) {
      forget.setZero();
      return;
    }
    scratch = state_gradient * forget;
    forget = scratch * states_.middleCols(previous, width).array() * (Scalar(1) - forget);
    state_gradient = scratch;
  }

 private:
  Activation candidate_;
  Matrix states_;
  Matrix squashed_states_;
  Matrix state_gradient_;  ///< of the states of the sequences that run at the step
};

}  // namespace

template <typename Scalar>
std::unique_ptr<LayerGradient<Scalar>> makeLayerGradient(const Layer& layer) {
  if (const auto* lstm = std::get_if<LstmLayer>(&layer)) return std::make_unique<LstmGradient<Scalar>>(*lstm);
  if (const auto* plain = std::get_if<RecurrentLayer>(&layer))
    return std::make_unique<RecurrentGradient<Scalar>>(*plain);
  if (const auto* dense = std::get_if<DenseLayer>(&layer)) return std::make_unique<DenseGradient<Scalar>>(*dense);
  return nullptr;
}

template std::unique_ptr<LayerGradient<float>> makeLayerGradient<float>(const Layer&);
template std::unique_ptr<LayerGradient<double>> makeLayerGradient<double>(const Layer&);

}  // namespace lstm_planner
