#include "properties/campaign/stored/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <vector>

#include "properties/campaign/database/file_lock.h"
#include "properties/campaign/database/rows.h"
#include "properties/campaign/stored/binding.h"
#include "properties/campaign/stored/evidence.h"
#include "properties/campaign/stored/store.h"

namespace assay::properties {
namespace {

// How the rows of a table are joined. A row that is there already must say the same as the new
// one. The columns that may differ are joined by a minimum or a maximum, because these depend
// neither on the order nor on repetition. An update that finds a difference elsewhere changes no
// row.
struct JoinedTable {
  const StoreTable& table;
  const char* row_name;  // what a message calls one row
  const char* on_conflict;
};

const std::array<JoinedTable, 4>& joined_tables() {
  static const std::array<JoinedTable, 4> tables = {{
      {trial_table(), "trial",
       "(id) DO UPDATE SET oracle_us=min(oracle_us,excluded.oracle_us), "
       "detector_us=min(detector_us,excluded.detector_us), "
       "slowest_us=min(slowest_us,excluded.slowest_us), "
       "disturbed=max(disturbed,excluded.disturbed) WHERE family=excluded.family AND "
       "place=excluded.place AND outcomes=excluded.outcomes AND triangles=excluded.triangles AND "
       "steps=excluded.steps AND collisions=excluded.collisions AND pairs=excluded.pairs AND "
       "counts=excluded.counts AND mesh=excluded.mesh"},
      {failure_table(), "failure",
       "(id,configuration) DO UPDATE SET smallest=CASE WHEN excluded.smallest<>'' AND (smallest='' "
       "OR length(excluded.smallest)<length(smallest) OR "
       "(length(excluded.smallest)=length(smallest) AND excluded.smallest<smallest)) THEN "
       "excluded.smallest ELSE smallest END, printed=max(printed,excluded.printed) WHERE "
       "signature=excluded.signature AND "
       "what=excluded.what AND mesh=excluded.mesh AND flaky=excluded.flaky"},
      {met_table(), "failure",
       "(id,configuration) DO UPDATE SET signature=signature WHERE signature=excluded.signature"},
      {evidence_table(), "evidence",
       "(kind,name,shard) DO UPDATE SET facts=CASE WHEN excluded.progress>progress THEN "
       "excluded.facts ELSE facts END, progress=max(progress,excluded.progress) WHERE "
       "progress<>excluded.progress OR facts=excluded.facts"},
  }};
  return tables;
}

// A note says that something is done. Any of several texts will do, so the smallest is taken.
constexpr const char* join_of_notes = "(key) DO UPDATE SET value=min(value,excluded.value)";

// Joins the rows of one store to those that are there. Throws StoreProblem.
void join(const Database& from, const Database& into, const JoinedTable& joined) {
  const auto& table = joined.table;
  for_each_row(from, table, nullptr, "", {}, [&](const Row& row) {
    if (put_row(into, table, row, joined.on_conflict)) return;
    std::string key = row[0];
    for (std::size_t c = 1; c < table.key_columns; ++c) key += ", " + row[c];
    throw StoreProblem(fmt::format("{}: {} {} differs from that of another store", from.file(),
                                   joined.row_name, key));
  });
}

// A row that was joined from two stores may have the hash of one of them, or of neither, so its
// hash is computed anew.
void renew_hashes(const Database& into, const StoreTable& table) {
  std::vector<Row> joined;
  {
    Statement rows(into, fmt::format("SELECT {} FROM {}", column_names(table), table.name));
    const auto count = static_cast<int>(table.columns.size());
    while (rows.next()) {
      Row row;
      for (int c = 0; c < count; ++c) row.push_back(rows.text(c));
      if (rows.text(count) != row_hash(table, row)) joined.push_back(std::move(row));
    }
  }
  for (const auto& row : joined) put_row(into, table, row);
}

// Only one merge at a time may write into the folder of its file.
FileLock lock_of_folder(const std::filesystem::path& file) {
  const auto folder = file.has_parent_path() ? file.parent_path() : ".";
  return {folder, FileLock::On::folder,
          fmt::format("{}: another merge is writing into it", folder.string())};
}

class Merge {
 public:
  explicit Merge(const std::filesystem::path& building) : into_(building, Database::Mode::write) {
    // A journal is not needed, because a half-written file is of no use to anybody.
    into_.run("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; BEGIN");
    into_.run(table_declarations());
  }

  void add(const std::filesystem::path& file) {
    check(file);
    const Database from(file, Database::Mode::read);
    from.run("BEGIN");  // a shard may be growing: this keeps to one state of the file
    for (const auto& joined : joined_tables()) join(from, into_, joined);
    join_notes(from);
    from.run("COMMIT");
  }

  // The file is vacuumed, because the bytes of a vacuumed file depend on its rows alone.
  void write(const std::filesystem::path& whole) {
    put_row(into_, note_table(), {"binding", *binding_});
    for (const auto* table : store_tables()) renew_hashes(into_, *table);
    into_.run("COMMIT");
    Statement(into_, "VACUUM INTO ?").bind(whole.string()).next();
  }

 private:
  void check(const std::filesystem::path& file) {
    const auto store = value_or_throw(Store::read(file));
    const auto binding = with_shard(store.binding(), merged_shard);
    if (!binding) {
      throw StoreProblem(fmt::format("{}: not the store of a shard", file.string()));
    }
    if (!binding_) {
      binding_ = binding;
      first_ = file;
      return;
    }
    const std::string difference = difference_of(*binding_, *binding);
    if (!difference.empty()) {
      throw StoreProblem(fmt::format("{} and {} are of different runs: {}", first_.string(),
                                     file.string(), difference));
    }
  }

  void join_notes(const Database& from) {
    for_each_row(from, note_table(), nullptr, "", {}, [&](const Row& row) {
      if (row[0] != "binding") put_row(into_, note_table(), row, join_of_notes);
    });
  }

  Database into_;
  std::optional<std::string> binding_;
  std::filesystem::path first_;
};

// The files that a merge writes before it is whole. Their names are fixed, so that a merge clears
// away what an earlier one left if it was killed. REQUIRES the lock of their folder.
struct PartFiles {
  std::filesystem::path building, whole;

  explicit PartFiles(const std::filesystem::path& out)
      : building(fmt::format("{}.building", out.string())),
        whole(fmt::format("{}.whole", out.string())) {
    clear_away();
  }
  PartFiles(const PartFiles&) = delete;
  PartFiles& operator=(const PartFiles&) = delete;
  ~PartFiles() { clear_away(); }

 private:
  void clear_away() const {
    std::error_code ignored;
    std::filesystem::remove(building, ignored);
    std::filesystem::remove(whole, ignored);
  }
};

}  // namespace

Expected<void> merge_stores(std::span<const std::filesystem::path> stores,
                            const std::filesystem::path& out) {
  return catch_store_problem([&] {
    const FileLock lock = lock_of_folder(out);
    std::vector<std::filesystem::path> files(stores.begin(), stores.end());
    std::error_code ignored;
    if (std::filesystem::exists(out, ignored)) files.push_back(out);
    // The files are sorted, so that the same conflict is reported first whatever their order was.
    std::sort(files.begin(), files.end());
    const PartFiles parts(out);
    Merge merge(parts.building);
    for (const auto& file : files) merge.add(file);
    merge.write(parts.whole);
    std::error_code error;
    std::filesystem::rename(parts.whole, out, error);
    if (error)
      throw StoreProblem(fmt::format("{}: cannot be written: {}", out.string(), error.message()));
  });
}

}  // namespace assay::properties
