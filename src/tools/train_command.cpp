#include <algorithm>
#include <boost/program_options.hpp>
#include <stdexcept>

#include "tools/command.hpp"
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
  namespace po = boost::program_options;
  Choice choice;
  po::options_description description;
  // clang-format off
  description.add_options()
      ("task", po::value(&choice.task)->default_value("robot"))
      ("method", po::value(&choice.method))
      ("search", po::bool_switch(&choice.search));
  // clang-format on
  // Without guessing: --m of another training is not to be taken for --method.
  const auto style = po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
  po::variables_map values;
  po::store(po::command_line_parser(arguments).options(description).style(style).allow_unregistered().run(), values);
  po::notify(values);
  if (values["task"].defaulted() && choice.search) choice.task = "grid";
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
    if (choice.method == "q-learning") return trainRobotByQLearning(arguments);
    throw std::invalid_argument("--method is '" + choice.method +
                                "', expected dagger, actor-critic, q-learning or dataset");
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
