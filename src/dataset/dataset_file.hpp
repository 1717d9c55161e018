#pragma once

#include <Poco/Data/Session.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "lstm_planner/dataset/dataset.hpp"

namespace lstm_planner {

/// Keeps a database that somebody has made on purpose from holding up or filling the memory of whoever opens it: views
/// and triggers do not run, values are at most a mebibyte long, and queries end after as much work as their file's
/// length gives reason to.
class QueryGuard {
 public:
  /// Over a session with an SQLite database, as long as both live.
  explicit QueryGuard(const Poco::Data::Session& session);
  QueryGuard(const QueryGuard&) = delete;
  QueryGuard& operator=(const QueryGuard&) = delete;

  /// Starts to count anew, for queries of a file of so many bytes.
  void allow(std::uintmax_t bytes);

  /// Whether the last query was ended because it took too long.
  bool hasEndedQuery() const { return *calls_left_ < 0; }

 private:
  std::unique_ptr<std::int64_t> calls_left_;  ///< of the progress handler
};

/// An open dataset file, which nobody need trust. What SQLite complains about is thrown as DatasetError, one sentence
/// with the path.
class DatasetFile {
 public:
  enum class Use {
    kRead,
    kWrite,   ///< a dataset that is there
    kCreate,  ///< made where there is none; a dataset that is there will do, too
  };

  /// `patience`: ms to wait for others who have the file locked. Throws DatasetError when it is missing, no dataset,
  /// damaged, or of a newer schema. `name`: what sentences call it; the path where it is empty.
  DatasetFile(const std::string& path, Use use, int patience, const std::string& name = "");
  DatasetFile(const DatasetFile&) = delete;
  DatasetFile& operator=(const DatasetFile&) = delete;

  /// Runs `work` in a transaction: all of it is on the disk, or nothing. Throws DatasetError.
  template <typename Work>
  void transact(Work&& work) {
    guard([&] {
      allowWork();
      execute(use_ == Use::kRead ? "BEGIN" : "BEGIN IMMEDIATE");
      in_transaction_ = true;
      work();
      execute("COMMIT");
      in_transaction_ = false;
    });
  }

  /// Throws Poco exceptions, which transact() translates.
  void execute(const std::string& statement);

  /// The first number of a query's first row; empty when there is none. Throws DatasetError.
  std::optional<long> numberOf(const std::string& query);

  Poco::Data::Session& session() { return *session_; }

 private:
  template <typename Work>
  void guard(Work&& work) {
    try {
      work();
    } catch (const std::exception& error) {
      fail(error);
    }
  }
  void open(int patience);
  void checkVersion();
  void checkLength();
  void allowWork();
  void makeTables();
  std::string reason(const std::exception& error) const;
  [[noreturn]] void fail(const std::exception& error);

  std::string path_;
  std::string name_;
  Use use_;
  bool in_transaction_ = false;
  std::optional<QueryGuard> guard_;  ///< outlives the session, which calls it
  std::optional<Poco::Data::Session> session_;
};

}  // namespace lstm_planner
