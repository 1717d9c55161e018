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

// The actions of `dataset`.
int datasetInfo(const std::vector<std::string>& arguments);
int datasetCheck(const std::vector<std::string>& arguments);
int datasetMerge(const std::vector<std::string>& arguments);
int datasetSplit(const std::vector<std::string>& arguments);
int datasetExport(const std::vector<std::string>& arguments);
int datasetFromBag(const std::vector<std::string>& arguments);
int datasetFromLog(const std::vector<std::string>& arguments);
int datasetSimulate(const std::vector<std::string>& arguments);

// What `report` does when it is told which report.
int runMemoryReport(const std::vector<std::string>& arguments);  ///< --memory-task: how long networks remember
int runQTableReport(const std::vector<std::string>& arguments);  ///< --q-table: on small maps, beside networks
int runThesisReport(const std::vector<std::string>& arguments);  ///< --thesis: its networks, by its rules

// What `train` can do: --task robot and grid by --method, or --dataset, or --search.
int trainRobotByDagger(const std::vector<std::string>& arguments);
int trainRobotByActorCritic(const std::vector<std::string>& arguments);
int trainRobotByDataset(const std::vector<std::string>& arguments);
int trainGridByImitation(const std::vector<std::string>& arguments);
int trainGridByDagger(const std::vector<std::string>& arguments);
int trainGridByQLearning(const std::vector<std::string>& arguments);
int searchGridStructures(const std::vector<std::string>& arguments);  ///< tables 3.3-3.5 of the thesis

/// "lstm_planner train" and the arguments, for the model's metadata.
std::string trainCommandLine(const std::vector<std::string>& arguments);

}  // namespace lstm_planner
