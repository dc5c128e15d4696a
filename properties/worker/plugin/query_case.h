// Turns an elementary query into a case, so that all code that runs and judges cases can also run
// and judge queries.
//
// The case has four vertices in the order of FourPoints, two triangles (0,1,2) and (1,3,2), one
// step, and the option `query`. The option is `vertex-face`, for vertex 0 and the face (1,2,3), or
// `edge-edge`, for the edges 01 and 23. The edges and vertices of the two triangles include these
// features, so that a picture shows the features. Contacts between other features are not asked
// for.
#pragma once

#include <optional>
#include <string>

#include "properties/words.h"

namespace assay::properties {

Case case_of_query(const FourPoints& query, std::string id);

// Returns whether the case has the option `query`, even if its mesh is not that of a query.
bool says_query(const Case& c);
// Returns the query from which the case was made; nothing if the case is no query.
std::optional<FourPoints> query_of(const Case& c);

// Returns the two features of the query, by the vertices of its case.
Feature features_of(const FourPoints& query);

const char* query_word(const FourPoints& query);  // "vertex-face", "edge-edge"
// Returns the value of the case's option `query`; empty if the case has no such option.
std::string query_word(const Case& c);
void say_query(Case& c, const std::string& word);

}  // namespace assay::properties
