#include "lstm_planner/dataset/dataset_writer.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dataset/dataset_file.hpp"
#include "dataset/dataset_rows.hpp"
#include "dataset/dataset_trust.hpp"

namespace lstm_planner {

namespace {

constexpr int kPatienceToStart = 5000;        // ms
constexpr int kPatienceWhileRecording = 100;  // ms; longer would hold up whoever records
constexpr int kPatienceToFinish = 10000;      // ms
constexpr long kMostWaiting = 10000;          // steps; with scans of 1080 beams some 50 MB
constexpr std::size_t kMostEntries = 2 * kMostWaiting;
constexpr long kLostEpisode = -1;    // its steps are lost, too
constexpr std::size_t kBatch = 200;  // calls a transaction, so that a backlog goes out piece by piece

/// A call that is to be written.
struct Entry {
  bool is_step = false;
  std::function<void(DatasetRows*)> write;
};

/// What tells a file from another one that has taken its place.
std::pair<dev_t, ino_t> identityOf(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {};
  return {status.st_dev, status.st_ino};
}

/// Whether the path still leads to the open file: its last holder may have unlinked it in between.
bool isStillThere(const std::string& path, int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && identityOf(path) == std::make_pair(status.st_dev, status.st_ino);
}

/// Keeps a second writer off a dataset file as long as it lives, by a lock on a file PATH.lock beside it. A lock on the
/// file itself would not do: SQLite's own locks are of the kind that the process loses when it closes any descriptor of
/// the file. A process that dies leaves an unlocked PATH.lock, which disturbs nobody.
class DatasetLock {
 public:
  /// Throws DatasetError when another process, or another writer of this one, has it.
  explicit DatasetLock(const std::string& path) : lock_path_(path + ".lock") {
    constexpr int kTries = 100;
    for (int i = 0; i < kTries; ++i) {
      descriptor_ = ::open(lock_path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (descriptor_ < 0) {
        throw DatasetError("dataset '" + path + "' cannot be written: '" + lock_path_ + "': " + std::strerror(errno));
      }
      if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) {
        if (isStillThere(lock_path_, descriptor_)) return;
      } else if (errno == EWOULDBLOCK) {
        ::close(descriptor_);
        throw DatasetError("dataset '" + path + "' is being recorded by another writer");
      } else {
        const int reason = errno;
        ::close(descriptor_);
        throw DatasetError("dataset '" + path + "' cannot be locked: '" + lock_path_ + "': " + std::strerror(reason));
      }
      ::close(descriptor_);
    }
    throw DatasetError("dataset '" + path + "' cannot be locked: '" + lock_path_ + "' comes and goes");
  }
  ~DatasetLock() {
    ::unlink(lock_path_.c_str());
    ::close(descriptor_);
  }
  DatasetLock(const DatasetLock&) = delete;
  DatasetLock& operator=(const DatasetLock&) = delete;

 private:
  std::string lock_path_;
  int descriptor_ = -1;
};

}  // namespace

class DatasetWriter::Implementation {
 public:
  Implementation(const std::string& path, const RecordingDescription& description)
      : path_(path), angles_(description.parameters.action_angles.size()), lock_(path) {
    file_.emplace(path, DatasetFile::Use::kCreate, kPatienceToStart);
    file_->transact([&] {
      recording_ = nextRecording(&*file_);
      next_episode_ = nextEpisode(&*file_);
      DatasetRows(&*file_).addRecording(recording_, description);
    });
    identity_ = identityOf(path);
    reopen();
  }

  void startEpisode(const Episode& episode) {
    checkRunning();
    checkRow(episode);
    last_number_ = -1;
    has_episode_ = true;
    is_kept_ = waiting_.size() < kMostEntries;
    episodes_.push_back(is_kept_ ? next_episode_++ : kLostEpisode);
    if (is_kept_) {
      later([this, id = episodes_.back(), episode](DatasetRows* rows) { rows->addEpisode(id, recording_, episode); });
    }
    write();
  }

  void addStep(const DriveStep& step) {
    checkRunning();
    if (!has_episode_) throw std::logic_error("a step was added before an episode was started");
    if (step.number <= last_number_) {
      throw std::invalid_argument("step " + std::to_string(step.number) + " was added after step " +
                                  std::to_string(last_number_) + " of the same episode");
    }
    checkStepWithScan(step, angles_);
    last_number_ = step.number;
    if (!is_kept_ || waiting_steps_ >= kMostWaiting) {
      ++lost_;
    } else {
      waiting_.push_back({true, [id = next_episode_ - 1, step](DatasetRows* rows) { rows->addStep(id, step); }});
      ++waiting_steps_;
    }
    write();
  }

  void endEpisode(double stamp, EpisodeEnd end) {
    checkRunning();
    if (!has_episode_) throw std::logic_error("an episode was ended before one was started");
    checkNumber("ended", stamp);
    has_episode_ = false;
    if (is_kept_) later([id = next_episode_ - 1, stamp, end](DatasetRows* rows) { rows->endEpisode(id, stamp, end); });
    write();
  }

