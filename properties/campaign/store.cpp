#include "properties/campaign/store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace assay::properties {
namespace {

std::string problem_of(sqlite3* db) {
  const char* file = sqlite3_db_filename(db, "main");
  return fmt::format("{}: {}", file ? file : "store", sqlite3_errmsg(db));
}

constexpr const char* tables =
    "CREATE TABLE IF NOT EXISTS note(key TEXT PRIMARY KEY, value TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS trial(id TEXT PRIMARY KEY, family TEXT NOT NULL, place INTEGER NOT "
    "NULL, outcomes TEXT NOT NULL, triangles INTEGER NOT NULL, steps INTEGER NOT NULL, collisions "
    "INTEGER NOT NULL, pairs INTEGER NOT NULL, oracle_us INTEGER NOT NULL, detector_us INTEGER NOT "
    "NULL, counts TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE IF NOT EXISTS failure(id TEXT NOT NULL, configuration TEXT NOT NULL, signature "
    "TEXT NOT NULL, what TEXT NOT NULL, mesh TEXT NOT NULL, smallest TEXT NOT NULL, flaky INTEGER "
    "NOT NULL, PRIMARY KEY(id, configuration));"
    "CREATE TABLE IF NOT EXISTS signature(text TEXT PRIMARY KEY, met INTEGER NOT NULL);";

// One prepared statement, reset when it goes out of scope.
class Query {
 public:
  Query(sqlite3* db, const char* sql) : db_(db) {
    check(sqlite3_prepare_v2(db, sql, -1, &statement_, nullptr));
  }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;
  ~Query() { sqlite3_finalize(statement_); }

  Query& bind(const std::string& text) {
    check(sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()),
                            SQLITE_TRANSIENT));
    return *this;
  }
  Query& bind(std::uint64_t number) {
    check(sqlite3_bind_int64(statement_, ++bound_, static_cast<sqlite3_int64>(number)));
    return *this;
  }

  // True while there is a row.
  bool next() {
    const int code = sqlite3_step(statement_);
    if (code == SQLITE_ROW) return true;
    if (code != SQLITE_DONE) check(code);
    return false;
  }
  std::string text(int column) const {
    const auto* begin = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return {begin, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
  }
  std::uint64_t number(int column) const {
    return static_cast<std::uint64_t>(sqlite3_column_int64(statement_, column));
  }

 private:
  void check(int code) const {
    if (code != SQLITE_OK) throw StoreProblem(problem_of(db_));
  }
  sqlite3* db_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

}  // namespace

struct Store::Parts {
  sqlite3* db = nullptr;
  int lock = -1;

  Parts(const std::filesystem::path& file, int flags) {
    if (flags & SQLITE_OPEN_CREATE) take_lock(file);
    if (sqlite3_open_v2(file.c_str(), &db, flags, nullptr) != SQLITE_OK) {
      const std::string reason =
          fmt::format("{}: {}", file.string(), db ? sqlite3_errmsg(db) : "no memory");
      close_all();
      throw StoreProblem(reason);
    }
    constexpr int patience_ms = 5000;
    sqlite3_busy_timeout(db, patience_ms);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() { close_all(); }

  void run(const char* sql) const {
    if (sqlite3_exec(db, sql, nullptr, nullptr, nullptr) != SQLITE_OK)
      throw StoreProblem(problem_of(db));
  }
  void check_whole() const {
    Query query(db, "PRAGMA quick_check(1)");
    if (!query.next() || query.text(0) != "ok")
      throw StoreProblem(fmt::format("{}: the file is damaged", sqlite3_db_filename(db, "main")));
  }

 private:
  // Held until this process ends, however it ends.
  void take_lock(const std::filesystem::path& file) {
    const std::string name = file.string() + ".lock";
    lock = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock < 0) throw StoreProblem(fmt::format("{}: {}", name, std::strerror(errno)));
    if (::flock(lock, LOCK_EX | LOCK_NB) == 0) return;
    close_all();
    throw StoreProblem(fmt::format("{}: another run is writing it", file.string()));
  }
  void close_all() {
    sqlite3_close(db);
    if (lock >= 0) ::close(lock);
  }
};

