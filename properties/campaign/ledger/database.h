// The few parts of SQLite that a store needs: a database, and one statement at a time; a lock that
// gives one process a file to itself; the rows of a store; and its problems.
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

// A store reports a problem by an exception inside of campaign/, and by a value outside of it.
//
// A store may fail in the middle of a row, deep inside of a phase and in any of its threads, and
// there an exception is the short way out. Functions for other rooms turn it into a Problem.

class StoreProblem : public std::runtime_error {
 public:
  explicit StoreProblem(const Problem& problem) : std::runtime_error(problem.message) {}
  explicit StoreProblem(const std::string& message) : std::runtime_error(message) {}

  Problem problem() const { return {what()}; }
};

// Returns the value, or throws its problem.
template <class T>
T value_or_throw(Expected<T>&& expectation) {
  if (!expectation) throw StoreProblem(expectation.error());
  if constexpr (!std::is_void_v<T>) return std::move(expectation.value());
}

// Returns what `work` returns, or the StoreProblem that it throws as a value.
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

// Everything here throws StoreProblem if the disk is full, the file is damaged or not one of
// SQLite, or it cannot be read or written any more. The message is SQLite's own and names the
// file.
class Database {
 public:
  enum class Mode : std::uint8_t { read, write };
  // Opens the file. Mode::write creates it if it does not exist.
  Database(const std::filesystem::path& file, Mode mode);

  // Runs one statement or several, without results.
  void run(const std::string& sql) const;
  // Throws if a page is damaged.
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

// Locks a file until the descriptor is closed or this process ends, however it ends. The file is
// made if it is not there, and stays. Throws StoreProblem if it cannot be opened, and, with the
// text `if_busy`, if it is locked.
Descriptor lock_file(const std::filesystem::path& file, const std::string& if_busy);

// A row of a ledger. A campaign stores everything in rows: a trial, a failure, a note, a planted
// fault that was found. Every row carries a hash.

struct Row {
  std::string kind;            // "trial", "canary", ...
  std::string key;             // names the row among those of its kind
  std::uint64_t progress = 0;  // of two rows with the same key, that with more progress stays
  std::string fields;          // a JSON object
  friend bool operator==(const Row&, const Row&) = default;
};

// The kinds that every store has. The other kinds are in evidence.h.
inline constexpr std::string_view binding_kind = "binding", note_kind = "note",
                                  trial_kind = "trial", failure_kind = "failure", met_kind = "met";

// Returns the row without the fields that may differ between two runs of one campaign: times,
// disturbances from outside, and how far a case could be shrunk in its time.
Row lasting(Row row);

// Returns the SHA-256 over the whole row, each column behind its length, so that no two different
// rows give the same bytes. It reveals a row that was changed by a disk, or by somebody who did not
// renew the hash. It is no signature: whoever may write the file can write a hash that fits.
std::string row_hash(const Row& row);

// Returns "trial quick:1:broken:3", "canary pair/x".
std::string row_name(const Row& row);

// Returns the SQL that makes the one table of a store unless it exists.
std::string table_declaration();

// Visits rows. `more` is SQL such as "WHERE kind=? ORDER BY key", whose question marks stand for
// the texts of `values`; if `more` is empty, all rows come in the order of kind and key.
// Throws StoreProblem at the first row that does not fit its own hash, and if SQLite fails.
void for_each_row(const Database& database, const std::string& more,
                  const std::vector<std::string_view>& values,
                  const std::function<void(const Row&)>& visit);

// Writes the row with its hash, in place of a row of the same kind and key.
void put_row(const Database& database, const Row& row);

// Throws StoreProblem unless the file holds the table of a store and nothing else, such as a
// trigger that changes rows by itself. If `may_lack` is set, the table may be missing.
void check_tables(const Database& database, bool may_lack);

}  // namespace assay::properties
