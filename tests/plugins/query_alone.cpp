// A plug-in with an elementary query alone: the built-in one, or the query of distance if it has a
// separation. Compiled with WITH_STEPS, the query stands beside the built-in detector of whole
// steps. The contract and the faults are words of the environment variable ASSAY_QUERY, such as
// "features=vertex-face miss=edge-edge":
//
//   (those of told.h)                        its description
//   miss=vertex-face, miss=edge-edge         answers free to these queries
//   miss-at-start, miss-inside               answers free when the first contact is at 0, above 0
//   miss-coplanar                            answers free if F is zero throughout
//   late=S, early=S                          its first time is off by S
//   alarm                                    answers collision to every query
//   undecided, error, refuse, no-memory      answers so to every query with a contact
//   changing                                 every third answer differs
//   abort-at-start, burn-at-start=S          aborts, or first uses S seconds of processor time (60
//                                            at most), if the first contact is at 0
//   no-interval, no-answer, nan              gives what is no result
//   abort-outside                            aborts if it gets a query outside of its contract
//   free-above=N, undecided-above=N          answers so to steps of meshes above N triangles
//   up-to=N, from-pairs=N                    ... except above N triangles, or below N pairs
//   free-after-commits=N                     free after a handle has committed more than N steps
//   free-after-calls=N                       free after more than N steps or queries
//   free-again                               free if a step is evaluated a second time
//   free-threaded                            free if it may use several threads
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "detector/contact/elementary.h"
#include "detector/contact/rungs.h"
#include "detector/distance/nearness.h"
#include "tests/plugins/changed_builtin.h"
#include "tests/plugins/told.h"

namespace {

using namespace assay::detector;

const assay::tests::Told told("ASSAY_QUERY");

constexpr std::uint32_t query_claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE |
                                       ASSAY_CLAIM_FIRST_TIME | ASSAY_CLAIM_NO_SPURIOUS |
                                       ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL;
#ifdef WITH_STEPS
constexpr std::uint32_t claims_made =
    query_claims | ASSAY_CLAIM_FIRST_PAIRS | ASSAY_CLAIM_ALL_PAIRS;
#else
constexpr std::uint32_t claims_made = query_claims;
#endif

const assay_description* describe() {
  static const auto description = told.description("query alone", claims_made);
  return &description;
}

bool is_outside(std::int32_t kind, const FourPoints& q, bool at_start) {
  const auto& d = *describe();
  if (d.features == ASSAY_FEATURES_VERTEX_FACE && kind != ASSAY_QUERY_VERTEX_FACE) return true;
  if (d.features == ASSAY_FEATURES_EDGE_EDGE && kind != ASSAY_QUERY_EDGE_EDGE) return true;
  if (d.start == ASSAY_START_FREE && at_start) return true;
  for (const auto& p : q.points) {
    for (const auto& end : {p.t0, p.t1}) {
      for (const double x : end) {
        if (d.coordinates == ASSAY_COORDINATES_FLOAT32 && static_cast<float>(x) != x) return true;
        if (d.largest > 0 && std::abs(x) > d.largest) return true;
      }
    }
  }
  return false;
}

// Of the process, whatever the handle: on purpose.
double calls = 0;
bool is_asked_too_often() {
  return told.has("free-after-calls") && calls > told.number_of("free-after-calls");
}

bool misses(std::int32_t kind, const FourPoints& q, bool at_start) {
  if (told.is("miss", kind == ASSAY_QUERY_VERTEX_FACE ? "vertex-face" : "edge-edge")) return true;
  if (is_asked_too_often()) return true;
  if (told.has("miss-coplanar") && coplanar_throughout(q)) return true;
  return told.has(at_start ? "miss-at-start" : "miss-inside");
}

std::int32_t query(std::int32_t kind, const double* x_t0, const double* x_t1,
                   assay_query_result* out) {
  FourPoints q;
  q.first_group = kind == ASSAY_QUERY_VERTEX_FACE ? 1 : 2;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      q.points[i].t0[k] = x_t0[3 * i + k];
      q.points[i].t1[k] = x_t1[3 * i + k];
    }
  }
  ++calls;
  const double d = describe()->separation;
  const auto found = d > 0 ? test_near(q, d, Want::first_time) : test_contact(q, Want::first_time);
  const bool at_start = found.contact && found.time.hi == 0;
  if (told.has("abort-outside") && is_outside(kind, q, at_start)) std::abort();
  if (told.has("abort-at-start") && at_start) std::abort();
  if (at_start) assay::tests::burn(told.number_of("burn-at-start"));
  const double shift = told.number_of("late") - told.number_of("early");
  if (found.contact && !misses(kind, q, at_start)) {
    out->answer = ASSAY_COLLISION;
    out->first_lo = std::clamp(found.time.lo + shift, 0., 1.);
    out->first_hi = std::clamp(found.time.hi + shift, 0., 1.);
    if (told.has("undecided")) out->answer = ASSAY_UNDECIDED;
    if (told.has("error")) out->answer = ASSAY_ERROR;
    if (told.has("no-interval")) out->first_lo = 2;
    if (told.has("nan")) out->first_lo = std::numeric_limits<double>::quiet_NaN();
    if (told.has("no-answer")) out->answer = 17;
    if (told.has("refuse")) return ASSAY_REFUSED;
    if (told.has("no-memory")) return ASSAY_OUT_OF_MEMORY;
  } else if (told.has("alarm")) {
    out->answer = ASSAY_COLLISION;
    out->first_hi = 1;
  }
  // What is asked twice is answered in two ways.
  const bool is_third = std::fmod(calls, 3) == 0;
  if (told.has("changing") && is_third && out->answer == ASSAY_COLLISION) out->first_lo = 0;
  return ASSAY_OK;
}

