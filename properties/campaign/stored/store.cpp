#include "properties/campaign/stored/store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <system_error>

namespace assay::properties {
// Without row numbers: what a merged file holds then depends on its rows alone.
const char* Store::tables() {
  return "CREATE TABLE IF NOT EXISTS note(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
         "CREATE TABLE IF NOT EXISTS trial(id TEXT PRIMARY KEY, family TEXT NOT NULL, place "
         "INTEGER NOT NULL, outcomes TEXT NOT NULL, triangles INTEGER NOT NULL, steps INTEGER NOT "
         "NULL, "
         "collisions INTEGER NOT NULL, pairs INTEGER NOT NULL, oracle_us INTEGER NOT NULL, "
         "detector_us INTEGER NOT NULL, counts TEXT NOT NULL, mesh INTEGER NOT NULL, disturbed "
         "INTEGER "
         "NOT NULL, slowest_us INTEGER NOT NULL) WITHOUT ROWID;"
         "CREATE TABLE IF NOT EXISTS failure(id TEXT NOT NULL, configuration TEXT NOT NULL, "
         "signature TEXT NOT NULL, what TEXT NOT NULL, mesh TEXT NOT NULL, smallest TEXT NOT NULL, "
         "flaky INTEGER NOT NULL, PRIMARY KEY(id, configuration)) WITHOUT ROWID;"
         "CREATE TABLE IF NOT EXISTS met(id TEXT NOT NULL, configuration TEXT NOT NULL, signature "
         "TEXT NOT NULL, PRIMARY KEY(id, configuration)) WITHOUT ROWID;"
         "CREATE TABLE IF NOT EXISTS evidence(kind TEXT NOT NULL, name TEXT NOT NULL, shard TEXT "
         "NOT NULL, progress INTEGER NOT NULL, facts TEXT NOT NULL, PRIMARY KEY(kind, name, "
         "shard)) "
         "WITHOUT ROWID;";
}

// Held until this process ends, however it ends.
class StoreLock {
 public:
  explicit StoreLock(const std::filesystem::path& file) {
    const std::string name = file.string() + ".lock";
    lock_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0) {
      throw StoreProblem(ProblemKind::cannot_write,
                         fmt::format("{}: {}", name, std::strerror(errno)));
    }
    if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
    ::close(lock_);
    throw StoreProblem(ProblemKind::busy,
                       fmt::format("{}: another run is writing it", file.string()));
  }
  StoreLock(const StoreLock&) = delete;
  StoreLock& operator=(const StoreLock&) = delete;
  ~StoreLock() { ::close(lock_); }

 private:
  int lock_ = -1;
};

// The schema that a binding names, where it is another than this build's.
static std::optional<std::string> other_schema(const std::string& binding) {
  const auto json = nlohmann::json::parse(binding, nullptr, false);
  if (!json.is_object() || !json.contains("schema")) return std::nullopt;  // told by its reader
  if (json["schema"] == store_schema) return std::nullopt;
  return json["schema"].dump();
}

struct Store::Parts {
  std::optional<StoreLock> lock;  // outlives the database
  Database db;

  Parts(const std::filesystem::path& file, Database::Mode mode)
      : lock(mode == Database::Mode::write ? std::optional<StoreLock>(std::in_place, file)
                                           : std::nullopt),
        db(file, mode) {}
};

