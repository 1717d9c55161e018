#include "lstm_planner/training/gradient.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/training/lane_kernels.hpp"

namespace lstm_planner {
namespace {

using Eigen::Index;

constexpr int kLanes = SequenceGradient::kTogether;
static_assert(kLanes % kLaneGroup == 0);

/// Throws std::invalid_argument where a softmax is not the one of the loss.
LayerStack withoutSoftmax(LayerStack layers, Loss loss) {
  validateLayers(layers);
  if (layers.size() < 2 || !std::holds_alternative<SoftmaxLayer>(layers.back())) return layers;
  if (loss == Loss::kEuclidean) {
    throw std::invalid_argument("the last layer is a softmax, which cannot be trained with the Euclidean loss");
  }
  layers.pop_back();
  return layers;
}

/// The weight of a lane's step; 0 where the lane has ended, or never had a sequence.
float weightOf(const SequenceGradient::Batch& group, Index lane, Index step) {
  if (lane >= static_cast<Index>(group.size())) return 0.0f;
  const Sequence& sequence = *group[static_cast<std::size_t>(lane)];
  return step < sequence.steps() ? sequence.weights[step] : 0.0f;
}

/// The answer of a step whose weight is not 0.
template <typename Column>
void note(const Column& preferences, Index label, float weight, LossSum* sum) {
  Index answer = 0;
  preferences.maxCoeff(&answer);
  ++sum->confusion(label, answer);
  sum->weight += static_cast<double>(weight);
}

Index labelOf(const SequenceGradient::Batch& group, Index lane, Index step) {
  return group[static_cast<std::size_t>(lane)]->labels[step];
}

}  // namespace

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

SequenceGradient::SequenceGradient(const LayerStack& layers, Loss loss)
    : layers_(withoutSoftmax(layers, loss)),
      loss_(loss),
      parameter_count_(static_cast<Index>(countWeights(layers_))),
      longest_(1),
      network_(layers_, kLanes, 1) {}

std::vector<SequenceGradient::Batch> SequenceGradient::groupsOf(Batch batch) {
  // Equally long ones keep their order, so that nothing depends on the sorting algorithm.
  std::stable_sort(batch.begin(), batch.end(),
                   [](const Sequence* a, const Sequence* b) { return a->steps() > b->steps(); });
  std::vector<Batch> groups;
  for (std::size_t index = 0; index < batch.size(); ++index) {
    if (index % kTogether == 0) groups.emplace_back();
    groups.back().push_back(batch[index]);
  }
  return groups;
}

LossSum SequenceGradient::evaluate(const Eigen::VectorXf& parameters, const Batch& batch, Eigen::VectorXf* gradient) {
  if (gradient != nullptr) gradient->setZero(parameter_count_);
  LossSum sum;
  if (!batch.empty()) sum.confusion.setZero(network_.outputSize(), network_.outputSize());
  for (const Batch& group : groupsOf(batch)) {
    const Index steps = group.front()->steps();
    start(parameters, steps);
    for (Index step = 0; step < steps; ++step) {
      const Eigen::Map<const Rows> preferences = forward(parameters, group, step);
      loss_ == Loss::kEuclidean ? addEuclidean(preferences, group, step, &sum)
                                : addCrossEntropy(preferences, group, step, &sum);
    }
    if (gradient != nullptr) network_.backward(parameters, static_cast<int>(steps), *gradient);
  }
  return sum;
}

Eigen::MatrixXf SequenceGradient::preferences(const Eigen::VectorXf& parameters, const Sequence& sequence) {
  start(parameters, sequence.steps());
  Eigen::MatrixXf preferences(network_.outputSize(), sequence.steps());
  for (Index step = 0; step < sequence.steps(); ++step) {
    preferences.col(step) = forward(parameters, {&sequence}, step).col(0);
  }
  return preferences;
}

void SequenceGradient::start(const Eigen::VectorXf& parameters, Index steps) {
  if (parameters.size() != parameter_count_) {
    throw std::invalid_argument("parameter vector has " + std::to_string(parameters.size()) +
                                " values, the layers expect " + std::to_string(parameter_count_));
  }
  if (steps > longest_) {
    longest_ = steps;
    network_ = LaneNetwork(layers_, kLanes, static_cast<int>(steps));
  }
  network_.reset();
}

Eigen::Map<const SequenceGradient::Rows> SequenceGradient::forward(const Eigen::VectorXf& parameters,
                                                                   const Batch& group, Index step) {
  Eigen::Map<Rows> inputs(network_.inputs(static_cast<int>(step)), network_.inputSize(), kLanes);
  for (Index lane = 0; lane < kLanes; ++lane) {
    const bool runs = lane < static_cast<Index>(group.size()) && step < group[static_cast<std::size_t>(lane)]->steps();
    if (runs) {
      inputs.col(lane) = group[static_cast<std::size_t>(lane)]->inputs.col(step).array();
    } else {
      inputs.col(lane).setZero();
    }
  }
  const float* outputs = network_.forward(parameters, static_cast<int>(step));
  return {outputs, network_.outputSize(), kLanes};
}

/// With the softmax; leaves the derivative by the preferences to the network, as addEuclidean() does.
void SequenceGradient::addCrossEntropy(const Eigen::Map<const Rows>& preferences, const Batch& group, Index step,
                                       LossSum* sum) {
  Eigen::Map<Rows> gradient(network_.outputGradient(static_cast<int>(step)), preferences.rows(), kLanes);
  largest_ = preferences.colwise().maxCoeff();
  gradient = (preferences.rowwise() - largest_).exp();
  total_ = gradient.colwise().sum();
  for (Index lane = 0; lane < kLanes; ++lane) {
    const float weight = weightOf(group, lane, step);
    if (!(weight > 0.0f)) {
      gradient.col(lane).setZero();
      continue;
    }
    const Index label = labelOf(group, lane, step);
    sum->loss += static_cast<double>(weight) * (std::log(static_cast<double>(total_[lane])) -
                                                static_cast<double>(preferences(label, lane) - largest_[lane]));
    note(preferences.col(lane), label, weight, sum);
    gradient.col(lane) *= weight / total_[lane];
    gradient(label, lane) -= weight;
  }
}

void SequenceGradient::addEuclidean(const Eigen::Map<const Rows>& preferences, const Batch& group, Index step,
                                    LossSum* sum) {
  Eigen::Map<Rows> gradient(network_.outputGradient(static_cast<int>(step)), preferences.rows(), kLanes);
  gradient = preferences;
  for (Index lane = 0; lane < kLanes; ++lane) {
    const float weight = weightOf(group, lane, step);
    if (!(weight > 0.0f)) {
      gradient.col(lane).setZero();
      continue;
    }
    const Index label = labelOf(group, lane, step);
    gradient(label, lane) -= 1.0f;
    sum->loss += static_cast<double>(weight) * 0.5 * static_cast<double>(gradient.col(lane).matrix().squaredNorm());
    note(preferences.col(lane), label, weight, sum);
    gradient.col(lane) *= weight;
  }
}

}  // namespace lstm_planner
