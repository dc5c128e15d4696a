// Renders measures of a run in words and as JSON: how well a plug-in answers, whatever it claims;
// the sizes up to which its claims were tried; and how planted faults were found.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "properties/campaign/gates/gates.h"

namespace assay::reports {

// Returns a row for each stratum and one for all of them: false alarms with their interval, misses,
// spurious pairs, how late and how early times are, and how much the contract leaves out. The
// claims that were not judged follow. Returns an empty text for the built-in detector.
std::string measures_text(const properties::RunFindings& findings);

// Returns the measures of a few steps, in words: "1 of 2 free steps answered collision; 28874
// spurious pairs; ...". Empty if there is nothing to say.
std::string measures_sentence(const properties::StepMeasures& measures);

// The next three functions take `judged_up_to`, `tried` and `power` of a predicate
// (certificate/statement.h).

// Returns "meshes of up to 2048 triangles", or, if sizes differ, "meshes of up to 2048 triangles
// (free-sound, total), of up to 60 (deterministic)". Empty if no sizes are listed.
std::string sizes_text(const nlohmann::ordered_json& judged_up_to);
// Returns "largest tried: 8 steps between two starts, 14 triangles at a vertex, 3 bodies, 5
// components, 812 pairs in a step, 200 triangles; relations: 0 cases".
std::string extremes_text(const nlohmann::ordered_json& extremes);
// Returns "72 by random cases, 44 by their curated case alone".
std::string found_text(const nlohmann::ordered_json& power);

// Returns the columns of one row, without the row's name. Rows of queries have no columns for
// pairs.
std::string measures_row(const properties::StepMeasures& measures, bool of_queries);
std::string measures_head(bool of_queries);

// Returns the measures of a plug-in's steps as JSON (`measures` of a certificate's stratum).
nlohmann::ordered_json measures_json(const properties::StepMeasures& measures);

}  // namespace assay::reports
