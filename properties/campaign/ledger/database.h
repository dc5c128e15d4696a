// The little of SQLite that a store needs: a database, and one statement at a time; and a lock on a
// file or a folder that only one process at a time works on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "properties/campaign/ledger/store_problem.h"

struct sqlite3;
struct sqlite3_stmt;

namespace assay::properties {

// Everything here throws StoreProblem if the disk is full, the file is damaged or not one of
// SQLite, or it cannot be read or written any more. The message is SQLite's own and names the
// file.
class Database {
 public:
  enum class Mode : std::uint8_t { read, write };
  // Mode write makes the file if there is none.
  Database(const std::filesystem::path& file, Mode mode);
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database();

  // Runs one statement or several, without results.
  void run(const std::string& sql) const;
  // Throws if a page is damaged.
  void check_whole() const;
  std::string file() const;
  sqlite3* handle() const { return db_; }

 private:
  sqlite3* db_ = nullptr;
};

// A prepared statement, finalized with the object.
class Statement {
 public:
  Statement(const Database& database, const std::string& sql);
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement();

  Statement& bind(std::string_view text);
  Statement& bind(std::uint64_t number);
  // Goes to the next row; false if there is none.
  bool next();
  std::string text(int column) const;
  std::uint64_t number(int column) const;

 private:
  void check(int code) const;
  const Database& database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

// A lock that is held until this object or its process ends, however it ends.
class FileLock {
 public:
  enum class On {
    file,    // the file is made if it is not there, and stays
    folder,  // nothing stays of the lock
  };
  // Throws StoreProblem if it cannot be opened, and, with the text `if_busy`, if another process
  // holds it.
  FileLock(const std::filesystem::path& path, On on, const std::string& if_busy);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  int lock_ = -1;
};

}  // namespace assay::properties
