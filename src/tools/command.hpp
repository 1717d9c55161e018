#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace lstm_planner {

/// A command of the tool: takes the arguments behind its name, returns the exit status. Bad arguments are thrown as
/// exceptions whose what() is the sentence for the user.
struct Command {
  const char* name;
  const char* summary;
  int (*run)(const std::vector<std::string>& arguments);
  bool shared = false;  ///< the processes that mpirun starts share the work; else there must be one only
};

/// "usage: PROGRAM KIND [OPTION]..." and the commands with what they do; `kind` is COMMAND or ACTION.
void printUsage(const std::string& program, const std::string& kind, const std::vector<Command>& commands,
                std::ostream& out);

/// Throws std::invalid_argument with the nearest name where there is no such command; `kind` as above, in small
/// letters.
Command commandNamed(const std::string& name, const std::string& kind, const std::vector<Command>& commands);

/// Runs the action that the first argument names, of a command that has several; prints them for --help.
int runAction(const std::string& command, const std::vector<Command>& actions,
              const std::vector<std::string>& arguments);

int runDrive(const std::vector<std::string>& arguments);
int runJudge(const std::vector<std::string>& arguments);
int runTrain(const std::vector<std::string>& arguments);
int runEvaluate(const std::vector<std::string>& arguments);
int runReport(const std::vector<std::string>& arguments);
int runMaps(const std::vector<std::string>& arguments);
int runModel(const std::vector<std::string>& arguments);
int runDataset(const std::vector<std::string>& arguments);
int runParameters(const std::vector<std::string>& arguments);

}  // namespace lstm_planner
