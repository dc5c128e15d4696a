#include "properties/campaign/database/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "corpus/digest.h"

namespace assay::properties {

const StoreTable& note_table() {
  static const StoreTable table{"note", {{"key"}, {"value"}}, 1};
  return table;
}

const StoreTable& trial_table() {
  static const StoreTable table{"trial",
                                {{"id"},
                                 {"family"},
                                 {"place", true},
                                 {"outcomes"},
                                 {"triangles", true},
                                 {"steps", true},
                                 {"collisions", true},
                                 {"pairs", true},
                                 {"oracle_us", true, false},
                                 {"detector_us", true, false},
                                 {"counts"},
                                 {"mesh", true},
                                 {"disturbed", true, false},
                                 {"slowest_us", true, false}},
                                1};
  return table;
}

const StoreTable& failure_table() {
  static const StoreTable table{"failure",
                                {{"id"},
                                 {"configuration"},
                                 {"signature"},
                                 {"what"},
                                 {"mesh"},
                                 {"smallest", false, false},
                                 {"flaky", true},
                                 {"printed", false, false}},
                                2};
  return table;
}

const StoreTable& met_table() {
  static const StoreTable table{"met", {{"id"}, {"configuration"}, {"signature"}}, 2};
  return table;
}

const StoreTable& evidence_table() {
  static const StoreTable table{
      "evidence", {{"kind"}, {"name"}, {"shard"}, {"progress", true}, {"facts"}}, 3};
  return table;
}

std::array<const StoreTable*, 5> store_tables() {
  return {&note_table(), &trial_table(), &failure_table(), &met_table(), &evidence_table()};
}

std::string declaration_of(const StoreTable& table) {
  std::string columns, key;
  for (const auto& column : table.columns)
    columns += fmt::format("{} {} NOT NULL, ", column.name, column.is_number ? "INTEGER" : "TEXT");
  for (std::size_t c = 0; c < table.key_columns; ++c)
    key += fmt::format("{}{}", c > 0 ? ", " : "", table.columns[c].name);
  return fmt::format("CREATE TABLE {}({}hash TEXT NOT NULL, PRIMARY KEY({})) WITHOUT ROWID",
                     table.name, columns, key);
}

std::string table_declarations() {
  constexpr std::string_view create = "CREATE TABLE ";
  std::string all;
  for (const auto* table : store_tables()) {
    all +=
        fmt::format("CREATE TABLE IF NOT EXISTS {};", declaration_of(*table).substr(create.size()));
  }
  return all;
}

std::string column_names(const StoreTable& table) {
  std::string names;
  for (const auto& column : table.columns) names += fmt::format("{},", column.name);
  return names + "hash";
}

Row lasting_columns(const StoreTable& table, const Row& row) {
  Row lasting;
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (table.columns[c].lasts) lasting.push_back(row[c]);
  }
  return lasting;
}

std::string text_of_number(std::uint64_t number) {
  return std::to_string(static_cast<std::int64_t>(number));
}

std::uint64_t number_of_text(const std::string& text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    throw StoreProblem(fmt::format("'{}' stands where a number belongs", text));
  return static_cast<std::uint64_t>(number);
}

std::string row_hash(const StoreTable& table, const Row& row) {
  const std::string_view name = table.name;
  std::string bytes = fmt::format("{}:{}", name.size(), name);
  for (const auto& column : row) {
    bytes += fmt::format("{}:", column.size());
    bytes += column;
  }
  return corpus::sha256_of(bytes);
}

std::string row_name(const StoreTable& table, const Row& row) {
  std::string name = table.name;
  for (std::size_t c = 0; c < table.key_columns; ++c) {
    name += c > 0 ? ", " : " ";
    name += row[c];
  }
  return name;
}

RowTally::Bytes RowTally::bytes_of(const std::string& hash) {
  Bytes bytes{};
  constexpr int hexadecimal = 16;
  for (std::size_t i = 0; i < bytes.size() && 2 * i + 2 <= hash.size(); ++i)
    std::from_chars(hash.data() + 2 * i, hash.data() + 2 * i + 2, bytes[i], hexadecimal);
  return bytes;
}