  void reject(Rejection rejection) {
    ++rejections_.at(static_cast<std::size_t>(rejection));
    has_new_rejections_ = true;
  }

  bool discardEpisode() {
    checkRunning();
    if (episodes_.empty()) return false;
    const long id = episodes_.back();
    if (id != kLostEpisode) later([id](DatasetRows* rows) { rows->discardEpisode(id); });
    episodes_.pop_back();
    write();
    return true;
  }

  void finish() {
    if (finished_) return;
    if (!finish_waits_) later([this](DatasetRows* rows) { rows->finishRecording(recording_); });
    finish_waits_ = true;
    patience_ = kPatienceToFinish;
    file_.reset();
    write();
    patience_ = kPatienceWhileRecording;
    if (!waiting_.empty()) {
      throw DatasetError(problem_ + "; " + std::to_string(waiting_steps_ + lost_) + " steps are not in it");
    }
    finished_ = true;
    close();
    if (lost_ > 0) {
      throw DatasetError("dataset '" + path_ + "' could not be written for a while; " + std::to_string(lost_) +
                         " steps are not in it");
    }
  }

  long stored_ = 0;
  long waiting_steps_ = 0;
  long lost_ = 0;
  std::string problem_;
  const std::string path_;

 private:
  void checkRunning() const {
    if (finish_waits_) throw std::logic_error("dataset '" + path_ + "' is finished");
  }

  void close() {
    rows_.reset();
    file_.reset();
    lock_.reset();
  }

  void reopen() {
    rows_.reset();
    file_.reset();
    if (identityOf(path_) != identity_) {
      throw DatasetError("dataset '" + path_ + "' cannot be written: it was moved or deleted while being recorded");
    }
    file_.emplace(path_, DatasetFile::Use::kWrite, patience_);
    rows_.emplace(&*file_);
  }

  void later(std::function<void(DatasetRows*)> write) { waiting_.push_back({false, std::move(write)}); }

  /// Writes what is waiting, as far as it can be written.
  void write() {
    while (!waiting_.empty()) {
      const std::size_t count = std::min(waiting_.size(), kBatch);
      try {
        if (!file_ || identityOf(path_) != identity_) reopen();
        file_->transact([&] { writeFirst(count); });
      } catch (const DatasetError& error) {
        problem_ = error.what();
        // Whatever state the connection and its statements are in, a new one rolls back what is half written.
        rows_.reset();
        file_.reset();
        return;
      }
      has_new_rejections_ = false;
      forgetFirst(count);
    }
    problem_.clear();
  }

  void writeFirst(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) waiting_[i].write(&*rows_);
    if (has_new_rejections_) rows_->setRejections(recording_, rejections_);
  }

  void forgetFirst(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (waiting_.front().is_step) {
        ++stored_;
        --waiting_steps_;
      }
      waiting_.pop_front();
    }
  }

  const std::size_t angles_;
  std::optional<DatasetLock> lock_;
  std::optional<DatasetFile> file_;
  std::optional<DatasetRows> rows_;
  std::pair<dev_t, ino_t> identity_;
  int patience_ = kPatienceWhileRecording;
  long recording_ = 0;
  long next_episode_ = 0;
  std::vector<long> episodes_;  ///< that are not discarded
  bool has_episode_ = false;
  bool is_kept_ = false;  ///< whether the running episode will be written
  long last_number_ = -1;
  bool finish_waits_ = false;
  bool finished_ = false;
  RejectionCounts rejections_{};
  bool has_new_rejections_ = false;
  std::deque<Entry> waiting_;
};

DatasetWriter::DatasetWriter(const std::string& path, const RecordingDescription& description)
    : implementation_(std::make_unique<Implementation>(path, description)) {}

DatasetWriter::~DatasetWriter() {
  try {
    implementation_->finish();
  } catch (const std::exception&) {
    // Whoever wants to know calls finish().
  }
}

void DatasetWriter::startEpisode(const Episode& episode) { implementation_->startEpisode(episode); }
void DatasetWriter::addStep(const DriveStep& step) { implementation_->addStep(step); }
void DatasetWriter::endEpisode(double stamp, EpisodeEnd end) { implementation_->endEpisode(stamp, end); }
void DatasetWriter::reject(Rejection rejection) { implementation_->reject(rejection); }
bool DatasetWriter::discardEpisode() { return implementation_->discardEpisode(); }
void DatasetWriter::finish() { implementation_->finish(); }
long DatasetWriter::stored() const { return implementation_->stored_; }
long DatasetWriter::waiting() const { return implementation_->waiting_steps_; }
long DatasetWriter::lost() const { return implementation_->lost_; }
const std::string& DatasetWriter::problem() const { return implementation_->problem_; }

}  // namespace lstm_planner
