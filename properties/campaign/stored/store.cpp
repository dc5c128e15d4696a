#include "properties/campaign/stored/store.h"

#include <fmt/format.h>

#include <system_error>

#include "corpus/cases/case_file.h"
#include "corpus/json_fields.h"
#include "properties/campaign/database/file_lock.h"
#include "properties/campaign/stored/binding.h"
#include "properties/campaign/stored/row_of.h"

namespace assay::properties {

std::string about_text(const std::string& signature, const std::string& explanation) {
  return signature + "; " + explanation;
}

std::string shown_explanation(const StoredFailure& failure) {
  if (failure.smallest.empty()) return failure.explanation;
  const auto smallest = corpus::parse_case(failure.smallest, "stored failure");
  const auto head = about_text(failure.signature, "");
  const bool tells = smallest && smallest.value().about.starts_with(head);
  return tells ? smallest.value().about.substr(head.size()) : failure.explanation;
}
namespace {

// The schema that a binding names, if it is not that of this build.
std::optional<std::string> other_schema(const std::string& binding) {
  const auto read = corpus::parse_json(binding, "binding");
  // If the text is no binding at all, whoever reads the binding reports that.
  if (!read || !read.value().is_object() || !read.value().contains("schema")) return std::nullopt;
  const auto& schema = read.value()["schema"];
  return schema == store_schema ? std::nullopt : std::optional(corpus::json_text(schema));
}

StoreProblem refused_schema(const std::filesystem::path& file, const std::string& schema) {
  return StoreProblem(fmt::format("{}: is of schema {}, this assay reads {}: run it again",
                                  file.string(), schema, store_schema));
}

FileLock lock_of_store(const std::filesystem::path& file) {
  return {file.string() + ".lock", FileLock::On::file,
          fmt::format("{}: another run is writing it", file.string())};
}

// Reads the binding without a check of its hash, because a store of an older schema has no hashes.
std::optional<std::string> unchecked_binding(const Database& db) {
  if (!Statement(db, "SELECT 1 FROM sqlite_master WHERE name='note'").next()) return std::nullopt;
  Statement query(db, "SELECT value FROM note WHERE key='binding'");
  return query.next() ? std::optional(query.text(0)) : std::nullopt;
}

}  // namespace

struct Store::Parts {
  std::optional<FileLock> lock;  // declared first, so that it outlives the database
  Database db;
  std::optional<RowTally> known;  // only of a store that is open for writing

  Parts(const std::filesystem::path& file, Database::Mode mode)
      : lock(mode == Database::Mode::write ? std::optional(lock_of_store(file)) : std::nullopt),
        db(file, mode) {}

  // Looks at every row and notes it as known.
  void get_to_know() {
    RowTally found;
    for (const auto* table : store_tables()) {
      for_each_row(db, *table, nullptr, "", {}, [&](const Row& row) {
        found.put(row_name(*table, row), row_hash(*table, row));
      });
    }
    known = std::move(found);
  }

  void for_each(const StoreTable& table, const std::string& more,
                const std::vector<std::string>& bound,
                const std::function<void(const Row&)>& visit) const {
    for_each_row(db, table, known ? &*known : nullptr, more, bound, visit);
  }

  // A row that is put counts as known from note() on, which is called only after its transaction
  // went through.
  void note(const StoreTable& table, const Row& row) {
    if (known) known->put(row_name(table, row), row_hash(table, row));
  }
  void put(const StoreTable& table, const Row& row) {
    put_row(db, table, row);
    note(table, row);
  }

