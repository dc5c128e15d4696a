// The rows of a ledger: the one form in which a campaign keeps all that it finds out. A trial is a
// row, and so is a failure, a note, or a planted fault that was found. Every row carries a hash.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "properties/campaign/ledger/database.h"

namespace assay::properties {

struct Row {
  std::string kind;            // "trial", "canary", ...
  std::string key;             // names it among the rows of its kind
  std::uint64_t progress = 0;  // how far it came; of two rows the one that came farther stays
  std::string fields;          // a JSON object
  friend bool operator==(const Row&, const Row&) = default;
};

// The kinds that every store has. Those of the other rows are in evidence.h.
inline constexpr std::string_view binding_kind = "binding", note_kind = "note",
                                  trial_kind = "trial", failure_kind = "failure", met_kind = "met";

// The row without the fields that may differ between two runs of one campaign: times, what was
// disturbed from outside, and how far a case could be shrunk in its time.
Row lasting(Row row);

// SHA-256 over all of the row, each column behind its length, so that no two different rows give
// the same bytes. It shows that a row was changed by a disk, or by somebody who does not mend the
// hash. It is no signature: whoever may write the file can write a hash that fits.
std::string row_hash(const Row& row);

// "trial quick:1:broken:3", "canary pair/x"
std::string row_name(const Row& row);

// The SQL that makes the one table of a store, and leaves it as it is if it is there already.
std::string table_declaration();

// Visits rows. `more` is SQL such as "WHERE kind=? ORDER BY key", whose question marks stand for
// the texts of `bound`; if it is empty all rows come in the order of kind and key.
// Throws StoreProblem at the first row that does not fit its own hash, and if SQLite fails.
void for_each_row(const Database& database, const std::string& more,
                  const std::vector<std::string_view>& bound,
                  const std::function<void(const Row&)>& visit);

// Writes the row with its hash, in place of a row of the same kind and key.
void put_row(const Database& database, const Row& row);

// Throws StoreProblem unless the file holds the table of a store and nothing else, such as a
// trigger that changes rows by itself. If `may_lack` is set, the table may not be there yet.
void check_tables(const Database& database, bool may_lack);

}  // namespace assay::properties
