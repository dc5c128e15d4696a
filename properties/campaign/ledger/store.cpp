#include "properties/campaign/ledger/store.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <system_error>
#include <tuple>

#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/row_fields.h"
#include "properties/worker/plugin/judged_library.h"

namespace assay::properties {
namespace {

// Returns the schema that a binding names, if it is not that of this build.
std::optional<std::string> other_schema(const std::string& binding) {
  const auto json = corpus::parse_json(binding, "binding");
  // If the text is no binding at all, whoever reads the binding reports that.
  if (!json || !json.value().is_object() || !json.value().contains("schema")) return std::nullopt;
  const auto& schema = json.value()["schema"];
  return schema == store_schema ? std::nullopt : std::optional(corpus::json_text(schema));
}

StoreProblem refused_schema(const std::filesystem::path& file, const std::string& schema) {
  return StoreProblem(fmt::format("{}: is of schema {}, this program reads {}: repeat the run",
                                  file.string(), schema, store_schema));
}

// Reads the binding without a check of its hash, because a store of an older schema has other
// tables: up to assay-store/5 the binding was a note.
std::optional<std::string> unchecked_binding(const Database& db) {
  const auto first = [&](const char* table, const std::string& sql) -> std::optional<std::string> {
    if (!Statement(db, "SELECT 1 FROM sqlite_master WHERE name=?").bind(table).next())
      return std::nullopt;
    Statement query(db, sql);
    return query.next() ? std::optional(query.text(0)) : std::nullopt;
  };
  const auto binding =
      first("ledger", fmt::format("SELECT fields FROM ledger WHERE kind='{}'", binding_kind));
  return binding ? binding : first("note", "SELECT value FROM note WHERE key='binding'");
}

// The end of a key is a number. If two keys differ in this number alone, the shorter key comes
// first.
constexpr const char* order_of_keys = "ORDER BY rtrim(key, '0123456789'), length(key), key";

std::optional<Row> find(const Database& db, std::string_view kind, std::string_view key) {
  std::optional<Row> first;
  for_each_row(db, "WHERE kind=? AND key=?", {kind, key}, [&](const Row& row) { first = row; });
  return first;
}

void remove(const Database& db, const Row& row) {
  Statement(db, "DELETE FROM ledger WHERE kind=? AND key=?").bind(row.kind).bind(row.key).next();
}

}  // namespace

Expected<Store> Store::read(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    return Problem{fmt::format("{}: no such file", file.string())};
  return catch_store_problem([&] {
    Store store(Descriptor(), Database(file, Database::Mode::read));
    // The transaction shows one state of the file until the store is closed.
    store.db_.run("BEGIN");
    const auto binding = unchecked_binding(store.db_);
    if (!binding) {
      throw StoreProblem(fmt::format("{}: not the store of a run", file.string()));
    }
    if (const auto older = other_schema(*binding)) throw refused_schema(file, *older);
    store.db_.check_whole();
    check_tables(store.db_, false);
    return store;
  });
}

Expected<Store> Store::open(const std::filesystem::path& file, const std::string& binding) {
  return catch_store_problem([&] {
    Descriptor lock =
        lock_file(file.string() + ".lock", file.string() + ": another process writes this file");
    Store store(std::move(lock), Database(file, Database::Mode::write));
    // With these settings a killed process loses nothing that add() returned from. Only a power
    // cut may lose the end.
    store.db_.run("PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;");
    store.db_.check_whole();
    const auto text = unchecked_binding(store.db_);
    if (text && *text != binding) {
      if (const auto older = other_schema(*text)) throw refused_schema(file, *older);
      throw StoreProblem(fmt::format("{}: holds another run: {}; go on in a new folder: --out NEW",
                                     file.string(), difference_of(*text, binding)));
    }
    check_tables(store.db_, true);
    store.db_.run(table_declaration());
    for_each_row(store.db_, "", {}, [](const Row&) {});
    if (!text) put_row(store.db_, {std::string(binding_kind), "", 0, binding});
    return store;
  });
}

Expected<FailureList> Store::kept_failures() const {
  return catch_store_problem([&] { return FailureList{failures(), signatures()}; });
}

Expected<void> copy_store(const std::filesystem::path& from, const std::filesystem::path& to) {
  return catch_store_problem([&] {
    value_or_throw(Store::read(from));
    const std::filesystem::path part = to.string() + ".part";
    std::error_code error;
    std::filesystem::remove(part, error);
    // The bytes of a vacuumed file depend on its rows alone.
    Statement(Database(from, Database::Mode::read), "VACUUM INTO ?").bind(part.string()).next();
    std::filesystem::rename(part, to, error);
    if (error)
      throw StoreProblem(fmt::format("{}: cannot be written: {}", to.string(), error.message()));
  });
}

std::string Store::binding() const {
  const auto row = find(db_, binding_kind, "");
  return row ? row->fields : "";
}

void Store::set(const Row& row) {
  const auto before = find(db_, row.kind, row.key);
  if (!before || before->progress <= row.progress) put_row(db_, row);
}

void Store::drop(std::string_view kind) {
  std::vector<Row> rows;
  for_each(kind, [&](const Row& row) { rows.push_back(row); });
  for (const auto& row : rows) remove(db_, row);
}

void Store::add(const TrialRecord& record, const std::vector<FailureRecord>& failures) {
  std::vector<Row> rows = {to_row(record)};
  for (const auto& failure : failures) {
    rows.push_back(met_row(failure));
    if (!failure.mesh.empty()) rows.push_back(to_row(failure));
  }
  db_.run("BEGIN IMMEDIATE");
  try {
    for (const auto& row : rows) put_row(db_, row);
    db_.run("COMMIT");
  } catch (const StoreProblem&) {
    try {
      db_.run("ROLLBACK");
    } catch (const StoreProblem&) {
      // SQLite has already rolled back by itself.
    }
    throw;
  }
}

void Store::keep_corpus_failures(const std::set<std::string>& signatures) {
  for (const auto& failure : failures()) {
    if (failure.is_of_corpus() && !signatures.contains(failure.signature()))
      remove(db_, to_row(failure));
  }
}

void Store::set_smallest(const FailureRecord& failure) {
  const Row row = to_row(failure);
  if (find(db_, row.kind, row.key)) put_row(db_, row);
}

void Store::set_note(const std::string& key, const std::string& value) {
  put_row(db_,
          {std::string(note_kind), key, 0, corpus::json_text(nlohmann::json{{"value", value}})});
}

void Store::for_each(std::string_view kind, const std::function<void(const Row&)>& visit) const {
  for_each_row(db_, fmt::format("WHERE kind=? {}", order_of_keys), {kind}, visit);
}

void Store::for_each_trial(const std::function<void(const TrialRecord&)>& visit) const {
  for_each(trial_kind, [&](const Row& row) { visit(trial_of(row)); });
}

bool Store::has_trial(const std::string& id) const {
  return Statement(db_, "SELECT 1 FROM ledger WHERE kind=? AND key=?")
      .bind(trial_kind)
      .bind(id)
      .next();
}

std::uint64_t Store::trial_count() const {
  Statement query(db_, "SELECT count(*) FROM ledger WHERE kind=?");
  return query.bind(trial_kind).next() ? query.number(0) : 0;
}

std::vector<FailureRecord> Store::failures() const {
  std::vector<FailureRecord> list;
  for_each(failure_kind, [&](const Row& row) { list.push_back(failure_of(row)); });
  std::ranges::sort(list, [](const FailureRecord& a, const FailureRecord& b) {
    const auto key = [](const FailureRecord& f) {
      return std::tuple(f.signature(), f.id(), f.shown_configuration());
    };
    return key(a) < key(b);
  });
  return list;
}

Counts Store::signatures() const {
  Counts counts;
  for_each(met_kind, [&](const Row& row) { ++counts[text_in(row, "signature")]; });
  return counts;
}

std::optional<std::string> Store::note(const std::string& key) const {
  const auto row = find(db_, note_kind, key);
  return row ? std::optional(text_in(*row, "value")) : std::nullopt;
}

std::vector<Row> Store::evidence() const {
  std::vector<Row> list;
  for_each_row(db_, "WHERE kind NOT IN (?,?,?,?,?)",
               {binding_kind, note_kind, trial_kind, failure_kind, met_kind},
               [&](const Row& row) { list.push_back(row); });
  return list;
}

Expected<void> Store::seal() {
  return catch_store_problem([&] { db_.run("PRAGMA journal_mode=DELETE"); });
}

std::filesystem::path copied_store_file(const std::filesystem::path& out, std::uint64_t seed) {
  return out / fmt::format("seed-{}.sqlite", seed);
}

Expected<std::vector<std::filesystem::path>> stored_runs(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> stores;
  for (const auto& file : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = file.path().filename().string();
    const bool is_copy = name.starts_with("seed-") && name.ends_with(".sqlite");
    if (is_copy || name == store_file("")) stores.push_back(file.path());
  }
  if (error) return Problem{fmt::format("{}: {}", folder.string(), error.message())};
  if (stores.empty()) return Problem{fmt::format("{}: no run is stored here", folder.string())};
  std::ranges::sort(stores);
  return stores;
}

Expected<void> expect_no_other_store(const std::filesystem::path& folder,
                                     const std::set<std::filesystem::path>& outputs) {
  const auto there = stored_runs(folder);
  if (!there) return boost::outcome_v2::success();
  for (const auto& file : there.value()) {
    if (!outputs.contains(file))
      return Problem{
          fmt::format("{}: belongs to another run; name a new folder: --out NEW", file.string())};
  }
  return boost::outcome_v2::success();
}

void note_library(Store& store, const std::filesystem::path& library) {
  std::error_code error;
  const auto path = std::filesystem::absolute(library, error);
  store.set_note(library_note, (error || names_python(library.string()) ? library : path).string());
}

std::string time_in_utc() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

void note_begin(Store& store) {
  if (!store.note(begin_note)) store.set_note(begin_note, time_in_utc());
}

std::filesystem::path failure_file(const FailureRecord& failure, bool smallest) {
  std::string stem = fmt::format("{}-{}", failure.id(), failure.shown_configuration());
  std::erase(stem, ',');
  for (char& c : stem) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
    if (!is_plain) c = '-';
  }
  return std::filesystem::path("failures") /
         (stem + (smallest ? "-smallest.json" : "-original.json"));
}

}  // namespace assay::properties