#ifdef WITH_STEPS
std::uint64_t triangle_count = 0;
std::uint32_t threads = 1;
std::size_t evaluations = 0;  // since the last commit
double commits = 0;           // since the handle was made

std::int32_t create(const std::int32_t* triangles, std::uint64_t m, const double* x,
                    std::uint64_t n, assay_handle** handle, const char** message) {
  triangle_count = m;
  evaluations = 0;
  commits = 0;
  return assay_builtin_detector()->create(triangles, m, x, n, handle, message);
}

void use_threads(std::uint32_t count) { threads = count; }

std::int32_t evaluate(assay_handle* handle, const double* x_t0, const double* x_t1) {
  ++evaluations;
  ++calls;
  return assay_builtin_detector()->evaluate(handle, x_t0, x_t1);
}

std::int32_t commit(assay_handle* handle) {
  evaluations = 0;
  ++commits;
  return assay_builtin_detector()->commit(handle);
}

bool is_above(const char* word) {
  return told.has(word) && static_cast<double>(triangle_count) > told.number_of(word);
}

bool answers_free(const assay_result& right) {
  if (is_asked_too_often()) return true;
  if (told.has("free-again") && evaluations > 1) return true;
  if (told.has("free-after-commits") && commits > told.number_of("free-after-commits")) return true;
  if (told.has("free-threaded") && threads > 1) return true;
  return is_above("free-above") && !is_above("up-to") &&
         static_cast<double>(right.pair_count) >= told.number_of("from-pairs");
}

std::int32_t result(assay_handle* handle, assay_result* out) {
  const auto code = assay_builtin_detector()->result(handle, out);
  if (code != ASSAY_OK) return code;
  if (is_above("undecided-above")) {
    out->answer = ASSAY_UNDECIDED;
  } else if (answers_free(*out)) {
    *out = {};
  }
  return code;
}
#endif

}  // namespace

const assay_detector_api* assay_detector() {
  return assay::tests::changed_builtin([](assay_detector_api& table) {
#ifdef WITH_STEPS
    table.create = create;
    table.result = result;
    table.evaluate = evaluate;
    table.commit = commit;
    table.use_threads = use_threads;
    table.limit = nullptr;
#else
    table = {};
    table.abi_version = ASSAY_DETECTOR_ABI_VERSION;
#endif
    table.describe = describe;
    table.query = query;
  });
}