void RowTally::put(const std::string& name, const std::string& hash) {
  hashes_[name] = bytes_of(hash);
}

bool RowTally::holds(const std::string& name, const std::string& hash) const {
  const auto found = hashes_.find(name);
  return found != hashes_.end() && found->second == bytes_of(hash);
}

void RowTally::for_each_name(const std::function<void(const std::string&)>& visit) const {
  for (const auto& [name, hash] : hashes_) visit(name);
}

void for_each_row(const Database& database, const StoreTable& table, const RowTally* known,
                  const std::string& more, const std::vector<std::string>& bound,
                  const std::function<void(const Row&)>& visit) {
  Statement rows(database,
                 fmt::format("SELECT {} FROM {} {}", column_names(table), table.name, more));
  for (const auto& text : bound) rows.bind(text);
  const auto count = static_cast<int>(table.columns.size());
  while (rows.next()) {
    Row row;
    for (int c = 0; c < count; ++c) row.push_back(rows.text(c));
    const auto hash = row_hash(table, row), name = row_name(table, row);
    // This is reported before a hash that does not fit, because it says more: not only that
    // somebody changed the row, but that it happened during this run.
    if (known && !known->holds(name, hash)) {
      const char* change = known->knows(name) ? "was changed while this run was at work"
                                              : "was not stored by this run";
      throw StoreProblem(fmt::format("{}: {} {}", database.file(), name, change),
                         ProblemKind::not_as_stored);
    }
    if (rows.text(count) != hash) {
      throw StoreProblem(
          fmt::format("{}: {} was changed after it was written", database.file(), name));
    }
    visit(row);
  }
}

bool put_row(const Database& database, const StoreTable& table, const Row& row,
             const char* on_conflict) {
  std::string places;
  for (std::size_t c = 0; c < row.size(); ++c) places += "?,";
  // A column has the type that its table declares.
  Statement insert(database, on_conflict ? fmt::format("INSERT INTO {} VALUES({}?) ON CONFLICT{}",
                                                       table.name, places, on_conflict)
                                         : fmt::format("INSERT OR REPLACE INTO {} VALUES({}?)",
                                                       table.name, places));
  for (const auto& column : row) insert.bind(column);
  insert.bind(row_hash(table, row)).next();
  return insert.changed_a_row();
}

void check_rows(const Database& database, const RowTally& known) {
  std::size_t count = 0;
  for (const auto* table : store_tables())
    for_each_row(database, *table, &known, "", {}, [&](const Row&) { ++count; });
  if (count == known.size()) return;
  // Keys are unique and every visited row is a known one, so if the numbers differ, some of the
  // known rows are missing.
  std::set<std::string> there;
  for (const auto* table : store_tables()) {
    for_each_row(database, *table, nullptr, "", {},
                 [&](const Row& row) { there.insert(row_name(*table, row)); });
  }
  known.for_each_name([&](const std::string& name) {
    if (there.contains(name)) return;
    throw StoreProblem(
        fmt::format("{}: {} was taken away while this run was at work", database.file(), name),
        ProblemKind::not_as_stored);
  });
}

void check_tables(const Database& database, bool may_lack) {
  std::set<std::string> expected, found;
  for (const auto* table : store_tables()) expected.insert(declaration_of(*table));
  {
    // An index that SQLite makes by itself has no SQL text, so it is left out.
    Statement texts(database, "SELECT sql FROM sqlite_master WHERE sql IS NOT NULL");
    while (texts.next()) found.insert(texts.text(0));
  }
  const bool are_ours =
      may_lack ? std::includes(expected.begin(), expected.end(), found.begin(), found.end())
               : found == expected;
  if (!are_ours)
    throw StoreProblem(
        fmt::format("{}: its tables are not those of the store of a run", database.file()));
}

}  // namespace assay::properties
