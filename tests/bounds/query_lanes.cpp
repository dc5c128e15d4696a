// Claims about the first rungs of the elementary test in lanes: for vertex and face, for two edges,
// and for piercing. A lane computes the same as a single query, so these claims add no new script.
#include "detector/contact/lanes/query_lanes.cpp"
#define ASSAY_LANES 2
#include "detector/contact/lanes/query_lanes_kernel.h"
#include "tests/bounds/claims.h"
#include "tests/bounds/moving_points.h"

namespace assay::bounds {
namespace {

using namespace detector;
using namespace detector::query_kernel;

// What a group of lanes computes of a query of these points. No group of a query lies before the
// other, so that everything is computed.
void claim(Claims& claims, const char* name, const QueryVertices& query,
           void (*group)(const QueryInput&, const QueryVertices*, LaneRung*)) {
  const auto [x_t0, x_t1] = moving_vertices("x", 5);
  const QueryVertices queries[] = {query, query};
  LaneRung rungs[2];
  group(query_input({x_t0, x_t1}), queries, rungs);
  claims.write_obligations(name);
}

void claim_query_lanes(Claims& claims) {
  claim(claims, "contact", {{1, 0, 2, 3, 4}}, contact_group<1>);
  claim(claims, "contact", {{0, 2, 1, 3, 4}}, contact_group<2>);
  claim(claims, "orientation", {{0, 2, 1, 3, 4}}, piercing_group);
}

const Filter filter("query_lanes", claim_query_lanes);

}  // namespace
}  // namespace assay::bounds
