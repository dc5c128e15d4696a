// Fits a case, or an elementary query, to a detector's contract. Both the detector and the oracle
// get the resulting case.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "properties/claims/claims.h"
#include "properties/judging/agreement.h"

namespace assay::properties {

// Returns the case with coordinates rounded, and without the steps that the contract leaves out
// because they start in contact, or nearer than start_distance. The frame at which the first
// remaining step starts becomes the first frame, because the detector is made from that frame.
// Returns nothing if the contract does not take the case: a coordinate is out of the contract's
// range, no step remains, or the options call the case a query although it is no query
// (query_case.h). A query has one step, so it is taken as a whole or not at all. Expected facts
// that may no longer hold are removed.
std::optional<Case> contract_case(const Case& c, const Contract& contract);

// Returns why contract_case() gives nothing for the case, in one line: the member of the contract,
// the place and the value ("frame 1 of 2: edge 3-4 is 2e-13 long, below least_nonzero, 1e-06";
// "start free: triangles 3 and 8 are in contact where step 1 starts; no other step is taken").
std::string why_left_out(const Case& c, const Contract& contract);

// Returns the edges whose lengths must be in a contract's range: the edges of all triangles, or of
// the two features of a query.
std::vector<Edge> edges_of(const Case& c);
// Returns the longest side of the mesh's box in its first frame.
double extent_of(const Case& c);

// Returns the case with only the steps at these places, and the frames that these steps use. If the
// contract has a rest_distance, the first frame stays too, because the mesh is at rest there.
// Expected facts about the whole case are removed, except a refusal of the mesh. REQUIRES at least
// one place, and ascending places.
Case with_steps(const Case& c, const std::vector<std::size_t>& places,
                const Contract& contract = {});

// Returns the exact answer to the contract's question about the two features of the query, in the
// form of a judgement of the query's case (query_case.h): a contact of the features becomes a
// contact of triangles 0 and 1. Cost: oracle/query/contact.h, oracle/distance/feature_distance.h.
StepJudgement judge_query(const FourPoints& query, const Contract& contract = {});

// Returns whether at t = 0 the two features are not in contact and not nearer than `distance`.
bool start_apart(const FourPoints& query, double distance);

// Returns whether a contract takes the query. This depends on the kind of the query's features, and
// on their places at t = 0.
bool takes(const Contract& contract, const FourPoints& query);

// Returns the contract under which an answer to a query is judged. It leaves out no neighbours,
// because the two features of a query are no neighbours.
Contract on_queries(const Contract& contract);

}  // namespace assay::properties
