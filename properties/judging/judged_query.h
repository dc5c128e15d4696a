// An elementary query as the oracle and a contract see it.
#pragma once

#include "detector/contact/four_points.h"
#include "oracle/mesh/step.h"
#include "properties/claims/contract.h"

namespace assay::properties {

// The exact answer to the query alone, in the form of a judgement of its case (query_case.h). A
// contact is one of triangles 0 and 1, by the two features that are asked. Cost:
// oracle/query/contact.h.
oracle::StepJudgement judge_query(const detector::FourPoints& query);

// Whether the two features are not in contact at t = 0, and not nearer there than the distance.
bool start_apart(const detector::FourPoints& query, double distance);

// Whether a contract takes the query. This depends on the kind of its features, and on how they
// lie at t = 0.
bool takes(const Contract& contract, const detector::FourPoints& query);

// The contract under which an answer to a query is judged. Adjacency leaves nothing out of it,
// because the two features of a query are no neighbours.
Contract on_queries(const Contract& contract);

}  // namespace assay::properties
