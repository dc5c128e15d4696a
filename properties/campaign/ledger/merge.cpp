#include "properties/campaign/ledger/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "properties/campaign/ledger/binding.h"
#include "properties/campaign/ledger/evidence.h"
#include "properties/campaign/ledger/store.h"

namespace assay::properties {
namespace {

// Joins a row of one store to the rows that are there. A row that is there already must say the
// same as the new one, but for what may differ (row.h).
void join(const Database& from, const Row& row, const Database& into) {
  if (put_row(into, row, Put::if_new)) return;
  std::optional<Row> there;
  for_each_row(into, "WHERE kind=? AND key=? AND shard=?", {row.kind, row.key, row.shard},
               [&](const Row& other) { there = other; });
  const auto both = joined(there.value(), row);
  if (!both)
    throw StoreProblem(
        fmt::format("{}: {} differs from that of another store", from.file(), row_name(row)));
  if (*both != *there) put_row(into, *both);
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
    into_.run(table_declaration());
  }

  void add(const std::filesystem::path& file) {
    check(file);
    const Database from(file, Database::Mode::read);
    from.run("BEGIN");  // a shard may be growing: this keeps to one state of the file
    for_each_row(from, "", {}, [&](const Row& row) {
      if (row.kind != binding_kind) join(from, row, into_);
    });
    from.run("COMMIT");
  }

  // The file is vacuumed, because the bytes of a vacuumed file depend on its rows alone.
  void write(const std::filesystem::path& whole) {
    put_row(into_, {std::string(binding_kind), "", "", 0, *binding_});
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
