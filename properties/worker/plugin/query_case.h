// Turns an elementary query into a case, so that all code that runs and judges cases can treat it
// like any other.
//
// The case has four vertices in the order of FourPoints, two triangles (0,1,2) and (1,3,2), one
// step, and the option `query`. The option is `vertex-face`, for vertex 0 and the face (1,2,3), or
// `edge-edge`, for the edges 01 and 23. The triangles hold these features, so that a picture shows
// them; contacts between other features are not asked for.
#pragma once

#include <optional>
#include <string>

#include "properties/words.h"

namespace assay::properties {

Case case_of_query(const FourPoints& query, std::string id);

// Returns whether the case says that it is a query, rightly or not.
bool says_query(const Case& c);
// Returns the query of such a case; nothing if the case is no query.
std::optional<FourPoints> query_of(const Case& c);

// Returns the two features of the query, by the vertices of its case.
Feature features_of(const FourPoints& query);

const char* query_word(const FourPoints& query);  // "vertex-face", "edge-edge"
// Returns the value of the case's option `query`; empty if it has none.
std::string query_word(const Case& c);
void say_query(Case& c, const std::string& word);

}  // namespace assay::properties
