// The figures of suite peers as a table, as JSON and as CSV (reports/README.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "reports/bench/peers/peer_summary.h"

namespace assay::reports {

// A table with one line for each detector; then what its columns say, the runs that ended early,
// and who is absent.
std::string text_of(std::span<const PeerRow> rows, std::span<const PeerFamily> families,
                    std::span<const AbsentPeer> absent);

// One line for each unsafe answer that only the oracle calls so; empty if there is none.
std::string unconfirmed_text(std::span<const UnsafeAnswer> answers);

nlohmann::ordered_json to_json(std::span<const UnsafeAnswer> answers);
nlohmann::ordered_json to_json(std::span<const PeerRow> rows);
nlohmann::ordered_json to_json(std::span<const PeerFamily> families);
nlohmann::ordered_json to_json(std::span<const AbsentPeer> absent);

// One line for each family and detector.
std::string csv_of(std::span<const PeerFamily> families);

}  // namespace assay::reports
