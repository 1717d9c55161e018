#include "tools/ranks.hpp"

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <mutex>
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

constexpr int kFirstRank = 0;
constexpr int kRequestTag = 1;
constexpr int kTicketTag = 2;

/// The first rank hands the tickets out.
class TicketOffice : public Tickets {
 public:
  TicketOffice(std::int64_t count, int ranks) : count_(count), others_(ranks - 1) {}

  std::size_t draw() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    answerWaiting();
    const std::int64_t drawn = next();
    // The others know that there is none left only when they are told.
    while (drawn == count_ && others_ > 0) {
      MPI_Probe(MPI_ANY_SOURCE, kRequestTag, MPI_COMM_WORLD, &from_);
      answer();
    }
    return static_cast<std::size_t>(drawn);
  }

  void letOthersDraw() override {
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (lock) answerWaiting();
  }

 private:
  std::int64_t next() { return next_ < count_ ? next_++ : count_; }

  void answerWaiting() {
    for (int here = 1; here != 0;) {
      MPI_Iprobe(MPI_ANY_SOURCE, kRequestTag, MPI_COMM_WORLD, &here, &from_);
      if (here != 0) answer();
    }
  }

  void answer() {
    MPI_Recv(nullptr, 0, MPI_BYTE, from_.MPI_SOURCE, kRequestTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    const std::int64_t ticket = next();
    if (ticket == count_) --others_;
    MPI_Send(&ticket, 1, MPI_INT64_T, from_.MPI_SOURCE, kTicketTag, MPI_COMM_WORLD);
  }

  std::mutex mutex_;
  std::int64_t count_;
  std::int64_t next_ = 0;
  int others_;  ///< ranks that have not been told that there is none left
  MPI_Status from_;
};

/// The other ranks ask for a ticket while they work on the one before, so that they need not wait for the first rank,
/// which answers between pieces of its own work.
class RequestedTickets : public Tickets {
 public:
  explicit RequestedTickets(std::int64_t count) : count_(count) { ask(); }

  std::size_t draw() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    MPI_Wait(&request_, MPI_STATUS_IGNORE);
    const std::int64_t drawn = next_;
    if (drawn < count_) ask();
    return static_cast<std::size_t>(drawn);
  }

 private:
  void ask() {
    MPI_Irecv(&next_, 1, MPI_INT64_T, kFirstRank, kTicketTag, MPI_COMM_WORLD, &request_);
    MPI_Send(nullptr, 0, MPI_BYTE, kFirstRank, kRequestTag, MPI_COMM_WORLD);
  }

  std::mutex mutex_;
  std::int64_t count_;
  std::int64_t next_ = 0;  ///< is written until request_ is done
  MPI_Request request_ = MPI_REQUEST_NULL;
};

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

  std::unique_ptr<Tickets> tickets(std::size_t count) override {
    const auto tickets = static_cast<std::int64_t>(count);
    if (rank_ == kFirstRank) return std::make_unique<TicketOffice>(tickets, size_);
    return std::make_unique<RequestedTickets>(tickets);
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
  MPI_Init_thread(argc, argv, MPI_THREAD_SERIALIZED, &level);
  if (level < MPI_THREAD_SERIALIZED) {
    throw std::runtime_error("this MPI has thread level " + std::to_string(level) + ", expected at least " +
                             std::to_string(MPI_THREAD_SERIALIZED) + " (MPI_THREAD_SERIALIZED)");
  }
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

void requireOneRank(const std::string& what) {
  if (ranks()->size() == 1) return;
  throw std::invalid_argument(what + " is run by one process, not by " + std::to_string(ranks()->size()));
}

}  // namespace lstm_planner
