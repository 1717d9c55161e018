#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "lstm_planner/common/words.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/recipe.hpp"

namespace lstm_planner {

namespace {

/// Which training is meant. The other options depend on it and are parsed there.
struct Choice {
  std::string task;
  std::string method;
  bool search = false;
};

bool namesDataset(const std::vector<std::string>& arguments) {
  return std::any_of(arguments.begin(), arguments.end(), [](const std::string& argument) {
    return argument == "--dataset" || argument.rfind("--dataset=", 0) == 0;
  });
}

Choice readChoice(const std::vector<std::string>& arguments) {
  Choice choice{CommandLine::peek("task", arguments), CommandLine::peek("method", arguments),
                contains(arguments, "--search")};
  if (choice.task.empty()) choice.task = choice.search ? "grid" : "robot";
  if (namesDataset(arguments)) choice.method = "dataset";
  if (choice.method.empty()) choice.method = "dagger";
  return choice;
}

const char* const kHelp =
    R"(usage: lstm_planner train [RECIPE] [KEY=VALUE]... [OPTION]...

trains a network for the robot or for the grid world

RECIPE is a yaml file, or the name of one in models/recipes, by which the shipped networks were trained:
  create2_lstm_first and then create2_lstm, grid_lstm_2x8, grid_rnn_2x16, grid_mlp_4x64, grid_qlearning
KEY=VALUE replaces a value of the recipe, or adds one: seed=2, cells=[8,8]; false or [] takes a key away. Each key is
an option, too: --seed 2, --cells 8 8.

There are these trainings. Each has its own keys, which it prints with --help:
  method=dagger                   the robot learns from the shortest paths of generated worlds (the default)
  method=actor-critic             the robot learns by reinforcement, from random weights or on (init=MODEL)
  dataset=FILE                    the robot learns from recorded drives
  task=grid method=imitation      an agent of the grid world learns from A*, on paths that A* took
  task=grid method=dagger         likewise, on paths that the agent took
  task=grid method=q-learning     an agent of the grid world learns by Q-learning
  --search                        many small networks of the grid world learn, and are compared (thesis, tables 3.3-3.5)

examples:
  lstm_planner train create2_lstm_first seed=2 output=first.onnx
  lstm_planner train create2_lstm init=first.onnx seed=2 output=own.onnx
  lstm_planner train rounds=3 worlds=60 output=first.onnx
  lstm_planner train task=grid method=dagger --help
)";

bool asksForHelpAlone(const std::vector<std::string>& arguments) {
  return arguments.size() == 1 && (arguments[0] == "--help" || arguments[0] == "-h");
}

}  // namespace

std::string trainCommandLine(const std::vector<std::string>& arguments) {
  std::string line = "lstm_planner train";
  for (const std::string& argument : arguments) line += " " + argument;
  return line;
}

namespace {

int run(const Choice& choice, const std::vector<std::string>& arguments) {
  if (choice.method == "dataset") return trainRobotByDataset(arguments);
  if (choice.task == "robot") {
    if (choice.method == "dagger") return trainRobotByDagger(arguments);
    if (choice.method == "actor-critic") return trainRobotByActorCritic(arguments);
    throw std::invalid_argument("--method is '" + choice.method + "', expected dagger, actor-critic or dataset");
  }
  if (choice.task != "grid") {
    throw std::invalid_argument("--task is '" + choice.task + "', expected robot or grid");
  }
  if (choice.search) return searchGridStructures(arguments);
  if (choice.method == "imitation") return trainGridByImitation(arguments);
  if (choice.method == "dagger") return trainGridByDagger(arguments);
  if (choice.method == "q-learning") return trainGridByQLearning(arguments);
  throw std::invalid_argument("--method is '" + choice.method + "', expected imitation, dagger or q-learning");
}

}  // namespace

int runTrain(const std::vector<std::string>& given) {
  if (asksForHelpAlone(given)) {
    std::cout << kHelp;
    return 0;
  }
  const std::vector<std::string> arguments = expandRecipe(given);
  const Choice choice = readChoice(arguments);
  try {
    return run(choice, arguments);
  } catch (const UnknownOption& error) {
    // Misspelt may also be what chooses the training; or it is right, and of another training.
    std::vector<std::string> names = error.names();
    for (const char* name : {"--dataset", "--task", "--method", "--search"}) {
      if (error.name() != name) names.emplace_back(name);
    }
    throw UnknownOption(error.name(), names, " in this training; lstm_planner train --help names the others");
  }
}

}  // namespace lstm_planner
