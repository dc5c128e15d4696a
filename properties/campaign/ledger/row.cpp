#include "properties/campaign/ledger/row.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "corpus/digest.h"
#include "properties/campaign/ledger/row_fields.h"

namespace assay::properties {
namespace {

using Json = nlohmann::json;

// A field that may differ between two runs of one campaign.
struct PassingField {
  std::string_view kind;
  const char* name;
};
constexpr PassingField passing_fields[] = {
    {trial_kind, "oracle_us"}, {trial_kind, "detector_us"}, {trial_kind, "slowest_us"},
    {trial_kind, "disturbed"}, {failure_kind, "smallest"},  {failure_kind, "printed"},
    {note_kind, "value"},
};

// STRICT lets a look at the whole file see a text that became something else.
constexpr std::string_view declaration =
    "CREATE TABLE ledger(kind TEXT NOT NULL, key TEXT NOT NULL, progress INTEGER NOT NULL, fields "
    "TEXT NOT NULL, hash TEXT NOT NULL, PRIMARY KEY(kind, key)) STRICT, WITHOUT ROWID";

}  // namespace

Row lasting(Row row) {
  Json fields;
  for (const auto& passing : passing_fields) {
    if (passing.kind != row.kind) continue;
    if (fields.is_null()) fields = fields_of(row);
    fields.erase(passing.name);
  }
  if (!fields.is_null()) row.fields = corpus::json_text(fields);
  return row;
}

std::uint64_t number_of_text(const std::string& text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    throw StoreProblem(fmt::format("'{}' stands where a number belongs", text));
  return number;
}

std::string row_hash(const Row& row) {
  std::string bytes;
  const auto add = [&](const std::string& column) {
    bytes += fmt::format("{}:", column.size());
    bytes += column;
  };
  add(row.kind);
  add(row.key);
  add(std::to_string(row.progress));
  add(row.fields);
  return corpus::sha256_of(bytes);
}

std::string row_name(const Row& row) {
  std::string name = row.kind;
  if (!row.key.empty()) name += " " + row.key;
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

std::string table_declaration() {
  constexpr std::string_view create = "CREATE TABLE ";
  return fmt::format("CREATE TABLE IF NOT EXISTS {};", declaration.substr(create.size()));
}

void for_each_row(const Database& database, const RowTally* known, const std::string& more,
                  const std::vector<std::string_view>& bound,
                  const std::function<void(const Row&)>& visit) {
  Statement rows(database, "SELECT kind,key,progress,fields,hash FROM ledger " + more);
  for (const auto& text : bound) rows.bind(text);
  while (rows.next()) {
    const Row row{rows.text(0), rows.text(1), rows.number(2), rows.text(3)};
    const auto hash = row_hash(row), name = row_name(row);
    // This is reported before a hash that does not fit, because it says more: not only that
    // somebody changed the row, but that it happened during this run.
    if (known && !known->holds(name, hash)) {
      const char* change = known->knows(name) ? "was changed while this run was at work"
                                              : "was not stored by this run";
      throw StoreProblem(fmt::format("{}: {} {}", database.file(), name, change),
                         ProblemKind::not_as_stored);
    }
    if (rows.text(4) != hash) {
      throw StoreProblem(
          fmt::format("{}: {} was changed after it was written", database.file(), name));
    }
    visit(row);
  }
}

void put_row(const Database& database, const Row& row) {
  Statement insert(database, "INSERT OR REPLACE INTO ledger VALUES(?,?,?,?,?)");
  insert.bind(row.kind).bind(row.key).bind(row.progress).bind(row.fields).bind(row_hash(row));
  insert.next();
}

void check_rows(const Database& database, const RowTally& known) {
  std::size_t count = 0;
  for_each_row(database, &known, "", {}, [&](const Row&) { ++count; });
  if (count == known.size()) return;
  // Keys are unique and every visited row is a known one, so if the numbers differ, some of the
  // known rows are missing.
  std::set<std::string> there;
  for_each_row(database, nullptr, "", {}, [&](const Row& row) { there.insert(row_name(row)); });
  known.for_each_name([&](const std::string& name) {
    if (there.contains(name)) return;
    throw StoreProblem(
        fmt::format("{}: {} was taken away while this run was at work", database.file(), name),
        ProblemKind::not_as_stored);
  });
}

void check_tables(const Database& database, bool may_lack) {
  // An index that SQLite makes by itself has no SQL text, so it is left out.
  Statement texts(database, "SELECT sql FROM sqlite_master WHERE sql IS NOT NULL");
  const bool has_table = texts.next();
  const bool are_ours = has_table ? texts.text(0) == declaration && !texts.next() : may_lack;
  if (!are_ours)
    throw StoreProblem(
        fmt::format("{}: its tables are not those of the store of a run", database.file()));
}

}  // namespace assay::properties
