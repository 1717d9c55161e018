#include "lstm_planner/agent/drive_policy.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace lstm_planner {

namespace {

double readNumber(const std::map<std::string, std::string>& metadata, const std::string& key) {
  const auto entry = metadata.find(key);
  if (entry == metadata.end()) {
    throw std::invalid_argument("the metadata has no key " + key);
  }
  std::istringstream text(entry->second);
  text.imbue(std::locale::classic());
  double number = 0.0;
  if (!(text >> number) || !(text >> std::ws).eof() || !(number > 0.0) || !std::isfinite(number)) {
    throw std::invalid_argument("the metadata key " + key + " is '" + entry->second + "', expected a positive number");
  }
  return number;
}

std::string writeNumber(double number) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << number;
  return text.str();
}

ActionSet readActions(const std::map<std::string, std::string>& metadata) {
  const auto entry = metadata.find("action_angles");
  if (entry == metadata.end()) {
    throw std::invalid_argument("the metadata has no key action_angles");
  }
  std::istringstream text(entry->second);
  text.imbue(std::locale::classic());
  std::vector<double> angles;
  double angle = 0.0;
  while (text >> angle) {
    angles.push_back(angle);
    if (text >> std::ws; text.peek() == ',') {
      text.ignore();
    }
  }
  if (!text.eof()) {
    throw std::invalid_argument("the metadata key action_angles is '" + entry->second +
                                "', expected numbers separated by commas");
  }
  return ActionSet(std::move(angles));
}

}  // namespace

void writeMetadata(const PolicyDescription& description, std::map<std::string, std::string>* metadata) {
  writeMetadata(description.encoder, metadata);
  std::string angles;
  for (const double angle : description.actions.angles()) {
    angles += (angles.empty() ? "" : ",") + writeNumber(angle);
  }
  (*metadata)["action_angles"] = angles;
  (*metadata)["step_length"] = writeNumber(description.step_length);
  (*metadata)["robot_radius"] = writeNumber(description.footprint_radius);
}

PolicyDescription readPolicyDescription(const std::map<std::string, std::string>& metadata) {
  PolicyDescription description;
  description.encoder = readEncoderParameters(metadata);
  description.actions = readActions(metadata);
  description.step_length = readNumber(metadata, "step_length");
  description.footprint_radius = readNumber(metadata, "robot_radius");
  return description;
}

DrivePolicy::DrivePolicy(PolicyDescription description, const LayerStack& layers)
    : description_(std::move(description)),
      encoder_(description_.encoder),
      network_(layers),
      input_(encoder_.size()) {
  if (network_.inputSize() != encoder_.size()) {
    throw std::invalid_argument("the network takes " + std::to_string(network_.inputSize()) +
                                " inputs, its input layout has " + std::to_string(encoder_.size()));
  }
  if (network_.outputSize() != description_.actions.size()) {
    throw std::invalid_argument("the network has " + std::to_string(network_.outputSize()) +
                                " outputs, its action set has " + std::to_string(description_.actions.size()));
  }
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
  encoder_.encode(observation, input_);
  return network_.forward(input_);
}

DrivePolicy noPolicy() {
  const PolicyDescription description;
  DenseLayer layer;
  layer.weights.setZero(description.actions.size(), Encoder(description.encoder).size());
  layer.bias.setZero(description.actions.size());
  return DrivePolicy(description, {layer});
}

void checkFits(const PolicyDescription& description, double step_length, double footprint_radius, double range_max) {
  if (std::abs(description.step_length - step_length) > 0.01) {
    throw std::invalid_argument("the model was trained for steps of " + std::to_string(description.step_length) +
                                " m, step/length is " + std::to_string(step_length) + " m");
  }
  if (footprint_radius > description.footprint_radius + 0.05) {
    throw std::invalid_argument("the model was trained for a robot of radius " +
                                std::to_string(description.footprint_radius) + " m, shield/footprint_radius is " +
                                std::to_string(footprint_radius) + " m, more than 0.05 m larger");
  }
  if (range_max > 0.0 && range_max < 0.5 * description.encoder.range_cap) {
    throw std::invalid_argument("the scanner reaches " + std::to_string(range_max) +
                                " m, the model was trained with a range cap of " +
                                std::to_string(description.encoder.range_cap) + " m and needs at least half of it");
  }
}

}  // namespace lstm_planner
