#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lstm_planner/practice/dataset_training.hpp"
#include "tools/train_robot_options.hpp"

namespace lstm_planner {

/// What `lstm_planner train --dataset` is asked to do.
struct DatasetTrainingOptions {
  std::string command;  ///< the whole command line
  std::string task = "robot";
  std::string method;
  std::vector<std::string> datasets;
  std::vector<std::string> validation_datasets;
  double validation_share = 0.25;  ///< of the steps, where there are no validation_datasets
  std::string preset = "stable";
  std::string init;  ///< model to start with; empty: a new network
  RobotNetworkOptions network;
  EncoderParameters encoder;  ///< of a new network; the range cap is the recordings'
  std::string output;
  std::string checkpoint;   ///< empty: none
  nlohmann::json settings;  ///< what the training depends on, for the checkpoint
  int snapshots = 0;        ///< epochs from one to the next; 0: none
  std::string curve;        ///< PNG files; empty: none
  std::string confusion;
  std::string stability;
  std::uint64_t seed = 1;
  DatasetTrainingParameters training;  ///< `sequences.policy` is not known yet

  bool fromModel() const { return !init.empty(); }
};

/// Returns false when only the help was asked for. Throws with a sentence for options that make no sense.
bool readDatasetTrainingOptions(const std::vector<std::string>& arguments, DatasetTrainingOptions* options);

}  // namespace lstm_planner
