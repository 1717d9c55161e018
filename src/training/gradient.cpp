#include "lstm_planner/training/gradient.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lstm_planner/training/confusion.hpp"
#include "training/lane_kernels.hpp"

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

bool isRecurrent(const Layer& layer) {
  return std::holds_alternative<LstmLayer>(layer) || std::holds_alternative<RecurrentLayer>(layer);
}

/// The answer of a step whose weight is not 0.
template <typename Column>
void note(const Column& preferences, Index label, float weight, LossSum* sum) {
  Index answer = 0;
  preferences.maxCoeff(&answer);
  ++sum->confusion(label, answer);
  sum->weight += static_cast<double>(weight);
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

double LossSum::accuracy() const { return accuracyOf(confusion); }

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

LossSum SequenceGradient::loss(const Eigen::VectorXf& parameters, const Batch& batch, Eigen::VectorXf* gradient) {
  if (gradient != nullptr) gradient->setZero(parameter_count_);
  LossSum sum;
  if (!batch.empty()) sum.confusion.setZero(network_.outputSize(), network_.outputSize());
  for (const Batch& group : groupsOf(batch)) {
    start(parameters, lanesOf(group));
    const Index steps = lanes_.front().steps;
    for (Index step = 0; step < steps; ++step) addLoss(forward(parameters, step), step, &sum);
    if (gradient != nullptr) network_.backward(parameters, static_cast<int>(steps), *gradient);
  }
  return sum;
}

std::vector<SequenceGradient::Piece> SequenceGradient::lanesOf(const Batch& group) const {
  const bool remembers = std::any_of(layers_.begin(), layers_.end(), isRecurrent);
  const Index pieces = remembers ? 1 : kLanes / static_cast<Index>(group.size());
  std::vector<Piece> lanes;
  for (const Sequence* sequence : group) {
    const Index length = (sequence->steps() + pieces - 1) / pieces;
    for (Index first = 0; first < sequence->steps(); first += length) {
      lanes.push_back({sequence, first, std::min(length, sequence->steps() - first)});
    }
  }
  return lanes;
}

void SequenceGradient::start(const Eigen::VectorXf& parameters, const std::vector<Piece>& lanes) {
  if (parameters.size() != parameter_count_) {
    throw std::invalid_argument("parameter vector has " + std::to_string(parameters.size()) +
                                " values, the layers expect " + std::to_string(parameter_count_));
  }
  lanes_ = lanes;
  if (lanes_.front().steps > longest_) {
    longest_ = lanes_.front().steps;
    network_ = LaneNetwork(layers_, kLanes, static_cast<int>(longest_));
  }
  network_.reset();
}

Eigen::Map<const SequenceGradient::Rows> SequenceGradient::forward(const Eigen::VectorXf& parameters, Index step) {
  Eigen::Map<Rows> inputs(network_.inputs(static_cast<int>(step)), network_.inputSize(), kLanes);
  inputs.setZero();
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    const Piece& piece = lanes_[lane];
    if (step >= piece.steps) continue;
    inputs.col(static_cast<Index>(lane)) = piece.sequence->inputs.col(piece.first + step).array();
  }
  const float* outputs = network_.forward(parameters, static_cast<int>(step));
  return {outputs, network_.outputSize(), kLanes};
}

/// The weight of a lane's step; 0 where the lane has ended, or has nothing to compute.
float SequenceGradient::weightOf(Index lane, Index step) const {
  if (lane >= static_cast<Index>(lanes_.size())) return 0.0f;
  const Piece& piece = lanes_[static_cast<std::size_t>(lane)];
  return step < piece.steps ? piece.sequence->weights[piece.first + step] : 0.0f;
}

Index SequenceGradient::labelOf(Index lane, Index step) const {
  const Piece& piece = lanes_[static_cast<std::size_t>(lane)];
  return piece.sequence->labels[piece.first + step];
}

/// Leaves the derivative by the preferences to the network. That of the cross-entropy goes through the softmax.
void SequenceGradient::addLoss(const Eigen::Map<const Rows>& preferences, Index step, LossSum* sum) {
  const bool is_euclidean = loss_ == Loss::kEuclidean;
  Eigen::Map<Rows> gradient(network_.outputGradient(static_cast<int>(step)), preferences.rows(), kLanes);
  if (is_euclidean) {
    gradient = preferences;
  } else {
    largest_ = preferences.colwise().maxCoeff();
    gradient = (preferences.rowwise() - largest_).exp();
    total_ = gradient.colwise().sum();
  }
  for (Index lane = 0; lane < kLanes; ++lane) {
    const float weight = weightOf(lane, step);
    if (!(weight > 0.0f)) {
      gradient.col(lane).setZero();
      continue;
    }
    const Index label = labelOf(lane, step);
    double error = 0.0;
    if (is_euclidean) {
      gradient(label, lane) -= 1.0f;
      error = 0.5 * static_cast<double>(gradient.col(lane).matrix().squaredNorm());
      gradient.col(lane) *= weight;
    } else {
      error =
          std::log(static_cast<double>(total_[lane])) - static_cast<double>(preferences(label, lane) - largest_[lane]);
      gradient.col(lane) *= weight / total_[lane];
      gradient(label, lane) -= weight;
    }
    sum->loss += static_cast<double>(weight) * error;
    note(preferences.col(lane), label, weight, sum);
  }
}

}  // namespace lstm_planner
