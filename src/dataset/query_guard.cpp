#include "dataset/query_guard.hpp"

#include <Poco/Data/SQLite/Utility.h>
#include <sqlite3.h>

namespace lstm_planner {

namespace {

constexpr int kLongestValue = 1 << 20;              // bytes; also of a row and of a statement
constexpr int kOperationsACall = 10000;             // of SQLite's virtual machine
constexpr std::uintmax_t kOperationsAByte = 20;     // reading and checking a step takes about one
constexpr std::int64_t kCallsOfAnEmptyFile = 1000;  // some tenths of a second

}  // namespace

QueryGuard::QueryGuard(const Poco::Data::Session& session) : work_(std::make_unique<Work>()) {
  sqlite3* const database = Poco::Data::SQLite::Utility::dbHandle(session);
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, kLongestValue);
  sqlite3_limit(database, SQLITE_LIMIT_SQL_LENGTH, kLongestValue);
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
#ifdef SQLITE_DBCONFIG_ENABLE_VIEW
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
#endif
#ifdef SQLITE_DBCONFIG_TRUSTED_SCHEMA
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
#endif
  allow(0);
  const auto count = [](void* work) { return --static_cast<Work*>(work)->left < 0 ? 1 : 0; };
  sqlite3_progress_handler(database, kOperationsACall, count, work_.get());
}

void QueryGuard::allow(std::uintmax_t bytes) {
  work_->left = kCallsOfAnEmptyFile + static_cast<std::int64_t>(bytes / kOperationsACall * kOperationsAByte);
}

}  // namespace lstm_planner
