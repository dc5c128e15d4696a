// The trials and failures of one shard, in one file: SQLite, safe under a kill at any moment.
//
// Every row carries a hash (campaign/database/rows.h), which is looked at wherever it is read. A
// store that is open for writing knows all of its rows besides, those that it found and those that
// it wrote, so that nobody changes them unseen in the meantime, whatever hash he writes.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "properties/campaign/database/rows.h"
#include "properties/campaign/stored/record.h"

namespace assay::properties {

// Of the text that binds a store to a run (binding.h). A store of another schema is refused.
inline constexpr const char* store_schema = "assay-store/4";

// A defect with its mesh. `mesh` and `smallest` are case files (assay-case/1) as text.
struct StoredFailure {
  std::string id;  // of the trial
  std::string configuration, signature, what;
  std::string mesh;
  std::string smallest;      // empty: not shrunk
  bool flaky = false;        // two runs of it differ: a failure of its own
  std::string printed = {};  // by a plug-in when it failed, in printable lines; two runs may differ
};

// Of a broken law the signature is "law L3_...", and `configuration` is "view-point, law L3_...",
// for a case may break a law and a claim.
inline constexpr std::string_view law_in_signature = "law ", law_in_configuration = ", law ";

// The id of a failure that the shipped corpus shows is this and the name of its case. No trial's
// id begins so: the name of a campaign has no '/'.
inline constexpr std::string_view corpus_in_id = "corpus/";

// The same of a large mesh on which two runs differ.
inline constexpr std::string_view repeated_in_id = "repeated/";

// What the mesh of a failure says of itself: "all-pairs: missing pair, edge-edge; triangles 0 and
// 1 meet at 0.5", and back: what stands behind the signature, of the smallest mesh where there is
// one.
std::string about_text(const std::string& signature, const std::string& what);
std::string shown_what(const StoredFailure& failure);

// That a trial showed something in a configuration: kept of every failure, its mesh of a few.
struct MetFailure {
  std::string configuration, signature;  // as of StoredFailure
};

// All failures that a store holds.
struct KeptFailures {
  std::vector<StoredFailure> list;  // by signature, then id
  Counts met;                       // how many of each signature were met, kept or not
};

// What a run found out besides its trials: the canary, planted faults, worlds, ...
struct Evidence {
  std::string kind, name;
  std::string shard;           // "1/4": who found it out
  std::uint64_t progress = 0;  // how far it came; of two by the same shard the farther one counts
  std::string facts;           // a JSON object, without times where the kind does not say so
};

// What returns Expected is for all rooms. The rest throws StoreProblem and is for campaign/ alone
// (campaign/database/store_problem.h).
class Store {
 public:
  // Opens or makes the file. `binding` says what the trials are of (plan, seed, shard, detector).
  // another_run for a file that was made for another one, busy for one that another process has
  // open in this way; foreign_file, other_schema, damaged_store, changed_row, cannot_read,
  // cannot_write. O(rows), about 2 us each: all of them are looked at.
  static Expected<Store> open(const std::filesystem::path& file, const std::string& binding);
  // An existing file, whatever it was made for; it is not written to. What is read of it is one
  // state of a file that may be growing. not_found, foreign_file, other_schema, damaged_store,
  // cannot_read; changed_row where its rows are read.
  static Expected<Store> read(const std::filesystem::path& file);
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  Expected<KeptFailures> kept_failures() const;
  // From now on the file stands alone: nothing beside it belongs to it, and reading it leaves its
  // bytes as they are.
  Expected<void> seal();

  // REQUIRES a store that was opened for writing. All rows that were there when it was opened, and
  // all that were written since.
  const RowTally& known_rows() const;
  // not_as_stored where any row differs from those, is missing, or is one too many. O(rows).
  Expected<void> check_against(const RowTally& known) const;

  std::string binding() const;

  // Each is whole on disk when it returns. Not for several threads at once.
  void add(const TrialRecord& record);
  // A trial with what it showed, all of it or nothing: the failures kept, and all that were met.
  void add(const TrialRecord& record, const std::vector<StoredFailure>& kept,
           const std::vector<MetFailure>& met);
  void add(const StoredFailure& failure);
  // Takes away the failures of other signatures.
  void keep_failures(const std::set<std::string>& signatures);
  // As add, where there is a failure of this id and configuration already.
  void set_smallest(const StoredFailure& failure);
  void set_note(const std::string& key, const std::string& value);
  // In place of what the same shard found out before, unless that came farther.
  void set(const Evidence& evidence);
  void drop_evidence(const std::string& kind);

  bool has_trial(const std::string& id) const;
  std::uint64_t trial_count() const;
  std::optional<std::string> note(const std::string& key) const;
  void for_each_trial(const std::function<void(const TrialRecord&)>& visit) const;
  std::vector<StoredFailure> failures() const;  // by signature, then id
  // How many failures of each signature were met, kept or not.
  Counts signatures() const;
  std::vector<Evidence> evidence() const;  // by kind, name, shard

 private:
  struct Parts;
  explicit Store(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

// Of an existing store; the problems are those of Store::read.
Expected<KeptFailures> read_failures(const std::filesystem::path& file);

}  // namespace assay::properties
