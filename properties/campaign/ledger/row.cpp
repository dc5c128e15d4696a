#include "properties/campaign/ledger/row.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "corpus/digest.h"
#include "properties/campaign/ledger/row_fields.h"

namespace assay::properties {
namespace {

using Json = nlohmann::json;

// A field that may differ between two runs of one campaign, and which of two values stays. Of two
// texts of equal length the lesser one counts as shorter, and an empty one as longer than any.
enum class Stays : std::uint8_t { least, most, shortest };
struct PassingField {
  std::string_view kind;
  const char* name;
  Stays stays;
};
constexpr PassingField passing_fields[] = {
    {trial_kind, "oracle_us", Stays::least},     {trial_kind, "detector_us", Stays::least},
    {trial_kind, "slowest_us", Stays::least},    {trial_kind, "disturbed", Stays::most},
    {failure_kind, "smallest", Stays::shortest}, {failure_kind, "printed", Stays::most},
    {note_kind, "value", Stays::least},
};

const Json& that_stays(const Json& a, const Json& b, Stays stays) {
  if (stays == Stays::least) return std::min(a, b);
  if (stays == Stays::most) return std::max(a, b);
  const auto &one = a.get_ref<const std::string&>(), &other = b.get_ref<const std::string&>();
  const auto rank = [](const std::string& text) { return std::tuple(text.empty(), text.size()); };
  return std::tuple(rank(one), one) <= std::tuple(rank(other), other) ? a : b;
}

// STRICT lets a look at the whole file see a text that became something else.
constexpr std::string_view declaration =
    "CREATE TABLE ledger(kind TEXT NOT NULL, key TEXT NOT NULL, shard TEXT NOT NULL, progress "
    "INTEGER NOT NULL, fields TEXT NOT NULL, hash TEXT NOT NULL, PRIMARY KEY(kind, key, shard)) "
    "STRICT, WITHOUT ROWID";

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

std::optional<Row> joined(const Row& a, const Row& b) try {
  if (a == b) return a;
  if (a.progress != b.progress) return a.progress > b.progress ? a : b;
  Json one = fields_of(a), other = fields_of(b);
  for (const auto& [kind, name, stays] : passing_fields) {
    if (kind != a.kind) continue;
    // A number that is not there is 0, and null is less than any number.
    const Json value = that_stays(one[name], other[name], stays);
    for (auto* fields : {&one, &other}) {
      if (value.is_null()) {
        fields->erase(name);
      } else {
        (*fields)[name] = value;
      }
    }
  }
  if (one != other) return std::nullopt;
  return Row{a.kind, a.key, a.shard, a.progress, corpus::json_text(one)};
} catch (const Json::exception& wrong) {
  throw_not_stored(a, wrong);
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
  add(row.shard);
  add(std::to_string(row.progress));
  add(row.fields);
  return corpus::sha256_of(bytes);
}

std::string row_name(const Row& row) {
  std::string name = row.kind;
  if (!row.key.empty()) name += " " + row.key;
  if (!row.shard.empty()) name += ", " + row.shard;
  return name;
}

std::string table_declaration() {
  constexpr std::string_view create = "CREATE TABLE ";
  return fmt::format("CREATE TABLE IF NOT EXISTS {};", declaration.substr(create.size()));
}

void for_each_row(const Database& database, const std::string& more,
                  const std::vector<std::string_view>& bound,
                  const std::function<void(const Row&)>& visit) {
  Statement rows(database, "SELECT kind,key,shard,progress,fields,hash FROM ledger " + more);
  for (const auto& text : bound) rows.bind(text);
  while (rows.next()) {
    const Row row{rows.text(0), rows.text(1), rows.text(2), rows.number(3), rows.text(4)};
    if (rows.text(5) != row_hash(row)) {
      throw StoreProblem(
          fmt::format("{}: {} was changed after it was written", database.file(), row_name(row)));
    }
    visit(row);
  }
}

bool put_row(const Database& database, const Row& row, Put put) {
  Statement insert(database, fmt::format("INSERT OR {} INTO ledger VALUES(?,?,?,?,?,?)",
                                         put == Put::always ? "REPLACE" : "IGNORE"));
  insert.bind(row.kind).bind(row.key).bind(row.shard).bind(row.progress).bind(row.fields);
  insert.bind(row_hash(row)).next();
  return insert.changed_a_row();
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
