#pragma once

#include <Poco/Data/Session.h>

#include <cstdint>
#include <memory>

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
  bool hasEndedQuery() const { return work_->left < 0; }

 private:
  struct Work {
    std::int64_t left = 0;  ///< calls of the progress handler
  };
  std::unique_ptr<Work> work_;
};

}  // namespace lstm_planner
