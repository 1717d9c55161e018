#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "lstm_planner/practice/drive_course.hpp"
#include "lstm_planner/practice/drive_judge.hpp"
#include "lstm_planner/training/gradient.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/training_loop.hpp"
#include "tools/command_line.hpp"

namespace lstm_planner {

/// Options that all ways of training the robot have in common.
struct RobotTrainingOptions {
  std::string command;  ///< the whole command line
  std::string task = "robot";
  std::string method;
  TrainingLoopOptions loop;
  DriveCourseParameters course;
  int validation = 60;  ///< worlds
  int max_steps = 300;  ///< of a drive
  std::uint64_t seed = 1;
  int threads = 2;
};

/// What a new network of the robot looks like.
struct RobotNetworkOptions {
  std::vector<std::string> inputs;  ///< groups beside the thesis's
  NetworkShape shape;
};

// `options` and the others hold the defaults and take the values; they must stay where they are until the line is
// parsed.

/// Of `train` and `judge`.
void addWorldKinds(std::vector<WorldKind>* worlds, CommandLine* line);

/// What a network of the robot takes. `groups`: beside the thesis's inputs.
void addInputOptions(std::vector<std::string>* groups, EncoderParameters* encoder, CommandLine* line);

/// Takes over the parsed groups. Throws std::invalid_argument for a name that is none.
void addInputs(const std::vector<std::string>& groups, EncoderParameters* encoder);

void addRobotNetworkOptions(RobotNetworkOptions* options, EncoderParameters* encoder, CommandLine* line);

/// Throws std::invalid_argument when one of them was given beside --init.
void checkModelDecides(const CommandLine& line);

/// Takes over what was parsed. Throws std::invalid_argument with a sentence for values that make no sense.
void finishRobotNetworkOptions(const RobotNetworkOptions& options, EncoderParameters* encoder);

void addRobotTrainingOptions(const std::vector<std::string>& arguments, RobotTrainingOptions* options,
                             CommandLine* line);

/// The network to start with: the one in the file `init`, whose description replaces `policy`; where that is empty, a
/// new one.
LayerStack firstLayers(const std::string& init, const NetworkShape& shape, std::uint64_t seed,
                       PolicyDescription* policy);

/// Writes the model with its description, the command and the score.
void writeRobotModel(const RobotTrainingOptions& options, const PolicyDescription& policy, const LayerStack& layers,
                     const DriveScore& score);

/// "arrival 0.950, efficiency 0.800"
std::string toText(const DriveScore& score);

/// Several files as one. Throws std::invalid_argument for a file that is given twice.
Dataset readDatasets(const std::vector<std::string>& paths, bool with_scans);

/// The same, with scans only where the policy needs them.
Dataset readDatasetsFor(const PolicyDescription& policy, const std::vector<std::string>& paths);

/// "accuracy 88.3 %, balanced 55.3 %", of a row a label.
std::string accuracyText(const ConfusionMatrix& confusion);

}  // namespace lstm_planner
