#pragma once

#include <string>
#include <vector>

namespace lstm_planner {

/// A sub-command of the tool: takes the arguments behind its name, returns the exit status. Bad arguments are thrown as
/// exceptions whose what() is the sentence for the user.
struct Command {
  const char* name;
  const char* summary;
  int (*run)(const std::vector<std::string>& arguments);
  bool shared = false;  ///< the processes that mpirun starts share the work; else there must be one only
};

int runDrive(const std::vector<std::string>& arguments);
int runJudge(const std::vector<std::string>& arguments);
int runTrain(const std::vector<std::string>& arguments);
int runEvaluate(const std::vector<std::string>& arguments);
int runReport(const std::vector<std::string>& arguments);
int runMaps(const std::vector<std::string>& arguments);
int runDataset(const std::vector<std::string>& arguments);

}  // namespace lstm_planner
