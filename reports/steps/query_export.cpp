#include "reports/steps/query_export.h"

#include <fmt/format.h>

#include "properties/worker/plugin/query_case.h"
#include "reports/steps/opened_plugin.h"
#include "reports/steps/owner_export.h"
#include "reports/terminal/joined.h"

namespace assay::reports {
namespace {

std::string points_text(const detector::FourPoints& query,
                        detector::Point detector::MovingPoint::*at) {
  std::string out;
  for (const auto& moving : query.points) {
    const auto& p = moving.*at;
    out += fmt::format("    {{{}, {}, {}}},\n", p[0], p[1], p[2]);
  }
  return out;
}

constexpr const char* query_head = R"(#include <cstdio>

// A vertex and the three corners of a face, or the two ends of one edge and the two of another.
static const bool is_vertex_face = {};

// Where these four points are at both ends of the step; within it they move along straight lines.
static const double x_t0[4][3] = {{
{}}};
static const double x_t1[4][3] = {{
{}}};

// Whether the two features meet during the step. The first contact time t* is `lo` where lo and hi
// are one number, else strictly between the two, which are adjacent doubles.
static const bool collision = {};
static const double lo = {}, hi = {};
static const char *const lo_as_fraction = "{}", *const hi_as_fraction = "{}";

static const double time_tolerance = {};
)";

constexpr const char* query_tail = R"(
static const char* answer(bool is_collision) { return is_collision ? "collision" : "free"; }

#ifndef CASE_ARRAYS_ONLY

struct Found {
  bool filled_in, collision;
  double time;  // its lower end, where it is an interval
};

// To be filled in: the answer of your detector's query.
static Found ask_your_query() {
  (void)x_t0, (void)x_t1, (void)is_vertex_face;
  return {false, false, 0};
}

int main() {
  const Found found = ask_your_query();
  if (!found.filled_in) {
    std::printf("fill in ask_your_query()\n");
    return 2;
  }
  const bool is_late = collision && found.collision && found.time > lo + time_tolerance;
  if (found.collision == collision && !is_late) return 0;
  std::printf("answered %s at %.17g, exact %s at [%.17g, %.17g] (%s, %s)\n",
              answer(found.collision), found.time, answer(collision), lo, hi, lo_as_fraction,
              hi_as_fraction);
  return 1;
}

#endif
)";

constexpr const char* query_plugin =
    R"(  if (api->abi_version < 2 || !api->query) {
    std::printf("%s: it has no query\n", argv[1]);
    return 2;
  }
  const unsigned claims = api->describe()->claims;
  assay_query_result found = {};
  if (api->query(is_vertex_face ? ASSAY_QUERY_VERTEX_FACE : ASSAY_QUERY_EDGE_EDGE, &x_t0[0][0],
                 &x_t1[0][0], &found) != ASSAY_OK) {
    std::printf("the call failed\n");
    return 1;
  }
  const bool is_collision = found.answer == ASSAY_COLLISION;
  const bool is_missed = (claims & ASSAY_CLAIM_FREE_SOUND) && collision && !is_collision;
  const bool is_alarm = (claims & ASSAY_CLAIM_NO_SPURIOUS) && !collision && is_collision;
  const bool is_late = (claims & ASSAY_CLAIM_NOT_LATE) && collision && is_collision &&
                       found.first_lo > lo + time_tolerance;
  if (!is_missed && !is_alarm && !is_late) return 0;
  std::printf("answered %s at [%.17g, %.17g], exact %s at [%.17g, %.17g] (%s, %s)\n",
              answer(is_collision), found.first_lo, found.first_hi, answer(collision), lo, hi,
              lo_as_fraction, hi_as_fraction);
  return 1;
}
)";

}  // namespace

std::string plain_query_text(const corpus::Case& c, const properties::Contract& contract,
                             const oracle::StepJudgement& truth) {
  const auto query = *properties::query_of(c);
  const bool is_collision = !truth.pairs.empty();
  const auto time = is_collision ? truth.pairs.front().time : detector::TimeEnclosure{};
  const auto phrases = phrases_of(contract);
  std::string out = fmt::format("// Query {}, with its exact answer.\n// Contract: {}.\n", c.id,
                                phrases.empty() ? "leaves nothing out" : joined(phrases, ", "));
  out += fmt::format(fmt::runtime(query_head), query.first_group == 1,
                     points_text(query, &detector::MovingPoint::t0),
                     points_text(query, &detector::MovingPoint::t1), is_collision, time.lo, time.hi,
                     fraction_of(time.lo), fraction_of(time.hi), contract.time_tolerance);
  return out + query_tail;
}

std::string plugin_query_text() { return opened_plugin("query") + query_plugin; }

}  // namespace assay::reports
