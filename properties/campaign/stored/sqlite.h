// The little of SQLite that a store needs: a database, and one statement at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace assay::properties {

// The disk is full, or the file cannot be read or written any more: no fault of the harness.
class StoreProblem : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;  // one line, names the file
};

class Database {
 public:
  enum class Mode : std::uint8_t { read, write };
  // write makes the file where there is none. Throws StoreProblem.
  Database(const std::filesystem::path& file, Mode mode);
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database();

  // One statement or several, without results. Throws StoreProblem.
  void run(const std::string& sql) const;
  // Throws StoreProblem when a page is damaged.
  void check_whole() const;
  std::string file() const;
  sqlite3* handle() const { return db_; }

 private:
  sqlite3* db_ = nullptr;
};

// A prepared statement, finalized with the object. Everything throws StoreProblem.
class Statement {
 public:
  Statement(const Database& database, const std::string& sql);
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement();

  Statement& bind(const std::string& text);
  Statement& bind(std::uint64_t number);
  // True while there is a row.
  bool next();
  std::string text(int column) const;
  std::uint64_t number(int column) const;
  // By the statement that ran last.
  bool changed_a_row() const;

 private:
  void check(int code) const;
  const Database& database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

}  // namespace assay::properties
