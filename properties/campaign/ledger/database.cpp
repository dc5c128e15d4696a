#include "properties/campaign/ledger/database.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/file.h>

#include <cerrno>
#include <cstring>

#include "corpus/digest.h"
#include "properties/campaign/ledger/row_fields.h"
#include "properties/words.h"

namespace assay::properties {

Database::Database(const std::filesystem::path& file, Mode mode) {
  const int flags =
      mode == Mode::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* db = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &db, flags, nullptr);
  db_.reset(db, sqlite3_close);
  if (code != SQLITE_OK)
    throw StoreProblem(fmt::format("{}: {}", file.string(), db ? sqlite3_errmsg(db) : "no memory"));
  constexpr int patience_ms = 5000;
  sqlite3_busy_timeout(db, patience_ms);
}

std::string Database::file() const {
  const char* name = sqlite3_db_filename(handle(), "main");
  return name ? name : "store";
}

void Database::run(const std::string& sql) const {
  const int code = sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK)
    throw StoreProblem(fmt::format("{}: {}", file(), sqlite3_errmsg(handle())));
}

void Database::check_whole() const {
  Statement query(*this, "PRAGMA quick_check(1)");
  if (!query.next() || query.text(0) != "ok")
    throw StoreProblem(fmt::format("{}: the file is damaged", file()));
}

Statement::Statement(const Database& database, const std::string& sql) : database_(database) {
  check(sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &statement_, nullptr));
}

Statement::~Statement() { sqlite3_finalize(statement_); }

Statement& Statement::bind(std::string_view text) {
  check(sqlite3_bind_text(statement_, ++values_, text.data(), static_cast<int>(text.size()),
                          SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind(std::uint64_t number) {
  check(sqlite3_bind_int64(statement_, ++values_, static_cast<sqlite3_int64>(number)));
  return *this;
}

bool Statement::next() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) check(code);
  return false;
}

std::string Statement::text(int column) const {
  const auto* begin = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  if (!begin) return "";  // NULL
  return {begin, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::uint64_t Statement::number(int column) const {
  return static_cast<std::uint64_t>(sqlite3_column_int64(statement_, column));
}

void Statement::check(int code) const {
  if (code == SQLITE_OK) return;
  throw StoreProblem(fmt::format("{}: {}", database_.file(), sqlite3_errmsg(database_.handle())));
}

Descriptor lock_file(const std::filesystem::path& file, const std::string& if_busy) {
  Descriptor lock(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (lock < 0) throw StoreProblem(fmt::format("{}: {}", file.string(), std::strerror(errno)));
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0) throw StoreProblem(if_busy);
  return lock;
}

namespace {

using Json = nlohmann::json;

// The kinds of rows, and their fields that may differ between two runs of one campaign.
constexpr std::pair<std::string_view, const char*> passing_fields[] = {
    {trial_kind, "oracle_us"}, {trial_kind, "detector_us"}, {trial_kind, "slowest_us"},
    {trial_kind, "disturbed"}, {failure_kind, "smallest"},  {failure_kind, "smallest_explanation"},
    {failure_kind, "printed"}, {note_kind, "value"},
};

// With STRICT, a check of the whole file finds a text whose type has changed.
constexpr std::string_view declaration =
    "CREATE TABLE ledger(kind TEXT NOT NULL, key TEXT NOT NULL, progress INTEGER NOT NULL, fields "
    "TEXT NOT NULL, hash TEXT NOT NULL, PRIMARY KEY(kind, key)) STRICT, WITHOUT ROWID";

}  // namespace

Row lasting(Row row) {
  Json fields;
  for (const auto& [kind, name] : passing_fields) {
    if (kind != row.kind) continue;
    if (fields.is_null()) fields = fields_of(row);
    fields.erase(name);
  }
  if (!fields.is_null()) row.fields = corpus::json_text(fields);
  return row;
}

std::uint64_t number_of_text(const std::string& text) {
  const auto number = whole_number_of(text);
  if (!number) throw StoreProblem(fmt::format("'{}' is no number", text));
  return *number;
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
                  const std::vector<std::string_view>& values,
                  const std::function<void(const Row&)>& visit) {
  Statement rows(database, "SELECT kind,key,progress,fields,hash FROM ledger " + more);
  for (const auto& text : values) rows.bind(text);
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
        fmt::format("{}: not the store of a run: its tables differ", database.file()));
}

}  // namespace assay::properties
