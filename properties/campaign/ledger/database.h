// Wraps the few parts of SQLite that a store needs: databases and statements. Also locks a file
// for one process, and reads and writes the rows of a store.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "properties/worker/child_process.h"

struct sqlite3;
struct sqlite3_stmt;

namespace assay::properties {

// The exception with which a store reports a problem inside of campaign/. A store can fail in the
// middle of a row, deep inside of a phase and in any thread, and an exception is the short way out
// of there. The functions that other rooms call return the problem as a value.

class StoreProblem : public std::runtime_error {
 public:
  explicit StoreProblem(const Problem& problem) : std::runtime_error(problem.message) {}
  explicit StoreProblem(const std::string& message) : std::runtime_error(message) {}

  Problem problem() const { return {what()}; }
};

// Returns the value. Throws StoreProblem if there is a problem in place of a value.
template <class T>
T value_or_throw(Expected<T>&& expectation) {
  if (!expectation) throw StoreProblem(expectation.error());
  if constexpr (!std::is_void_v<T>) return std::move(expectation.value());
}

// Returns the result of `work`, or, if `work` throws a StoreProblem, the problem as a value.
template <class Work>
Expected<std::invoke_result_t<Work>> catch_store_problem(const Work& work) {
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Work>>) {
      work();
      return boost::outcome_v2::success();
    } else {
      return work();
    }
  } catch (const StoreProblem& failure) {
    return failure.problem();
  }
}

// The functions of Database and Statement throw StoreProblem if the disk is full, or if the file is
// damaged, is no file of SQLite, or cannot be read or written any more. The message is SQLite's own
// message with the name of the file.
class Database {
 public:
  enum class Mode : std::uint8_t { read, write };
  // Opens the file. Mode::write creates it if it does not exist.
  Database(const std::filesystem::path& file, Mode mode);

  // Runs one statement or several, without results.
  void run(const std::string& sql) const;
  // Throws StoreProblem if a page of the file is damaged.
  void check_whole() const;
  std::string file() const;
  sqlite3* handle() const { return db_.get(); }

 private:
  std::shared_ptr<sqlite3> db_;
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
  // Goes to the next row; returns false if there is none.
  bool next();
  std::string text(int column) const;
  std::uint64_t number(int column) const;

 private:
  void check(int code) const;
  const Database& database_;
  sqlite3_stmt* statement_ = nullptr;
  int values_ = 0;
};

// Locks a file until the descriptor is closed or this process ends in any way. Makes the file if it
// does not exist; the file is not removed afterwards. Throws StoreProblem if the file cannot be
// opened. If the file is locked already, the message is `if_busy`.
Descriptor lock_file(const std::filesystem::path& file, const std::string& if_busy);

// A row of a ledger. A campaign stores everything in rows: a trial, a failure, a note, a planted
// fault that was found. Every row carries a hash.

struct Row {
  std::string kind;            // "trial", "canary", ...
  std::string key;             // no other row of this kind has the same key
  std::uint64_t progress = 0;  // the row with more progress replaces a row of the same key
  std::string fields;          // a JSON object
  friend bool operator==(const Row&, const Row&) = default;
};

// The kinds that every store has. The other kinds are in evidence.h.
inline constexpr std::string_view binding_kind = "binding", note_kind = "note",
                                  trial_kind = "trial", failure_kind = "failure", met_kind = "met";

// Returns the row without the fields that may differ between two runs of one campaign: times,
// disturbances from outside, the output of a plug-in, and the smallest mesh found within the time.
Row lasting(Row row);

// Returns the SHA-256 over all columns of the row, each column behind its length, so that no two
// different rows give the same bytes. The hash reveals a row that a disk changed, or that somebody
// changed without a new hash. The hash is no signature: anybody who can write the file can also
// write the right hash.
std::string row_hash(const Row& row);

// Returns "trial quick:1:broken:3", "canary pair/x".
std::string row_name(const Row& row);

// Returns the SQL statement that makes the table of a store if the table does not exist yet.
std::string table_declaration();

// Visits rows. `more` is SQL such as "WHERE kind=? ORDER BY key", whose question marks stand for
// the texts of `values`; if `more` is empty, all rows come in the order of kind and key.
// Throws StoreProblem at the first row whose hash is wrong, and if SQLite fails.
void for_each_row(const Database& database, const std::string& more,
                  const std::vector<std::string_view>& values,
                  const std::function<void(const Row&)>& visit);

// Writes the row with its hash, in place of a row of the same kind and key.
void put_row(const Database& database, const Row& row);

// Throws StoreProblem if the file holds anything besides the table of a store, such as a trigger
// that changes rows by itself, or if `may_lack` is false and the file lacks the table.
void check_tables(const Database& database, bool may_lack);

}  // namespace assay::properties
