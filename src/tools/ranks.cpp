#include "tools/ranks.hpp"

#include <cstdlib>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#ifdef LSTM_PLANNER_HAVE_MPI
#include <mpi.h>
#endif

namespace lstm_planner {
namespace {

std::unique_ptr<Communicator> communicator;

/// As a launcher of Open MPI, or of MPICH or Slurm, tells it; 0 where there is none.
int launchedProcesses() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    if (const char* size = std::getenv(name)) return std::atoi(size);
  }
  return 0;
}

#ifdef LSTM_PLANNER_HAVE_MPI

// Errors of MPI end all ranks with a message (MPI_ERRORS_ARE_FATAL, the default), so no return code is looked at.
class MpiCommunicator : public Communicator {
 public:
  MpiCommunicator() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void exchangeBytes(void* values, const std::vector<std::size_t>& bytes) override {
    std::vector<int> counts;
    std::vector<int> offsets;
    std::size_t offset = 0;
    for (const std::size_t count : bytes) {
      offsets.push_back(static_cast<int>(offset));
      counts.push_back(static_cast<int>(count));
      offset += count;
    }
    if (offset > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw std::length_error("the ranks were to exchange " + std::to_string(offset) +
                              " bytes at once, expected less than 2^31");
    }
    MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, values, counts.data(), offsets.data(), MPI_BYTE, MPI_COMM_WORLD);
  }

 private:
  int rank_ = 0;
  int size_ = 1;
};

#endif

}  // namespace

#ifdef LSTM_PLANNER_HAVE_MPI

MpiSession::MpiSession(int* argc, char*** argv) {
  if (launchedProcesses() < 1) return;
  int level = 0;
  MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &level);
  communicator = std::make_unique<MpiCommunicator>();
}

MpiSession::~MpiSession() {
  if (!communicator) return;
  // Where one returns another status than 0, mpirun ends the others: not before the first has written its files.
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Finalize();
  communicator.reset();
}

void endAllRanks(int status) {
  if (communicator) MPI_Abort(MPI_COMM_WORLD, status);
  std::exit(status);
}

#else

MpiSession::MpiSession(int* /*argc*/, char*** /*argv*/) {
  if (launchedProcesses() > 1) {
    throw std::runtime_error("this program was built without MPI, but " + std::to_string(launchedProcesses()) +
                             " processes of it were started, expected one");
  }
}

MpiSession::~MpiSession() = default;

void endAllRanks(int status) { std::exit(status); }

#endif

Communicator* ranks() { return communicator ? communicator.get() : oneProcess(); }

bool isFirstRank() { return ranks()->rank() == 0; }

}  // namespace lstm_planner
