#include "lstm_planner/training/gradient.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "training/layer_gradient.hpp"

namespace lstm_planner {

using Eigen::Index;

LossSum& LossSum::operator+=(const LossSum& other) {
  loss += other.loss;
  weight += other.weight;
  if (confusion.size() == 0) {
    confusion = other.confusion;
  } else if (other.confusion.size() != 0) {
    confusion += other.confusion;
  }
  return *this;
}

double LossSum::meanLoss() const { return weight > 0.0 ? loss / weight : 0.0; }

double LossSum::accuracy() const {
  const std::int64_t steps = confusion.sum();
  return steps > 0 ? static_cast<double>(confusion.trace()) / static_cast<double>(steps) : 0.0;
}

template <typename Scalar>
class SequenceGradient<Scalar>::Implementation {
 public:
  using Matrix = typename LayerGradient<Scalar>::Matrix;

  Implementation(const LayerStack& layers, Loss loss) : loss_(loss) {
    validateLayers(layers);
    for (std::size_t index = 0; index < layers.size(); ++index) {
      auto layer = makeLayerGradient<Scalar>(layers[index]);
      if (layer) {
        parameter_count_ += layer->parameterCount();
        layers_.push_back(std::move(layer));
      } else if (index + 1 != layers.size() || index == 0) {
        throw std::invalid_argument("layer " + std::to_string(index) +
                                    " is a softmax, which can only be trained as the last of several layers");
      } else if (loss == Loss::kEuclidean) {
        throw std::invalid_argument("the last layer is a softmax, which cannot be trained with the Euclidean loss");
      }
    }
    inputs_.resize(inputSize(layers), 0);
  }

  Index parameterCount() const { return parameter_count_; }

  LossSum evaluate(const Vector& parameters, const std::vector<const Sequence*>& batch, Vector* gradient) {
    if (gradient != nullptr) gradient->setZero(parameter_count_);
    LossSum sum;
    if (batch.empty()) return sum;
    pack(batch);
    forward(parameters);
    sum = countAnswers();
    loss_ == Loss::kEuclidean ? addEuclidean(&sum) : addCrossEntropy(&sum);
    if (gradient != nullptr) backward(parameters, nullptr, *gradient);
    return sum;
  }

  Matrix inputGradient(const Vector& parameters, const Sequence& sequence, const Matrix& factors) {
    pack({&sequence});
    forward(parameters);
    if (factors.rows() != preferences().rows() || factors.cols() != layout_.columns) {
      throw std::invalid_argument("factors are " + std::to_string(factors.rows()) + " x " +
                                  std::to_string(factors.cols()) + ", expected " +
                                  std::to_string(preferences().rows()) + " x " + std::to_string(layout_.columns));
    }
    reserveColumns(factors.rows(), layout_.columns, output_gradient_);
    output_gradient_.leftCols(layout_.columns) = factors;
    Vector unused = Vector::Zero(parameter_count_);
    Matrix by_inputs;
    backward(parameters, &by_inputs, unused);
    return by_inputs.leftCols(layout_.columns);
  }

  const Matrix& preferences() const { return layers_.back()->outputs(); }

 private:
  /// Longest first; equally long ones keep their order, so that nothing depends on the sorting algorithm.
  void pack(std::vector<const Sequence*> batch) {
    std::stable_sort(batch.begin(), batch.end(),
                     [](const Sequence* a, const Sequence* b) { return a->steps() > b->steps(); });
    layout_ = {};
    for (Index step = 0, running = static_cast<Index>(batch.size()); step < batch.front()->steps(); ++step) {
      while (batch[static_cast<std::size_t>(running - 1)]->steps() <= step) --running;
      layout_.first.push_back(layout_.columns);
      layout_.width.push_back(running);
      layout_.columns += running;
    }
    reserveColumns(inputs_.rows(), layout_.columns, inputs_);
    labels_.resize(layout_.columns);
    weights_.resize(layout_.columns);
    for (std::size_t sequence = 0; sequence < batch.size(); ++sequence) {
      for (Index step = 0; step < batch[sequence]->steps(); ++step) {
        const Index column = layout_.first[static_cast<std::size_t>(step)] + static_cast<Index>(sequence);
        inputs_.col(column) = batch[sequence]->inputs.col(step).template cast<Scalar>();
        labels_[column] = batch[sequence]->labels[step];
        weights_[column] = batch[sequence]->weights[step];
      }
    }
  }

  const Matrix& inputsOf(std::size_t layer) const { return layer == 0 ? inputs_ : layers_[layer - 1]->outputs(); }

  void forward(const Vector& parameters) {
    const Scalar* own = parameters.data();
    for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
      layers_[layer]->forward(own, layout_, inputsOf(layer));
      own += layers_[layer]->parameterCount();
    }
  }

  LossSum countAnswers() {
    const Matrix& preferences = layers_.back()->outputs();
    const Index outputs = preferences.rows();
    LossSum sum;
    sum.confusion.setZero(outputs, outputs);
    largest_.resize(layout_.columns);
    for (Index column = 0; column < layout_.columns; ++column) {
      Index answer = 0;
      largest_[column] = preferences.col(column).maxCoeff(&answer);
      if (weights_[column] > 0.0f) ++sum.confusion(labels_[column], answer);
    }
    reserveColumns(outputs, layout_.columns, output_gradient_);
    return sum;
  }

