// The rows of a store as text: the tables, the hash that every row carries, and the record that a
// process keeps of the rows that it knows.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "properties/campaign/database/sqlite.h"

namespace assay::properties {

struct StoreColumn {
  const char* name;
  bool is_number = false;  // a number of 64 bits, which SQLite holds with a sign
  // The column holds the same in every run of one campaign. False for times, for what was
  // disturbed from outside, and for how far a case could be shrunk in its time.
  bool lasts = true;
};

// Every table has one more column, `hash`. The tables have no row numbers, so that the content of
// a merged file depends on its rows alone.
struct StoreTable {
  const char* name;
  std::vector<StoreColumn> columns;
  std::size_t key_columns;  // how many of the first columns are the key
};

const StoreTable& note_table();
const StoreTable& trial_table();
const StoreTable& failure_table();
const StoreTable& met_table();
const StoreTable& evidence_table();
std::array<const StoreTable*, 5> store_tables();

// The table's declaration in the form in which SQLite keeps it: "CREATE TABLE note(...) WITHOUT
// ROWID".
std::string declaration_of(const StoreTable& table);
// The SQL that makes all tables, and leaves those that are there already as they are.
std::string table_declarations();
// "id,family,...,hash"
std::string column_names(const StoreTable& table);

// The columns of a row in their order, without the hash. Numbers are written in decimal.
using Row = std::vector<std::string>;

// The columns of a row that are the same in every run of one campaign.
Row lasting_columns(const StoreTable& table, const Row& row);

std::string text_of_number(std::uint64_t number);
// Throws StoreProblem if the text is not a number.
std::uint64_t number_of_text(const std::string& text);

// SHA-256 over the table's name and all columns, each behind its length, so that no two different
// rows give the same bytes. It shows that a row was changed by a disk, or by somebody who does not
// mend the hash. It is no signature: whoever may write the file can write a hash that fits.
std::string row_hash(const StoreTable& table, const Row& row);

// "trial quick:1:broken:3", "evidence canary, pair/x, 1/1"
std::string row_name(const StoreTable& table, const Row& row);

// The rows that a process knows, with the hash of each: those that it wrote, and those that it
// found when it began. About 150 bytes a row.
class RowTally {
 public:
  void put(const std::string& name, const std::string& hash);
  void drop(const std::string& name) { hashes_.erase(name); }
  bool holds(const std::string& name, const std::string& hash) const;
  bool knows(const std::string& name) const { return hashes_.contains(name); }
  std::size_t size() const { return hashes_.size(); }
  // Visits the names of the rows in ascending order.
  void for_each_name(const std::function<void(const std::string&)>& visit) const;

 private:
  using Bytes = std::array<unsigned char, 32>;
  static Bytes bytes_of(const std::string& hash);
  std::map<std::string, Bytes> hashes_;
};

// Visits the rows of a table. `more` is SQL such as "WHERE id=? ORDER BY place", whose question
// marks stand for the texts of `bound`; if it is empty the rows come in the order of their keys.
// Throws StoreProblem at the first row that does not fit its own hash, and if SQLite fails; of the
// kind not_as_stored at the first row that differs from `known`, if that is given.
void for_each_row(const Database& database, const StoreTable& table, const RowTally* known,
                  const std::string& more, const std::vector<std::string>& bound,
                  const std::function<void(const Row&)>& visit);

// Writes the row with its hash. It replaces a row of the same key, unless `on_conflict` ("(key) DO
// UPDATE SET ...") says what to do then. Returns whether a row was written.
bool put_row(const Database& database, const StoreTable& table, const Row& row,
             const char* on_conflict = nullptr);

// Throws a StoreProblem of the kind not_as_stored that names the first row that the tally does not
// know, that differs from it, or that is missing. O(rows).
void check_rows(const Database& database, const RowTally& known);

// Throws StoreProblem unless the tables of the file are those of a store and
// nothing else is in it, such as a trigger that changes rows by itself. If `may_lack` is set, some
// of the tables may not be there yet.
void check_tables(const Database& database, bool may_lack);

}  // namespace assay::properties
