#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lstm_planner/drive/decision/action_set.hpp"
#include "lstm_planner/drive/perception/encoder.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "lstm_planner/network/network.hpp"

namespace lstm_planner {

/// What a model was made for; it travels in the model file's metadata.
struct PolicyDescription {
  EncoderParameters encoder;
  ActionSet actions;
  double step_length = 0.4;           ///< m
  double footprint_radius = 0.17425;  ///< m, of the robot that it was trained with
  double smallest_radius = 0.0;       ///< m, of the robots that it was tried with; 0 = not known
  double largest_radius = 0.0;        ///< m, of the robots that it was tried with; 0 = not known
};

/// To and from the metadata of a model file (keys of the encoder, and: action_angles, step_length, robot_radius,
/// smallest_robot and largest_robot where they are known).
/// Reading throws std::invalid_argument, which names all missing and malformed keys.
void writeMetadata(const PolicyDescription& description, std::map<std::string, std::string>* metadata);
PolicyDescription readPolicyDescription(const std::map<std::string, std::string>& metadata);

/// Number of outputs of a network for it: one for each action; with eight views one, how good it is to go ahead.
int networkOutputs(const PolicyDescription& description);

/// The view that looks where each action steers, in eighths of a turn from the heading. Throws std::invalid_argument
/// unless all angles are multiples of 45 degrees.
std::vector<int> viewsOf(const ActionSet& actions);

/// Observation in, preferences over the steering angles out, with a memory in between: encoder and network together.
///
/// With eight views the same network is evaluated for each of eight directions, which are constant in the odometry
/// frame; one of them is the heading, rounded to 45 degrees. Each view is a sequence of the network, with its own
/// hidden state, and all advance at each step. The preference for an action is the output of the view into whose
/// direction it steers. When the robot turns, a hidden state stays with its direction. Copies share weights and
/// description.
class DrivePolicy {
 public:
  /// Throws std::invalid_argument when network, encoder and action set do not fit together.
  DrivePolicy(PolicyDescription description, const LayerStack& layers);

  /// Throws ModelFileError, with the path and what is wrong or does not fit.
  static DrivePolicy fromFile(const std::string& path);

  /// Advances the hidden state by one step and returns one preference an action; valid until the next call. Throws
  /// std::invalid_argument if the observation is not finite; then some of eight views may have advanced.
  const Eigen::VectorXf& advance(const Observation& observation);

  void reset();
  const PolicyDescription& description() const& { return *description_; }
  PolicyDescription description() && { return *description_; }  ///< outlives a policy that is temporary
  /// Of all recurrent cells; with eight views one view behind the other. Allocates.
  Eigen::VectorXf hiddenState() const;

 private:
  const Eigen::VectorXf& advanceViews(const Observation& observation);

  std::shared_ptr<const PolicyDescription> description_;
  Encoder encoder_;
  Network network_;  ///< a sequence a view, which is a direction of the odometry frame where there are eight
  Eigen::VectorXf input_;

  // With eight views only.
  std::vector<int> action_views_;
  Eigen::Matrix<float, Eigen::Dynamic, kDriveViews, Eigen::RowMajor> view_inputs_;  ///< a row an input
  Eigen::VectorXf preferences_;
};

/// For an agent that no network leads: the thesis's inputs and steering angles, all weights zero.
DrivePolicy noPolicy();

/// Throws std::invalid_argument with one sentence that says what differs when a model made for another step length
/// would lead.
void checkFits(const PolicyDescription& description, double step_length);

/// Whether a scanner that reaches so far (m) shows a network what it needs: half of what the model's ranges are capped
/// at.
bool reachesFarEnough(const PolicyDescription& description, double reach);

/// Why it does not, in one sentence.
std::string reachProblem(const PolicyDescription& description, double reach);

/// A warning, in one sentence, if it does not and another leader takes the network's place; empty otherwise.
std::string standInWarning(const PolicyDescription& description, double reach);

/// A warning, in one sentence, if a robot is smaller or larger than all that the model was tried with; empty otherwise.
/// The shield keeps such a robot safe. Without known limits, any radius up to 0.05 m more than the model's own is fine.
std::string sizeWarning(const PolicyDescription& description, double footprint_radius);

}  // namespace lstm_planner