  /// With the softmax; leaves the derivative by the preferences in output_gradient_, as addEuclidean() does.
  void addCrossEntropy(LossSum* sum) {
    const Matrix& preferences = layers_.back()->outputs();
    auto gradient = output_gradient_.leftCols(layout_.columns);
    gradient = preferences.leftCols(layout_.columns).rowwise() - largest_.transpose();
    gradient.array() = gradient.array().exp();
    for (Index column = 0; column < layout_.columns; ++column) {
      const Scalar weight = static_cast<Scalar>(weights_[column]);
      if (!(weight > Scalar(0))) {
        gradient.col(column).setZero();
        continue;
      }
      const Index label = labels_[column];
      const Scalar total = gradient.col(column).sum();
      sum->loss += static_cast<double>(weight) * (std::log(static_cast<double>(total)) -
                                                  static_cast<double>(preferences(label, column) - largest_[column]));
      sum->weight += static_cast<double>(weight);
      gradient.col(column) *= weight / total;
      gradient(label, column) -= weight;
    }
  }

  void addEuclidean(LossSum* sum) {
    auto gradient = output_gradient_.leftCols(layout_.columns);
    gradient = layers_.back()->outputs().leftCols(layout_.columns);
    for (Index column = 0; column < layout_.columns; ++column) {
      const Scalar weight = static_cast<Scalar>(weights_[column]);
      if (!(weight > Scalar(0))) {
        gradient.col(column).setZero();
        continue;
      }
      gradient(labels_[column], column) -= Scalar(1);
      sum->loss += static_cast<double>(weight) * 0.5 * static_cast<double>(gradient.col(column).squaredNorm());
      sum->weight += static_cast<double>(weight);
      gradient.col(column) *= weight;
    }
  }

  /// From output_gradient_ down; `by_inputs` are not wanted when null.
  void backward(const Vector& parameters, Matrix* by_inputs, Vector& gradient) {
    Index own = parameter_count_;
    for (std::size_t layer = layers_.size(); layer-- > 0;) {
      own -= layers_[layer]->parameterCount();
      layers_[layer]->backward(parameters.data() + own, layout_, inputsOf(layer), output_gradient_,
                               gradient.data() + own, layer > 0 ? &input_gradient_ : by_inputs);
      output_gradient_.swap(input_gradient_);
    }
  }

  Loss loss_;
  std::vector<std::unique_ptr<LayerGradient<Scalar>>> layers_;
  Index parameter_count_ = 0;
  StepLayout layout_;
  Matrix inputs_;
  Eigen::VectorXi labels_;
  Eigen::VectorXf weights_;
  Vector largest_;  ///< preference of a column
  Matrix output_gradient_;
  Matrix input_gradient_;
};

namespace {

void checkParameterCount(Index given, Index expected) {
  if (given == expected) return;
  throw std::invalid_argument("parameter vector has " + std::to_string(given) + " values, the layers expect " +
                              std::to_string(expected));
}

}  // namespace

template <typename Scalar>
SequenceGradient<Scalar>::SequenceGradient(const LayerStack& layers, Loss loss)
    : implementation_(std::make_unique<Implementation>(layers, loss)) {}
template <typename Scalar>
SequenceGradient<Scalar>::SequenceGradient(SequenceGradient&&) noexcept = default;
template <typename Scalar>
SequenceGradient<Scalar>& SequenceGradient<Scalar>::operator=(SequenceGradient&&) noexcept = default;
template <typename Scalar>
SequenceGradient<Scalar>::~SequenceGradient() = default;

template <typename Scalar>
Index SequenceGradient<Scalar>::parameterCount() const {
  return implementation_->parameterCount();
}

template <typename Scalar>
LossSum SequenceGradient<Scalar>::loss(const Vector& parameters, const std::vector<const Sequence*>& batch) {
  checkParameterCount(parameters.size(), parameterCount());
  return implementation_->evaluate(parameters, batch, nullptr);
}

template <typename Scalar>
LossSum SequenceGradient<Scalar>::lossAndGradient(const Vector& parameters, const std::vector<const Sequence*>& batch,
                                                  Vector& gradient) {
  checkParameterCount(parameters.size(), parameterCount());
  return implementation_->evaluate(parameters, batch, &gradient);
}

template <typename Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> SequenceGradient<Scalar>::preferences(const Vector& parameters,
                                                                                            const Sequence& sequence) {
  loss(parameters, {&sequence});
  return implementation_->preferences().leftCols(sequence.steps());
}

template <typename Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> SequenceGradient<Scalar>::inputGradient(
    const Vector& parameters, const Sequence& sequence,
    const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& factors) {
  checkParameterCount(parameters.size(), parameterCount());
  return implementation_->inputGradient(parameters, sequence, factors);
}

template class SequenceGradient<float>;
template class SequenceGradient<double>;

}  // namespace lstm_planner
