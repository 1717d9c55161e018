#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

// What `lstm_planner train` can do. Each takes the arguments behind the command's name and returns the exit status.

/// The robot in generated worlds: --task robot, by --method.
int trainRobotByDagger(const std::vector<std::string>& arguments);
int trainRobotByActorCritic(const std::vector<std::string>& arguments);

/// The robot from recorded drives: --dataset.
int trainRobotByDataset(const std::vector<std::string>& arguments);

/// Agents of the grid world: --task grid, by --method.
int trainGridByImitation(const std::vector<std::string>& arguments);
int trainGridByDagger(const std::vector<std::string>& arguments);
int trainGridByQLearning(const std::vector<std::string>& arguments);

/// Tables 3.3-3.5 of the thesis: --search.
int searchGridStructures(const std::vector<std::string>& arguments);

/// "lstm_planner train" and the arguments, for the model's metadata.
std::string trainCommandLine(const std::vector<std::string>& arguments);

}  // namespace lstm_planner
