#include "properties/campaign/ledger/row.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

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

std::string table_declaration() {
  constexpr std::string_view create = "CREATE TABLE ";
  return fmt::format("CREATE TABLE IF NOT EXISTS {};", declaration.substr(create.size()));
}

void for_each_row(const Database& database, const std::string& more,
                  const std::vector<std::string_view>& bound,
                  const std::function<void(const Row&)>& visit) {
  Statement rows(database, "SELECT kind,key,progress,fields,hash FROM ledger " + more);
  for (const auto& text : bound) rows.bind(text);
  while (rows.next()) {
    const Row row{rows.text(0), rows.text(1), rows.number(2), rows.text(3)};
    if (rows.text(4) != row_hash(row)) {
      throw StoreProblem(
          fmt::format("{}: {} was changed after it was written", database.file(), row_name(row)));
    }
    visit(row);
  }
}

void put_row(const Database& database, const Row& row) {
  Statement insert(database, "INSERT OR REPLACE INTO ledger VALUES(?,?,?,?,?)");
  insert.bind(row.kind).bind(row.key).bind(row.progress).bind(row.fields).bind(row_hash(row));
  insert.next();
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
