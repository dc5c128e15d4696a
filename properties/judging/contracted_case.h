// A case, and an elementary query, as a detector's contract has it. Both the detector and the
// oracle are given this case.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corpus/cases/case_file.h"
#include "detector/mesh/step_types.h"
#include "oracle/mesh/step.h"
#include "properties/claims/claims.h"

namespace assay::properties {

// The case with coordinates rounded, and without the steps that the contract leaves out because
// they start in contact, or too near to it. The frame at which the first remaining step starts
// becomes the first frame, because the detector is made there. Nothing if a coordinate is beyond
// what the contract can hold, or if no step is left: the case is then not for this detector. A
// query (query_case.h) is taken or left out as a whole; a case that says that it is a query and is
// none is not taken. Expected facts that are no longer known to hold are left out.
std::optional<corpus::Case> contract_case(const corpus::Case& c, const Contract& contract);

// Why contract_case() gives nothing for the case, in one line: the member of the contract, the
// place and the value ("frame 1 of 2: edge 3-4 is 2e-13 long, below least_nonzero, 1e-06"; "start
// free: triangles 3 and 8 are in contact where step 1 starts, and every other step starts so").
std::string why_left_out(const corpus::Case& c, const Contract& contract);

// The edges whose lengths count for a contract's range: of all triangles, or of the features of a
// query.
std::vector<Edge> edges_of(const corpus::Case& c);
// The longest side of the mesh's box in its first frame.
double extent_of(const corpus::Case& c);

// The case with only the steps at these places, ascending, and the frames that they use. If the
// contract goes by distances at rest, its first frame stays too, because that is at rest. What was
// expected of the whole case is no longer known, unless it is that the mesh is refused. REQUIRES at
// least one place.
corpus::Case with_steps(const corpus::Case& c, const std::vector<std::size_t>& places,
                        const Contract& contract = {});

// The exact answer to the query alone, as the contract asks it, in the form of a judgement of its
// case (query_case.h). A contact is one of triangles 0 and 1, by the two features that are asked.
// Cost: oracle/query/contact.h, oracle/distance/feature_distance.h.
oracle::StepJudgement judge_query(const detector::FourPoints& query, const Contract& contract = {});

// Whether the two features are not in contact at t = 0, and not nearer there than the distance.
bool start_apart(const detector::FourPoints& query, double distance);

// Whether a contract takes the query. This depends on the kind of its features, and on how they
// lie at t = 0.
bool takes(const Contract& contract, const detector::FourPoints& query);

// The contract under which an answer to a query is judged. Adjacency leaves nothing out of it,
// because the two features of a query are no neighbours.
Contract on_queries(const Contract& contract);

}  // namespace assay::properties
