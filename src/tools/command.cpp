#include "tools/command.hpp"

#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "lstm_planner/base/common/nearest_name.hpp"

namespace lstm_planner {

void printUsage(const std::string& program, const std::string& kind, const std::vector<Command>& commands,
                std::ostream& out) {
  out << "usage: " << program << " " << kind << " [OPTION]...\n\n";
  for (const Command& command : commands) out << "  " << command.name << "\t" << command.summary << "\n";
  out << "\n" << program << " " << kind << " --help explains it.\n";
}

const Command& commandNamed(const std::string& name, const std::string& kind, const std::vector<Command>& commands) {
  const auto found =
      std::find_if(commands.begin(), commands.end(), [&](const Command& command) { return command.name == name; });
  if (found != commands.end()) return *found;
  std::vector<std::string> names;
  for (const Command& command : commands) names.emplace_back(command.name);
  std::string hint = hintAt(name, names);
  if (hint.empty()) {
    for (const std::string& known : names) hint += (hint.empty() ? ", expected one of " : ", ") + known;
  }
  throw std::invalid_argument("there is no " + kind + " '" + name + "'" + hint);
}

}  // namespace lstm_planner