Store::Store(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Expected<Store> Store::read(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    return Problem{ProblemKind::not_found, fmt::format("{}: no such file", file.string())};
  return catch_store_problem([&] {
    auto parts = std::make_unique<Parts>(file, Database::Mode::read);
    const bool is_store =
        Statement(parts->db, "SELECT 1 FROM sqlite_master WHERE name='note'").next();
    Store store(std::move(parts));
    const auto binding = is_store ? store.note("binding") : std::nullopt;
    if (!binding) {
      throw StoreProblem(ProblemKind::foreign_file,
                         fmt::format("{}: not the store of a run", file.string()));
    }
    if (const auto older = other_schema(*binding)) {
      throw StoreProblem(ProblemKind::other_schema,
                         fmt::format("{}: is of schema {}, this assay reads {}: run it again",
                                     file.string(), *older, store_schema));
    }
    return store;
  });
}

Expected<Store> Store::open(const std::filesystem::path& file, const std::string& binding) {
  return catch_store_problem([&] {
    auto parts = std::make_unique<Parts>(file, Database::Mode::write);
    // A killed process loses nothing that add() returned from; only a power cut may lose the end.
    parts->db.run("PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;");
    parts->db.check_whole();
    parts->db.run(tables());
    Store store(std::move(parts));
    const auto bound = store.note("binding");
    if (!bound) {
      store.set_note("binding", binding);
    } else if (*bound != binding) {
      throw StoreProblem(
          ProblemKind::another_run,
          fmt::format("{}: holds another run (of another plan, seed, shard, detector or build)",
                      file.string()));
    }
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

std::string Store::binding() const { return note("binding").value_or(""); }

void Store::add(const TrialRecord& r) {
  Statement(parts_->db, "INSERT OR REPLACE INTO trial VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
      .bind(r.id)
      .bind(r.family)
      .bind(r.index)
      .bind(r.outcomes)
      .bind(r.triangles)
      .bind(r.steps)
      .bind(r.collisions)
      .bind(r.pairs)
      .bind(r.oracle_us)
      .bind(r.detector_us)
      .bind(counts_text(r.counts))
      .bind(r.mesh)
      .bind(r.disturbed)
      .bind(r.slowest_us)
      .next();
}

void Store::add(const TrialRecord& record, const std::vector<StoredFailure>& kept,
                const std::vector<MetFailure>& met) {
  parts_->db.run("BEGIN IMMEDIATE");
  try {
    for (const auto& failure : kept) add(failure);
    for (const auto& failure : met) {
      Statement(parts_->db, "INSERT OR REPLACE INTO met VALUES(?,?,?)")
          .bind(record.id)
          .bind(failure.configuration)
          .bind(failure.signature)
          .next();
    }
    add(record);
    parts_->db.run("COMMIT");
  } catch (const StoreProblem&) {
    try {
      parts_->db.run("ROLLBACK");
    } catch (const StoreProblem&) {
      // SQLite has rolled back by itself.
    }
    throw;
  }
}

void Store::add(const StoredFailure& f) {
  Statement(parts_->db, "INSERT OR REPLACE INTO failure VALUES(?,?,?,?,?,?,?)")
      .bind(f.id)
      .bind(f.configuration)
      .bind(f.signature)
      .bind(f.what)
      .bind(f.mesh)
      .bind(f.smallest)
      .bind(std::uint64_t{f.flaky})
      .next();
}

void Store::keep_failures(const std::set<std::string>& signatures) {
  for (const auto& failure : failures()) {
    if (signatures.contains(failure.signature)) continue;
    Statement(parts_->db, "DELETE FROM failure WHERE id=? AND configuration=?")
        .bind(failure.id)
        .bind(failure.configuration)
        .next();
  }
}

void Store::set_smallest(const StoredFailure& f) {
  Statement(parts_->db, "UPDATE failure SET smallest=? WHERE id=? AND configuration=?")
      .bind(f.smallest)
      .bind(f.id)
      .bind(f.configuration)
      .next();
}

void Store::set_note(const std::string& key, const std::string& value) {
  Statement(parts_->db, "INSERT OR REPLACE INTO note VALUES(?,?)").bind(key).bind(value).next();
}

bool Store::has_trial(const std::string& id) const {
  return Statement(parts_->db, "SELECT 1 FROM trial WHERE id=?").bind(id).next();
}

std::uint64_t Store::trial_count() const {
  Statement query(parts_->db, "SELECT count(*) FROM trial");
  return query.next() ? query.number(0) : 0;
}

std::optional<std::string> Store::note(const std::string& key) const {
  Statement query(parts_->db, "SELECT value FROM note WHERE key=?");
  query.bind(key);
  return query.next() ? std::optional(query.text(0)) : std::nullopt;
}

void Store::for_each_trial(const std::function<void(const TrialRecord&)>& visit) const {
  Statement query(parts_->db,
                  "SELECT id,family,place,outcomes,triangles,steps,collisions,pairs,oracle_us,"
                  "detector_us,counts,mesh,disturbed,slowest_us FROM trial ORDER BY family, place");
  while (query.next()) {
    visit({query.text(0), query.text(1), query.number(2), query.text(3), query.number(4),
           query.number(5), query.number(6), query.number(7), query.number(8), query.number(9),
           parse_counts(query.text(10)), query.number(11), query.number(12), query.number(13)});
  }
}

std::vector<StoredFailure> Store::failures() const {
  std::vector<StoredFailure> list;
  Statement query(
      parts_->db,
      "SELECT id,configuration,signature,what,mesh,smallest,flaky FROM failure ORDER BY "
      "signature,id,configuration");
  while (query.next()) {
    list.push_back({query.text(0), query.text(1), query.text(2), query.text(3), query.text(4),
                    query.text(5), query.number(6) != 0});
  }
  return list;
}

Counts Store::signatures() const {
  Counts counts;
  Statement query(parts_->db, "SELECT signature,count(*) FROM met GROUP BY signature");
  while (query.next()) counts[query.text(0)] = query.number(1);
  return counts;
}

void Store::set(const Evidence& e) {
  Statement(parts_->db,
            "INSERT INTO evidence VALUES(?,?,?,?,?) ON CONFLICT(kind,name,shard) DO UPDATE SET "
            "progress=excluded.progress, facts=excluded.facts WHERE excluded.progress>=progress")
      .bind(e.kind)
      .bind(e.name)
      .bind(e.shard)
      .bind(e.progress)
      .bind(e.facts)
      .next();
}

void Store::drop_evidence(const std::string& kind) {
  Statement(parts_->db, "DELETE FROM evidence WHERE kind=?").bind(kind).next();
}

std::vector<Evidence> Store::evidence() const {
  std::vector<Evidence> list;
  Statement query(parts_->db, "SELECT kind,name,shard,progress,facts FROM evidence");
  while (query.next()) {
    list.push_back({query.text(0), query.text(1), query.text(2), query.number(3), query.text(4)});
  }
  return list;
}

Expected<void> Store::seal() {
  return catch_store_problem([&] { parts_->db.run("PRAGMA journal_mode=DELETE"); });
}

}  // namespace assay::properties
