#include "dataset/dataset_file.hpp"

#include <Poco/Data/SQLite/Connector.h>
#include <Poco/Data/SQLite/SQLiteException.h>
#include <Poco/Data/SQLite/Utility.h>
#include <Poco/Data/Statement.h>
#include <Poco/Nullable.h>
#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <system_error>

#include "dataset/dataset_schema.hpp"
#include "dataset/dataset_trust.hpp"
#include "lstm_planner/common/input_file.hpp"

namespace lstm_planner {
namespace {

using Poco::Data::Keywords::into;
using Poco::Data::Keywords::now;

void registerSqliteOnce() {
  static const bool registered = (Poco::Data::SQLite::Connector::registerConnector(), true);
  static_cast<void>(registered);
}

/// Whether there is something at the path; a folder or a pipe is an error in any case.
bool isThere(const std::string& path, const std::string& sentence) {
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown) && !unknown) return false;
  try {
    checkInputFile(path, std::numeric_limits<std::uintmax_t>::max());
  } catch (const InputFileError& error) {
    throw DatasetError(sentence + error.what());
  }
  return true;
}

constexpr int kLongestValue = 1 << 20;              // bytes; also of a row and of a statement
constexpr int kOperationsACall = 10000;             // of SQLite's virtual machine
constexpr std::uintmax_t kOperationsAByte = 20;     // reading and checking a step takes about one
constexpr std::int64_t kCallsOfAnEmptyFile = 1000;  // some tenths of a second

}  // namespace

DatasetFile::DatasetFile(const std::string& path, Use use, int patience, const std::string& name)
    : path_(path), name_(name.empty() ? path : name), use_(use) {
  const std::string sentence = "dataset '" + name_ + "' cannot be " + (use == Use::kRead ? "read: " : "written: ");
  if (path.empty()) throw DatasetError(sentence + "the path is empty");
  const bool was_there = isThere(path, sentence);
  if (!was_there && use != Use::kCreate) throw DatasetError(sentence + "there is no such file");
  guard([&] { open(patience); });
  try {
    // A new dataset is an empty file until its tables are there.
    if (use == Use::kCreate && numberOf("SELECT count(*) FROM sqlite_master") == 0) makeTables();
    checkVersion();
  } catch (const DatasetError&) {
    session_.reset();
    std::error_code ignored;
    if (!was_there) std::filesystem::remove(path, ignored);
    throw;
  }
}

void DatasetFile::open(int patience) {
  registerSqliteOnce();
  constexpr std::size_t kLoginTimeout = 10;  // s
  // An absolute path cannot be mistaken for a URI, and stays right where the process changes its folder.
  session_.emplace("SQLite", std::filesystem::absolute(path_).string(), kLoginTimeout);
  guard_.emplace(*session_);
  allowWork();
  execute("PRAGMA busy_timeout = " + std::to_string(patience));
  // With a rollback journal the one file is the whole dataset whenever nobody is writing; a write-ahead log would keep
  // the newest steps in a second file. EXTRA also syncs the folder, so that no journal is replayed after a power cut.
  execute("PRAGMA synchronous = EXTRA");
  execute("PRAGMA foreign_keys = ON");
  execute("PRAGMA ignore_check_constraints = ON");  // the schema has none; another's would be evaluated
  if (use_ == Use::kRead) execute("PRAGMA query_only = ON");
}

void DatasetFile::makeTables() {
  transact([this] {
    if (numberOf("SELECT count(*) FROM sqlite_master") != 0) return;
    execute("PRAGMA application_id = " + std::to_string(kDatasetApplicationId));
    execute("PRAGMA user_version = " + std::to_string(kDatasetSchemaVersion));
    for (const char* table : kDatasetSchema) execute(table);
  });
}

void DatasetFile::checkVersion() {
  if (numberOf("SELECT count(*) FROM sqlite_master") == 0) {
    throw DatasetError("'" + name_ + "' is empty, expected a dataset");
  }
  if (numberOf("PRAGMA application_id") != kDatasetApplicationId) {
    throw DatasetError("'" + name_ + "' is a database, but not a dataset of lstm_planner");
  }
  const long version = numberOf("PRAGMA user_version").value_or(0);
  if (version != kDatasetSchemaVersion) {
    throw DatasetError("dataset '" + name_ + "' has schema version " + std::to_string(version) + ", expected " +
                       std::to_string(kDatasetSchemaVersion) + ": it was made by a newer lstm_planner");
  }
  transact([this] {
    checkLength();
    const std::string flaw = flawOfSchema(*session_);
    if (!flaw.empty()) throw DatasetError("'" + name_ + "' is no dataset of lstm_planner: " + flaw);
  });
}

void DatasetFile::allowWork() {
  std::error_code error;
  const auto length = std::filesystem::file_size(path_, error);
  guard_->allow(error ? 0 : length);
}

void DatasetFile::checkLength() {
  // SQLite takes the missing part of a last page for zeros, which would look like measured values.
  const long pages = numberOf("PRAGMA page_count").value_or(0);
  const long expected = pages * numberOf("PRAGMA page_size").value_or(0);
  std::error_code error;
  const auto length = std::filesystem::file_size(path_, error);
  if (error || static_cast<long>(length) < expected) {
    throw DatasetError("dataset '" + name_ + "' is damaged: it is " + std::to_string(length) +
                       " bytes long, expected " + std::to_string(expected));
  }
}

void DatasetFile::execute(const std::string& statement) { *session_ << statement, now; }

std::optional<long> DatasetFile::numberOf(const std::string& query) {
  Poco::Nullable<Poco::Int64> number;
  guard([&] { *session_ << query, into(number), now; });
  if (number.isNull()) return std::nullopt;
  return static_cast<long>(number.value());
}

std::string DatasetFile::reason(const std::exception& error) const {
  if (guard_ && guard_->hasEndedQuery()) return "a query took much longer than the file's length gives reason to";
  // SQLite's own words do not depend on the version of Poco.
  if (session_ && dynamic_cast<const Poco::Data::SQLite::SQLiteException*>(&error) != nullptr) {
    const std::string words = Poco::Data::SQLite::Utility::lastError(*session_);
    if (!words.empty() && words != "not an error") return words;
  }
  const auto* from_poco = dynamic_cast<const Poco::Exception*>(&error);
  return from_poco != nullptr ? from_poco->displayText() : error.what();
}

void DatasetFile::fail(const std::exception& error) {
  const auto* known = dynamic_cast<const DatasetError*>(&error);
  const std::string sentence = known != nullptr ? known->what()
                                                : "dataset '" + name_ + "' cannot be " +
                                                      (use_ == Use::kRead ? "read: " : "written: ") + reason(error);
  if (in_transaction_) {
    in_transaction_ = false;
    try {
      execute("ROLLBACK");
    } catch (const Poco::Exception&) {
      // SQLite has rolled back by itself.
    }
  }
  throw DatasetError(sentence);
}

QueryGuard::QueryGuard(const Poco::Data::Session& session) : calls_left_(std::make_unique<std::int64_t>()) {
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
  const auto count = [](void* left) { return --*static_cast<std::int64_t*>(left) < 0 ? 1 : 0; };
  sqlite3_progress_handler(database, kOperationsACall, count, calls_left_.get());
}

void QueryGuard::allow(std::uintmax_t bytes) {
  *calls_left_ = kCallsOfAnEmptyFile + static_cast<std::int64_t>(bytes / kOperationsACall * kOperationsAByte);
}

}  // namespace lstm_planner
