// The rows of a store as text: its tables, the hash that every row carries, and what a process
// knows of the rows of a store.
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
  bool is_number = false;  // of 64 bits, as SQLite holds it: with a sign
  // The same from one run to the next. Times are not, nor what somebody disturbed, nor how far a
  // case was shrunk in its time.
  bool lasts = true;
};

// Every table has one column more, `hash`. Without row numbers: what a merged file holds then
// depends on its rows alone.
struct StoreTable {
  const char* name;
  std::vector<StoreColumn> columns;
  std::size_t key_columns;  // the first ones
};

const StoreTable& note_table();
const StoreTable& trial_table();
const StoreTable& failure_table();
const StoreTable& met_table();
const StoreTable& evidence_table();
std::array<const StoreTable*, 5> store_tables();

// As SQLite keeps it: "CREATE TABLE note(...) WITHOUT ROWID".
std::string declaration_of(const StoreTable& table);
// Makes all tables; one that is there already is left as it is.
std::string table_declarations();
// "id,family,...,hash"
std::string column_names(const StoreTable& table);

// A row's columns in their order, without the hash. Numbers are decimal.
using Row = std::vector<std::string>;

// The columns of a row that last.
Row lasting_columns(const StoreTable& table, const Row& row);

std::string text_of_number(std::uint64_t number);
// Throws StoreProblem (damaged_store) on a text that is none.
std::uint64_t number_of_text(const std::string& text);

// SHA-256 over the table's name and all columns, each behind its length: no two different rows have
// the same bytes. It shows a row that a disk, or somebody who does not mend the hash, changed. It
// is no signature: whoever may write the file can write a hash that fits.
std::string row_hash(const StoreTable& table, const Row& row);

// "trial quick:1:broken:3", "evidence canary, pair/x, 1/1"
std::string row_name(const StoreTable& table, const Row& row);

// Which rows there are, and the hash of each: what a process wrote, or found when it began. About
// 150 bytes a row.
class RowTally {
 public:
  void put(const std::string& name, const std::string& hash);
  void drop(const std::string& name) { hashes_.erase(name); }
  bool holds(const std::string& name, const std::string& hash) const;
  bool knows(const std::string& name) const { return hashes_.contains(name); }
  std::size_t size() const { return hashes_.size(); }
  // By name.
  void for_each_name(const std::function<void(const std::string&)>& visit) const;

 private:
  using Bytes = std::array<unsigned char, 32>;
  static Bytes bytes_of(const std::string& hash);
  std::map<std::string, Bytes> hashes_;
};

// Visits the rows of a table, in the order of `more` ("WHERE id=? ORDER BY place"; empty: of their
// keys), `bound` in the places of its question marks. Throws StoreProblem: not_as_stored at the
// first row that differs from `known`, where that is given; changed_row at the first that does not
// fit its own hash; and what SQLite says.
void for_each_row(const Database& database, const StoreTable& table, const RowTally* known,
                  const std::string& more, const std::vector<std::string>& bound,
                  const std::function<void(const Row&)>& visit);

// The row with its hash, in place of one of the same key or, where that is there, as `on_conflict`
// says ("(key) DO UPDATE SET ..."). Whether a row was written.
bool put_row(const Database& database, const StoreTable& table, const Row& row,
             const char* on_conflict = nullptr);

// Throws StoreProblem (not_as_stored) with the first row that the tally does not know, that differs
// or that is missing. O(rows).
void check_rows(const Database& database, const RowTally& known);

// Throws StoreProblem (damaged_store) unless the tables of the file are those of a store and there
// is nothing else in it, such as a trigger that changes rows by itself. Where `may_lack` some of
// them may not be there yet.
void check_tables(const Database& database, bool may_lack);

}  // namespace assay::properties
