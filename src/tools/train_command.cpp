#include <algorithm>
#include <stdexcept>

#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/train_commands.hpp"

namespace lstm_planner {

namespace {

/// Which training is meant. The other options depend on it and are parsed there.
struct Choice {
  std::string task;
  std::string method;
  bool search = false;
};

constexpr const char* kRobotMethod = "dagger";
constexpr const char* kGridMethod = "actor-critic";

bool namesDataset(const std::vector<std::string>& arguments) {
  return std::any_of(arguments.begin(), arguments.end(), [](const std::string& argument) {
    return argument == "--dataset" || argument.rfind("--dataset=", 0) == 0;
  });
}

Choice readChoice(const std::vector<std::string>& arguments) {
  Choice choice{CommandLine::peek("task", arguments), CommandLine::peek("method", arguments),
                std::find(arguments.begin(), arguments.end(), "--search") != arguments.end()};
  if (choice.task.empty()) choice.task = choice.search ? "grid" : "robot";
  if (namesDataset(arguments)) choice.method = "dataset";
  if (choice.method.empty()) choice.method = choice.task == "robot" ? kRobotMethod : kGridMethod;
  return choice;
}

}  // namespace

std::string trainCommandLine(const std::vector<std::string>& arguments) {
  std::string line = "lstm_planner train";
  for (const std::string& argument : arguments) line += " " + argument;
  return line;
}

int runTrain(const std::vector<std::string>& arguments) {
  const Choice choice = readChoice(arguments);
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
  if (choice.method == "actor-critic") return trainGridByActorCritic(arguments);
  if (choice.method == "q-learning") return trainGridByQLearning(arguments);
  throw std::invalid_argument("--method is '" + choice.method +
                              "', expected imitation, dagger, actor-critic or q-learning");
}

}  // namespace lstm_planner
