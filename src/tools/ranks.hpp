#pragma once

#include <string>

#include "lstm_planner/common/communicator.hpp"

namespace lstm_planner {

/// The processes that run this program together: those that mpirun started, else this one alone. One object, in main().
///
/// MPI is started only where its launcher is seen in the environment, so that a process by itself does without. When a
/// rank dies or ends with an error, the launcher ends the others.
class MpiSession {
 public:
  /// Throws std::runtime_error when a launcher started several processes but the program was built without MPI.
  MpiSession(int* argc, char*** argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
};

/// All ranks; valid while the MpiSession is; one process alone before.
Communicator* ranks();

/// Alone, or rank 0 of many: the one that prints, and writes files.
bool isFirstRank();

/// Throws std::invalid_argument where several ranks run what is not shared among them.
void requireOneRank(const std::string& what);

/// Ends this process because of an error, and with it all other ranks, which would wait for it for ever.
[[noreturn]] void endAllRanks(int status);

}  // namespace lstm_planner
