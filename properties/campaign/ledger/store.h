// Stores the rows of one run in one SQLite file, which survives a kill of the process at any
// moment; and names the files of the run's folder.
//
// Every row carries a hash (campaign/ledger/database.h), which is checked whenever the row is read.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "properties/campaign/ledger/record.h"

namespace assay::properties {

// The schema of a store, part of its binding (binding.h). A store of another schema is refused.
inline constexpr const char* store_schema = "assay-store/9";

// All failures that a store holds.
struct FailureList {
  std::vector<FailureRecord> list;  // by signature, then id
  Counts times_met;                 // by signature; failures without a stored mesh count, too
};

// Functions that return Expected are for all rooms. All other functions throw StoreProblem and are
// only for campaign/ (campaign/ledger/database.h).
class Store {
 public:
  // Opens the file for writing; makes the file if it does not exist. `binding` says to which run
  // the trials belong (plan, seed, share, detector). Costs O(rows), about 2 us for each row,
  // because every row is checked. Fails if the file has another binding, if another process has the
  // file open for writing, if it is no store of this schema, if it is damaged, if a row was
  // changed, or if the file cannot be written.
  static Expected<Store> open(const std::filesystem::path& file, const std::string& binding);
  // Opens an existing file, whatever run it was made for, without writing to it. All reads see one
  // state of the file, even while another process adds to it. Fails if there is no such file, if it
  // is no store of this schema, or if it is damaged. A row that was changed is noticed only when it
  // is read: the reading function then throws StoreProblem.
  static Expected<Store> read(const std::filesystem::path& file);

  Expected<FailureList> kept_failures() const;
  Expected<void> keep(const Row& row) {
    return catch_store_problem([&] { set(row); });
  }
  // Makes the store a single file: moves the rows from SQLite's files beside the store into the
  // store. Afterwards reading does not change the bytes of the store.
  Expected<void> seal();

  std::string binding() const;

  // When one of the functions below returns, the rows that it wrote survive a kill of the process.
  // Only one thread at a time may call these functions.

  // Replaces the row of the same kind and key, unless the old row has more progress.
  void set(const Row& row);
  // Removes all rows of a kind.
  void drop(std::string_view kind);
  // Adds a trial with its failures, either completely or not at all. Every failure is counted
  // (times_met), and a failure with a mesh is also stored.
  void add(const TrialRecord& record, const std::vector<FailureRecord>& failures = {});
  void add(const FailureRecord& failure) { set(to_row(failure)); }
  // Removes the stored failures of the corpus whose signature is not in the set.
  void keep_corpus_failures(const std::set<std::string>& signatures);
  // Replaces the stored failure of this id and configuration; does nothing if there is none.
  void set_smallest(const FailureRecord& failure);
  void set_note(const std::string& key, const std::string& value);

  // Visits the rows of a kind in the order of their keys; trials of a family come in the order of
  // their index.
  void for_each(std::string_view kind, const std::function<void(const Row&)>& visit) const;
  void for_each_trial(const std::function<void(const TrialRecord&)>& visit) const;
  bool has_trial(const std::string& id) const;
  std::uint64_t trial_count() const;
  std::vector<FailureRecord> failures() const;  // by signature, then id
  // Returns the number of failures of each signature, with and without a stored mesh.
  Counts signatures() const;
  std::optional<std::string> note(const std::string& key) const;
  std::vector<Row> evidence() const;  // all rows of the kinds in evidence.h, by kind and key

 private:
  Store(Descriptor lock, Database db) : lock_(std::move(lock)), db_(std::move(db)) {}
  Descriptor lock_;  // declared first, so that it outlives the database
  Database db_;
};

// Copies a store into another file, whose bytes depend only on the rows. Fails if Store::read
// fails, or if the copy cannot be written; the other file then stays as it was.
Expected<void> copy_store(const std::filesystem::path& from, const std::filesystem::path& to);

// The functions below return the paths of the files in the folder OUT of a run.

// Returns OUT/run.sqlite.
inline std::filesystem::path store_file(const std::filesystem::path& out) {
  return out / "run.sqlite";
}
// Returns OUT/seed-7.sqlite: the copy of a run's store in a folder where several runs are judged
// together.
std::filesystem::path copied_store_file(const std::filesystem::path& out, std::uint64_t seed);
// Return OUT/campaign.json and OUT/certificate.json.
inline std::filesystem::path campaign_file(const std::filesystem::path& out) {
  return out / "campaign.json";
}
inline std::filesystem::path certificate_file(const std::filesystem::path& out) {
  return out / "certificate.json";
}

// Returns the stores in a folder, in the order of their names. Fails if there are none, or if the
// folder cannot be listed.
Expected<std::vector<std::filesystem::path>> stored_runs(const std::filesystem::path& folder);

// Fails if the folder holds a store that is not in `outputs`, because all stores of a folder are
// judged together.
Expected<void> expect_no_other_store(const std::filesystem::path& folder,
                                     const std::set<std::filesystem::path>& outputs);

// note_library stores the path of a plug-in's library, as given to the run. note_begin stores the
// time at which the run began, if no such time is stored yet. Both throw StoreProblem, so they are
// only for campaign/. The constants are the keys of the two notes.
inline constexpr const char *library_note = "library", *begin_note = "begun";
void note_library(Store& store, const std::filesystem::path& library);
void note_begin(Store& store);

// Returns the current time in UTC: 2026-01-31T12:00:00Z. No verdict depends on the time.
std::string time_in_utc();

// Returns the file of a failure below OUT, the same in every run that finds the failure:
// failures/tiny-1-broken-3-bvh-smallest.json.
std::filesystem::path failure_file(const FailureRecord& failure, bool smallest);

}  // namespace assay::properties
