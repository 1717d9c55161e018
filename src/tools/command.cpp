#include "tools/command.hpp"

#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "lstm_planner/common/nearest_name.hpp"
#include "lstm_planner/common/words.hpp"

namespace lstm_planner {

void printUsage(const std::string& program, const std::string& kind, const std::vector<Command>& commands,
                std::ostream& out) {
  out << "usage: " << program << " " << kind << " [OPTION]...\n\n";
  for (const Command& command : commands) out << "  " << command.name << "\t" << command.summary << "\n";
  out << "\n" << program << " " << kind << " --help explains it.\n";
}

namespace {

std::vector<std::string> namesOf(const std::vector<Command>& commands) {
  std::vector<std::string> names;
  for (const Command& command : commands) names.emplace_back(command.name);
  return names;
}

}  // namespace

Command commandNamed(const std::string& name, const std::string& kind, const std::vector<Command>& commands) {
  const auto found =
      std::find_if(commands.begin(), commands.end(), [&](const Command& command) { return command.name == name; });
  if (found != commands.end()) return *found;
  std::string hint = hintAt(name, namesOf(commands));
  if (hint.empty()) hint = ", expected one of " + joined(namesOf(commands));
  throw std::invalid_argument("there is no " + kind + " '" + name + "'" + hint);
}

int runAction(const std::string& command, const std::vector<Command>& actions,
              const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    throw std::invalid_argument("an action is missing, expected one of " + joined(namesOf(actions)));
  }
  if (arguments[0] == "--help" || arguments[0] == "-h") {
    printUsage("lstm_planner " + command, "ACTION", actions, std::cout);
    return 0;
  }
  return commandNamed(arguments[0], "action", actions).run({arguments.begin() + 1, arguments.end()});
}

}  // namespace lstm_planner