  void remove(const StoreTable& table, const Row& row) {
    std::string where;
    for (std::size_t c = 0; c < table.key_columns; ++c)
      where += fmt::format("{}{}=?", c > 0 ? " AND " : "", table.columns[c].name);
    Statement query(db, fmt::format("DELETE FROM {} WHERE {}", table.name, where));
    for (std::size_t c = 0; c < table.key_columns; ++c) query.bind(row[c]);
    query.next();
    if (known) known->drop(row_name(table, row));
  }
};

Store::Store(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Expected<Store> Store::read(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    return Problem{fmt::format("{}: no such file", file.string())};
  return catch_store_problem([&] {
    auto parts = std::make_unique<Parts>(file, Database::Mode::read);
    // The transaction shows one state of the file until the store is closed.
    parts->db.run("BEGIN");
    const auto binding = unchecked_binding(parts->db);
    if (!binding) {
      throw StoreProblem(fmt::format("{}: not the store of a run", file.string()));
    }
    if (const auto older = other_schema(*binding)) throw refused_schema(file, *older);
    parts->db.check_whole();
    check_tables(parts->db, false);
    return Store(std::move(parts));
  });
}

Expected<Store> Store::open(const std::filesystem::path& file, const std::string& binding) {
  return catch_store_problem([&] {
    auto parts = std::make_unique<Parts>(file, Database::Mode::write);
    // With these settings a killed process loses nothing that add() returned from. Only a power
    // cut may lose the end.
    parts->db.run("PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;");
    parts->db.check_whole();
    const auto bound = unchecked_binding(parts->db);
    if (bound && *bound != binding) {
      if (const auto older = other_schema(*bound)) throw refused_schema(file, *older);
      throw StoreProblem(fmt::format("{}: holds another run: {}; give another folder",
                                     file.string(), difference_of(*bound, binding)));
    }
    check_tables(parts->db, true);
    parts->db.run(table_declarations());
    parts->get_to_know();
    Store store(std::move(parts));
    if (!bound) store.set_note("binding", binding);
    return store;
  });
}

Expected<KeptFailures> Store::kept_failures() const {
  return catch_store_problem([&] { return KeptFailures{failures(), signatures()}; });
}

Expected<KeptFailures> read_failures(const std::filesystem::path& file) {
  const auto store = Store::read(file);
  if (!store) return store.error();
  return store.value().kept_failures();
}

const RowTally& Store::known_rows() const { return *parts_->known; }

Expected<void> Store::check_against(const RowTally& known) const {
  return catch_store_problem([&] { check_rows(parts_->db, known); });
}

std::string Store::binding() const { return note("binding").value_or(""); }

void Store::add(const TrialRecord& record) { parts_->put(trial_table(), row_of(record)); }

void Store::add(const TrialRecord& record, const std::vector<StoredFailure>& kept,
                const std::vector<MetFailure>& met) {
  std::vector<std::pair<const StoreTable*, Row>> rows;
  for (const auto& failure : kept) rows.emplace_back(&failure_table(), row_of(failure));
  for (const auto& failure : met) {
    rows.emplace_back(&met_table(), Row{record.id, failure.configuration, failure.signature});
  }
  rows.emplace_back(&trial_table(), row_of(record));
  parts_->db.run("BEGIN IMMEDIATE");
  try {
    for (const auto& [table, row] : rows) put_row(parts_->db, *table, row);
    parts_->db.run("COMMIT");
  } catch (const StoreProblem&) {
    try {
      parts_->db.run("ROLLBACK");
    } catch (const StoreProblem&) {
      // SQLite has already rolled back by itself.
    }
    throw;
  }
  for (const auto& [table, row] : rows) parts_->note(*table, row);
}

void Store::add(const StoredFailure& failure) { parts_->put(failure_table(), row_of(failure)); }

void Store::keep_failures(const std::set<std::string>& signatures) {
  for (const auto& failure : failures()) {
    if (!signatures.contains(failure.signature)) parts_->remove(failure_table(), row_of(failure));
  }
}

void Store::set_smallest(const StoredFailure& failure) {
  bool is_there = false;
  parts_->for_each(failure_table(), "WHERE id=? AND configuration=?",
                   {failure.id, failure.configuration}, [&](const Row&) { is_there = true; });
  if (is_there) add(failure);
}

void Store::set_note(const std::string& key, const std::string& value) {
  parts_->put(note_table(), {key, value});
}

bool Store::has_trial(const std::string& id) const {
  return Statement(parts_->db, "SELECT 1 FROM trial WHERE id=?").bind(id).next();
}

std::uint64_t Store::trial_count() const {
  Statement query(parts_->db, "SELECT count(*) FROM trial");
  return query.next() ? query.number(0) : 0;
}

std::optional<std::string> Store::note(const std::string& key) const {
  std::optional<std::string> value;
  parts_->for_each(note_table(), "WHERE key=?", {key}, [&](const Row& row) { value = row[1]; });
  return value;
}

void Store::for_each_trial(const std::function<void(const TrialRecord&)>& visit) const {
  parts_->for_each(trial_table(), "ORDER BY family, place", {},
                   [&](const Row& row) { visit(trial_of(row)); });
}

std::vector<StoredFailure> Store::failures() const {
  std::vector<StoredFailure> list;
  parts_->for_each(failure_table(), "ORDER BY signature, id, configuration", {},
                   [&](const Row& row) { list.push_back(failure_of(row)); });
  return list;
}

Counts Store::signatures() const {
  Counts counts;
  parts_->for_each(met_table(), "", {}, [&](const Row& row) { ++counts[row[2]]; });
  return counts;
}

void Store::set(const Evidence& evidence) {
  bool is_behind = false;
  parts_->for_each(evidence_table(), "WHERE kind=? AND name=? AND shard=?",
                   {evidence.kind, evidence.name, evidence.shard}, [&](const Row& row) {
                     is_behind = evidence_of(row).progress > evidence.progress;
                   });
  if (!is_behind) parts_->put(evidence_table(), row_of(evidence));
}

void Store::drop_evidence(const std::string& kind) {
  std::vector<Row> rows;
  parts_->for_each(evidence_table(), "WHERE kind=?", {kind},
                   [&](const Row& row) { rows.push_back(row); });
  for (const auto& row : rows) parts_->remove(evidence_table(), row);
}

std::vector<Evidence> Store::evidence() const {
  std::vector<Evidence> list;
  parts_->for_each(evidence_table(), "ORDER BY kind, name, shard", {},
                   [&](const Row& row) { list.push_back(evidence_of(row)); });
  return list;
}

Expected<void> Store::seal() {
  return catch_store_problem([&] { parts_->db.run("PRAGMA journal_mode=DELETE"); });
}

}  // namespace assay::properties
