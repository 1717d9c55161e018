#include "lstm_planner/drive/decision/drive_policy.hpp"

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

namespace {

constexpr double kSameAngle = 1e-4;  ///< rad

const char* const kSmallest = "smallest_robot";
const char* const kLargest = "largest_robot";

constexpr double kShortest = 1e-3;   ///< m
constexpr double kLongest = 1000.0;  ///< m

ActionSet readActions(MetadataReader* metadata) {
  std::vector<double> angles = metadata->numbers("action_angles");
  if (angles.empty()) return {};
  try {
    return ActionSet(std::move(angles));
  } catch (const std::invalid_argument& error) {
    metadata->note(std::string("action_angles: ") + error.what());
    return {};
  }
}

}  // namespace

void writeMetadata(const PolicyDescription& description, std::map<std::string, std::string>* metadata) {
  writeMetadata(description.encoder, metadata);
  std::string angles;
  for (const double angle : description.actions.angles()) {
    angles += (angles.empty() ? "" : ",") + metadataText(angle);
  }
  (*metadata)["action_angles"] = angles;
  (*metadata)["step_length"] = metadataText(description.step_length);
  (*metadata)["robot_radius"] = metadataText(description.footprint_radius);
  for (const char* only_sometimes : {kSmallest, kLargest}) metadata->erase(only_sometimes);
  if (description.smallest_radius > 0.0) (*metadata)[kSmallest] = metadataText(description.smallest_radius);
  if (description.largest_radius > 0.0) (*metadata)[kLargest] = metadataText(description.largest_radius);
}

PolicyDescription readPolicyDescription(const std::map<std::string, std::string>& metadata) {
  MetadataReader reader(metadata);
  PolicyDescription description;
  description.encoder = readEncoderParameters(&reader);
  description.actions = readActions(&reader);
  description.step_length = reader.number("step_length", kShortest, kLongest);
  description.footprint_radius = reader.number("robot_radius", kShortest, kLongest);
  if (reader.has(kSmallest)) description.smallest_radius = reader.number(kSmallest, kShortest, kLongest);
  if (reader.has(kLargest)) description.largest_radius = reader.number(kLargest, kShortest, kLongest);
  reader.finish();
  return description;
}

int networkOutputs(const PolicyDescription& description) {
  return description.encoder.views == 1 ? description.actions.size() : 1;
}

std::vector<int> viewsOf(const ActionSet& actions) {
  std::vector<int> views;
  for (const double angle : actions.angles()) {
    views.push_back(viewNearest(angle));
    if (std::abs(normalizeAngle(angle - views.back() * kViewAngle)) < kSameAngle) continue;
    throw std::invalid_argument("eight views need steering angles that are multiples of 45 degrees, one is " +
                                metadataText(angle) + " rad");
  }
  return views;
}

DrivePolicy::DrivePolicy(PolicyDescription description, const LayerStack& layers)
    : description_(std::make_shared<const PolicyDescription>(std::move(description))),
      encoder_(std::shared_ptr<const EncoderParameters>(description_, &description_->encoder)),
      network_(layers, fastestInstructionSet(), description_->encoder.views),
      input_(encoder_.size()) {
  if (network_.inputSize() != encoder_.size()) {
    throw std::invalid_argument("the network takes " + std::to_string(network_.inputSize()) +
                                " inputs, its input layout has " + std::to_string(encoder_.size()));
  }
  const bool has_views = description_->encoder.views != 1;
  if (network_.outputSize() != networkOutputs(*description_)) {
    throw std::invalid_argument(
        "the network has " + std::to_string(network_.outputSize()) + " outputs, " +
        (has_views ? "eight views have 1" : "its action set has " + std::to_string(description_->actions.size())));
  }
  if (!has_views) return;
  action_views_ = viewsOf(description_->actions);
  view_inputs_.resize(encoder_.size(), kDriveViews);
  preferences_.resize(description_->actions.size());
}

DrivePolicy DrivePolicy::fromFile(const std::string& path) {
  Model model = readModelFile(path);
  try {
    return DrivePolicy(readPolicyDescription(model.metadata), model.layers);
  } catch (const std::invalid_argument& error) {
    throw ModelFileError(path + ": " + error.what());
  }
}

const Eigen::VectorXf& DrivePolicy::advance(const Observation& observation) {
  if (description_->encoder.views != 1) return advanceViews(observation);
  encoder_.encode(observation, input_);
  return network_.forward(input_);
}

const Eigen::VectorXf& DrivePolicy::advanceViews(const Observation& observation) {
  const ViewBearings bearings = bearingsOf(observation);
  encoder_.encode(observation, input_);
  encoder_.turn(input_.data(), bearings, view_inputs_.data(), kDriveViews);
  std::array<float, kDriveViews> outputs;
  for (int view = 0; view < kDriveViews; ++view) {
    input_ = view_inputs_.col(view);
    outputs[static_cast<std::size_t>(view)] = network_.forward(input_, view)[0];
  }
  for (std::size_t action = 0; action < action_views_.size(); ++action) {
    const int direction = (bearings.ahead + action_views_[action]) % kDriveViews;
    preferences_[static_cast<Eigen::Index>(action)] = outputs[static_cast<std::size_t>(direction)];
  }
  return preferences_;
}

void DrivePolicy::reset() { network_.reset(); }

Eigen::VectorXf DrivePolicy::hiddenState() const {
  const Eigen::Index size = network_.hiddenState().size();
  Eigen::VectorXf all(network_.sequences() * size);
  for (int view = 0; view < network_.sequences(); ++view) all.segment(view * size, size) = network_.hiddenState(view);
  return all;
}

DrivePolicy noPolicy() {
  const PolicyDescription description;
  DenseLayer layer;
  layer.weights.setZero(description.actions.size(), Encoder(description.encoder).size());
  layer.bias.setZero(description.actions.size());
  return DrivePolicy(description, {layer});
}

void checkFits(const PolicyDescription& description, double step_length) {
  if (std::abs(description.step_length - step_length) > 0.01) {
    throw std::invalid_argument("the model was trained for steps of " + numberText(description.step_length) +
                                " m, step/length is " + numberText(step_length) + " m");
  }
}

bool reachesFarEnough(const PolicyDescription& description, double reach) {
  return isAtMost(0.5 * description.encoder.range_cap, reach);
}

std::string reachProblem(const PolicyDescription& description, double reach) {
  return "the scanner reaches " + numberText(reach) + " m, the model was trained with a range cap of " +
         numberText(description.encoder.range_cap) + " m and needs at least half of it";
}

std::string standInWarning(const PolicyDescription& description, double reach) {
  if (reachesFarEnough(description, reach)) return "";
  return reachProblem(description, reach) + ": the path through the remembered obstacles leads in its place";
}

std::string sizeWarning(const PolicyDescription& description, double footprint_radius) {
  const bool is_known = description.largest_radius > 0.0;
  const double largest = is_known ? description.largest_radius : description.footprint_radius + 0.05;
  if (footprint_radius >= description.smallest_radius && footprint_radius <= largest) return "";
  const bool has_smallest = description.smallest_radius > 0.0;
  return "the network was tried with robots of radius " +
         (has_smallest ? numberText(description.smallest_radius) + " to " : "up to ") + numberText(largest) +
         " m, this robot's is " + numberText(footprint_radius) +
         " m (half of the width that it passes): it may lead worse, and the path through the remembered obstacles "
         "leads more often; leader: route is made "
         "for any size";
}

}  // namespace lstm_planner