Store::Store(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

std::optional<Store> Store::read(const std::filesystem::path& file, std::string& problem) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    problem = fmt::format("{}: no such file", file.string());
    return std::nullopt;
  }
  try {
    auto parts = std::make_unique<Parts>(file, SQLITE_OPEN_READONLY);
    const bool is_store = Query(parts->db, "SELECT 1 FROM sqlite_master WHERE name='note'").next();
    Store store(std::move(parts));
    if (is_store && store.note("binding")) return store;
    problem = fmt::format("{}: not the store of a run", file.string());
  } catch (const StoreProblem& failure) {
    problem = failure.what();
  }
  return std::nullopt;
}

std::optional<Store> Store::open(const std::filesystem::path& file, const std::string& binding,
                                 std::string& problem) {
  try {
    auto parts = std::make_unique<Parts>(file, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    // A killed process loses nothing that add() returned from; only a power cut may lose the end.
    parts->run("PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL;");
    parts->check_whole();
    parts->run(tables);
    Store store(std::move(parts));
    const auto bound = store.note("binding");
    if (!bound) {
      store.set_note("binding", binding);
    } else if (*bound != binding) {
      problem = fmt::format(
          "{}: holds another run (of another plan, seed, shard, detector or build)", file.string());
      return std::nullopt;
    }
    return store;
  } catch (const StoreProblem& failure) {
    problem = failure.what();
    return std::nullopt;
  }
}

std::string Store::binding() const { return note("binding").value_or(""); }

void Store::add(const TrialRecord& r) {
  Query(parts_->db, "INSERT OR REPLACE INTO trial VALUES(?,?,?,?,?,?,?,?,?,?,?)")
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
      .next();
}

void Store::add(const TrialRecord& record, const std::vector<StoredFailure>& kept,
                const std::vector<std::string>& met) {
  parts_->run("BEGIN IMMEDIATE");
  try {
    for (const auto& failure : kept) add(failure);
    for (const auto& signature : met) count_signature(signature);
    add(record);
    parts_->run("COMMIT");
  } catch (const StoreProblem&) {
    sqlite3_exec(parts_->db, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

void Store::add(const StoredFailure& f) {
  Query(parts_->db, "INSERT OR REPLACE INTO failure VALUES(?,?,?,?,?,?,?)")
      .bind(f.id)
      .bind(f.configuration)
      .bind(f.signature)
      .bind(f.what)
      .bind(f.mesh)
      .bind(f.smallest)
      .bind(std::uint64_t{f.flaky})
      .next();
}

void Store::set_smallest(const StoredFailure& f) {
  Query(parts_->db, "UPDATE failure SET smallest=? WHERE id=? AND configuration=?")
      .bind(f.smallest)
      .bind(f.id)
      .bind(f.configuration)
      .next();
}

void Store::set_note(const std::string& key, const std::string& value) {
  Query(parts_->db, "INSERT OR REPLACE INTO note VALUES(?,?)").bind(key).bind(value).next();
}

bool Store::has_trial(const std::string& id) const {
  return Query(parts_->db, "SELECT 1 FROM trial WHERE id=?").bind(id).next();
}

std::uint64_t Store::trial_count() const {
  Query query(parts_->db, "SELECT count(*) FROM trial");
  return query.next() ? query.number(0) : 0;
}

std::optional<std::string> Store::note(const std::string& key) const {
  Query query(parts_->db, "SELECT value FROM note WHERE key=?");
  query.bind(key);
  return query.next() ? std::optional(query.text(0)) : std::nullopt;
}

void Store::for_each_trial(const std::function<void(const TrialRecord&)>& visit) const {
  Query query(parts_->db,
              "SELECT id,family,place,outcomes,triangles,steps,collisions,pairs,oracle_us,"
              "detector_us,counts FROM trial ORDER BY family, place");
  while (query.next()) {
    visit({query.text(0), query.text(1), query.number(2), query.text(3), query.number(4),
           query.number(5), query.number(6), query.number(7), query.number(8), query.number(9),
           parse_counts(query.text(10))});
  }
}

std::vector<StoredFailure> Store::failures() const {
  std::vector<StoredFailure> list;
  Query query(parts_->db,
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
  Query query(parts_->db, "SELECT text,met FROM signature");
  while (query.next()) counts[query.text(0)] = query.number(1);
  return counts;
}

void Store::count_signature(const std::string& signature) {
  Query(parts_->db, "INSERT INTO signature VALUES(?,1) ON CONFLICT(text) DO UPDATE SET met=met+1")
      .bind(signature)
      .next();
}

}  // namespace assay::properties
