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
// because they start in contact, or too near to it. The frame at which the first remaining step
// starts becomes the first frame, because the detector is made there. Returns nothing if a
// coordinate is out of the contract's range, or if no step is left: the case is then not for this
// detector. A query (query_case.h) is taken or left out as a whole; a case that claims to be a
// query and is none is not taken. Expected facts that are no longer known to hold are left out.
std::optional<Case> contract_case(const Case& c, const Contract& contract);

// Returns why contract_case() gives nothing for the case, in one line: the member of the contract,
// the place and the value ("frame 1 of 2: edge 3-4 is 2e-13 long, below least_nonzero, 1e-06";
// "start free: triangles 3 and 8 are in contact where step 1 starts, and every other step starts
// so").
std::string why_left_out(const Case& c, const Contract& contract);

// Returns the edges whose lengths count for a contract's range: of all triangles, or of the
// features of a query.
std::vector<Edge> edges_of(const Case& c);
// Returns the longest side of the mesh's box in its first frame.
double extent_of(const Case& c);

// Returns the case with only the steps at these places, ascending, and the frames that they use. If
// the contract has a distance at rest, the first frame stays too, because the mesh is at rest
// there. Expected facts are about the whole case, so all but a refusal of the mesh are dropped.
// REQUIRES at least one place.
Case with_steps(const Case& c, const std::vector<std::size_t>& places,
                const Contract& contract = {});

// Returns the exact answer to the query alone, as the contract asks it, in the form of a judgement
// of its case (query_case.h). A contact is one of triangles 0 and 1, by the two features of the
// query. Cost: oracle/query/contact.h, oracle/distance/feature_distance.h.
StepJudgement judge_query(const FourPoints& query, const Contract& contract = {});

// Returns whether at t = 0 the two features are neither in contact nor nearer than the distance.
bool start_apart(const FourPoints& query, double distance);

// Returns whether a contract takes the query. This depends on the kind of its features, and on
// their places at t = 0.
bool takes(const Contract& contract, const FourPoints& query);

// Returns the contract under which an answer to a query is judged. Its adjacency leaves nothing
// out, because the two features of a query are no neighbours.
Contract on_queries(const Contract& contract);

}  // namespace assay::properties
