#include "properties/campaign/stored/merge.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "properties/campaign/stored/binding.h"
#include "properties/campaign/stored/evidence.h"
#include "properties/campaign/stored/store.h"

namespace assay::properties {
namespace {

// A row that is there already must say the same; what may differ is joined by a rule that depends
// on neither order nor repetition (a minimum or a maximum). An update that finds a difference
// changes no row.
struct Table {
  const char* name;
  const char* what;  // of one row, for messages
  int columns;
  int key_columns;  // the first ones
  const char* on_conflict;
};

constexpr Table tables[] = {
    {"trial", "trial", 14, 1,
     "(id) DO UPDATE SET oracle_us=min(oracle_us,excluded.oracle_us), "
     "detector_us=min(detector_us,excluded.detector_us), "
     "slowest_us=min(slowest_us,excluded.slowest_us), "
     "disturbed=max(disturbed,excluded.disturbed) WHERE family=excluded.family AND "
     "place=excluded.place AND outcomes=excluded.outcomes AND triangles=excluded.triangles AND "
     "steps=excluded.steps AND collisions=excluded.collisions AND pairs=excluded.pairs AND "
     "counts=excluded.counts AND mesh=excluded.mesh"},
    {"failure", "failure", 7, 2,
     "(id,configuration) DO UPDATE SET smallest=CASE WHEN excluded.smallest<>'' AND (smallest='' "
     "OR length(excluded.smallest)<length(smallest) OR "
     "(length(excluded.smallest)=length(smallest) AND excluded.smallest<smallest)) THEN "
     "excluded.smallest ELSE smallest END WHERE signature=excluded.signature AND "
     "what=excluded.what AND mesh=excluded.mesh AND flaky=excluded.flaky"},
    {"met", "failure", 3, 2,
     "(id,configuration) DO UPDATE SET signature=signature WHERE signature=excluded.signature"},
    {"evidence", "evidence", 5, 3,
     "(kind,name,shard) DO UPDATE SET facts=CASE WHEN excluded.progress>progress THEN "
     "excluded.facts ELSE facts END, progress=max(progress,excluded.progress) WHERE "
     "progress<>excluded.progress OR facts=excluded.facts"},
};

// The rows of one store, joined to those that are there. Throws StoreProblem.
void join(const Database& from, const Database& into, const Table& table) {
  std::string values = "?";
  for (int c = 1; c < table.columns; ++c) values += ",?";
  const std::string insert =
      fmt::format("INSERT INTO {} VALUES({}) ON CONFLICT{}", table.name, values, table.on_conflict);
  Statement rows(from, fmt::format("SELECT * FROM {}", table.name));
  while (rows.next()) {
    // Columns take the type that their table declares.
    Statement row(into, insert);
    for (int c = 0; c < table.columns; ++c) row.bind(rows.text(c));
    row.next();
    if (row.changed_a_row()) continue;
    std::string key = rows.text(0);
    for (int c = 1; c < table.key_columns; ++c) key += ", " + rows.text(c);
    throw StoreProblem(
        ProblemKind::contradiction,
        fmt::format("{}: {} {} differs from that of another store", from.file(), table.what, key));
  }
}

class Merge {
 public:
  explicit Merge(std::filesystem::path building)
      : building_(std::move(building)), into_(building_, Database::Mode::write) {
    // Nothing of it is of use to anybody before it is whole.
    into_.run("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; BEGIN");
    into_.run(Store::tables());
  }

  void add(const std::filesystem::path& file) {
    check(file);
    const Database from(file, Database::Mode::read);
    from.run("BEGIN");  // one state of a file that may be growing
    for (const auto& table : tables) join(from, into_, table);
    join_notes(from);
    from.run("COMMIT");
  }

  // The bytes of a vacuumed file depend on its rows alone.
  void write(const std::filesystem::path& whole) {
    Statement(into_, "INSERT INTO note VALUES('binding',?)").bind(*binding_).next();
    into_.run("COMMIT");
    std::filesystem::remove(whole);
    Statement(into_, "VACUUM INTO ?").bind(whole.string()).next();
  }

 private:
  void check(const std::filesystem::path& file) {
    const auto store = value_or_throw(Store::read(file));
    const auto binding = with_shard(store.binding(), merged_shard);
    if (!binding) {
      throw StoreProblem(ProblemKind::damaged_store,
                         fmt::format("{}: not the store of a shard", file.string()));
    }
    if (!binding_) {
      binding_ = binding;
      first_ = file;
      return;
    }
    const std::string difference = difference_of(*binding_, *binding);
    if (!difference.empty()) {
      throw StoreProblem(ProblemKind::another_run,
                         fmt::format("{} and {} are of different runs: {}", first_.string(),
                                     file.string(), difference));
    }
  }

  void join_notes(const Database& from) {
    Statement notes(from, "SELECT key,value FROM note WHERE key<>'binding'");
    while (notes.next()) {
      // Notes say that something is done: any of them will do, the smallest word is taken.
      Statement(into_,
                "INSERT INTO note VALUES(?,?) ON CONFLICT(key) DO UPDATE SET "
                "value=min(value,excluded.value)")
          .bind(notes.text(0))
          .bind(notes.text(1))
          .next();
    }
  }

  std::filesystem::path building_;
  Database into_;
  std::optional<std::string> binding_;
  std::filesystem::path first_;
};

}  // namespace

Expected<void> merge_stores(std::span<const std::filesystem::path> stores,
                            const std::filesystem::path& out) {
  std::vector<std::filesystem::path> files(stores.begin(), stores.end());
  std::error_code ignored;
  if (std::filesystem::exists(out, ignored)) files.push_back(out);
  // The first conflict told is then the same in any order.
  std::sort(files.begin(), files.end());
  const auto named = [&](const char* what) {
    return std::filesystem::path(fmt::format("{}.{}-{}", out.string(), what, getpid()));
  };
  const auto building = named("building"), whole = named("whole");
  auto merged = catch_store_problem([&] {
    try {
      Merge merge(building);
      for (const auto& file : files) merge.add(file);
      merge.write(whole);
      std::filesystem::rename(whole, out);
    } catch (const std::filesystem::filesystem_error& failure) {
      throw StoreProblem(
          ProblemKind::cannot_write,
          fmt::format("{}: cannot be written: {}", out.string(), failure.code().message()));
    }
  });
  std::filesystem::remove(building, ignored);
  std::filesystem::remove(whole, ignored);
  return merged;
}

}  // namespace assay::properties
