#pragma once

#include <Eigen/Core>
#include <string>

#include "lstm_planner/agent/action_set.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "lstm_planner/network/network.hpp"
#include "lstm_planner/perception/encoder.hpp"

namespace lstm_planner {

/// What a model was made for; it travels in the model file's metadata.
struct PolicyDescription {
  EncoderParameters encoder;
  ActionSet actions;
  double step_length = 0.4;           ///< m
  double footprint_radius = 0.17425;  ///< m
};

/// To and from the metadata of a model file (keys of the encoder, and: action_angles, step_length, robot_radius).
/// Reading throws std::invalid_argument for a missing or malformed key.
void writeMetadata(const PolicyDescription& description, std::map<std::string, std::string>* metadata);
PolicyDescription readPolicyDescription(const std::map<std::string, std::string>& metadata);

/// Observation in, preferences over the steering angles out, with a memory in between: encoder and network together.
class DrivePolicy {
 public:
  /// Throws std::invalid_argument when network, encoder and action set do not fit together.
  DrivePolicy(PolicyDescription description, const LayerStack& layers);

  /// Throws ModelFileError, with the path and what is wrong or does not fit.
  static DrivePolicy fromFile(const std::string& path);

  /// Advances the hidden state by one step and returns one preference an action; valid until the next call.
  const Eigen::VectorXf& advance(const Observation& observation);

  void reset() { network_.reset(); }
  const PolicyDescription& description() const { return description_; }
  const Network& network() const { return network_; }

 private:
  PolicyDescription description_;
  Encoder encoder_;
  Network network_;
  Eigen::VectorXf input_;
};

/// For an agent that no network leads: the thesis's inputs and steering angles, all weights zero.
DrivePolicy noPolicy();

/// Throws std::invalid_argument with one sentence that says what differs when a model made for another step length or a
/// smaller robot would drive with these parameters. `range_max` is the scanner's (m, 0 = not known yet): it must reach
/// as far as half the model's range cap.
void checkFits(const PolicyDescription& description, double step_length, double footprint_radius,
               double range_max = 0.0);

}  // namespace lstm_planner
