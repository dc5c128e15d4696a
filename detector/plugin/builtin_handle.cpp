#include "detector/plugin/builtin_handle.h"

#include <atomic>

namespace assay::detector {
namespace {

template <class Function>
std::int32_t guarded(const Function& function) {
  return detector::guarded(function, [] { return ASSAY_OUT_OF_MEMORY; });
}

const assay_description* describe() {
  static const assay_description description = [] {
    assay_description d = {};
    d.name = "built-in as a plug-in";
    d.version = "1";
    d.claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_FIRST_TIME |
               ASSAY_CLAIM_FIRST_PAIRS | ASSAY_CLAIM_ALL_PAIRS | ASSAY_CLAIM_NO_SPURIOUS |
               ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL | ASSAY_CLAIM_COMMIT_FREE |
               ASSAY_CLAIM_PATH_FREE | ASSAY_CLAIM_PROGRESS | ASSAY_CLAIM_WHOLE;
    d.progress = 0.9;
    return d;
  }();
  return &description;
}

// use_threads of the table sets it for all handles made later.
std::atomic<std::uint32_t> threads_to_use = 1;

void use_threads(std::uint32_t count) { threads_to_use = count; }

std::int32_t create(const std::int32_t* triangles, std::uint64_t triangle_count,
                    const double* positions, std::uint64_t vertex_count, assay_handle** handle,
                    const char** message) {
  return guarded([&]() -> std::int32_t {
    assay_builtin_error error;
    assay_builtin_options options = ASSAY_BUILTIN_DEFAULTS;
    options.threads = threads_to_use;
    const auto code = assay_builtin_create(triangles, triangle_count, positions, vertex_count,
                                           &options, handle, &error);
    if (code == ASSAY_REFUSED) *message = assay_builtin_error_name(error.code);
    return code;
  });
}

std::int32_t evaluate(assay_handle* h, const double* x_t0, const double* x_t1) {
  return guarded([&]() -> std::int32_t {
    h->evaluate(x_t0, x_t1);
    return ASSAY_OK;
  });
}

std::int32_t commit(assay_handle* h) {
  return guarded([&]() -> std::int32_t { return h->detector.commit() ? ASSAY_FAILED : ASSAY_OK; });
}

std::int32_t result(assay_handle* h, assay_result* out) {
  switch (h->result.answer) {
    case Answer::free:
      out->answer = ASSAY_FREE;
      break;
    case Answer::collision:
      out->answer = ASSAY_COLLISION;
      break;
    case Answer::undecided:
      out->answer = ASSAY_UNDECIDED;
      break;
    case Answer::error:
      out->answer = ASSAY_ERROR;
      out->message = h->result.problem->message.c_str();
      break;
  }
  out->first_lo = h->result.first.lo;
  out->first_hi = h->result.first.hi;
  out->pair_count = h->result.pairs.size();
  out->pairs = h->pairs.data();
  out->pair_times = h->times.data();
  return ASSAY_OK;
}

std::int32_t limit(assay_handle* h, const double* x_t0, const double* x_t1, assay_limit* out) {
  return assay_builtin_limit(h, x_t0, x_t1, out, nullptr, nullptr, nullptr);
}

void destroy(assay_handle* h) { delete h; }

}  // namespace
}  // namespace assay::detector

using namespace assay::detector;

void assay_handle::evaluate(const double* x_t0, const double* x_t1,
                            std::span<const ViewPrimitive> primitives, const StopFunction& stop) {
  keep(detector.evaluate(PositionsMap(x_t0, vertex_count, 3), PositionsMap(x_t1, vertex_count, 3),
                         primitives, stop));
}

void assay_handle::first_contact(const double* x_t0, const double* x_t1, double until,
                                 const StopFunction& stop) {
  keep(detector.first_contact(PositionsMap(x_t0, vertex_count, 3),
                              PositionsMap(x_t1, vertex_count, 3), until, stop));
}

void assay_handle::keep(StepResult next) {
  std::vector<std::int32_t> next_pairs;
  std::vector<double> next_times;
  next_pairs.reserve(2 * next.pairs.size());
  next_times.reserve(2 * next.pairs.size());
  for (const auto& contact : next.pairs) {
    next_pairs.insert(next_pairs.end(), {contact.pair.a, contact.pair.b});
    next_times.insert(next_times.end(), {contact.time.lo, contact.time.hi});
  }
  result = std::move(next);
  pairs.swap(next_pairs);
  times.swap(next_times);
}

// The table of assay_detector.h for the built-in detector.
const assay_detector_api* assay_builtin_detector() {
  static const assay_detector_api api = [] {
    assay_detector_api table = {};
    table.abi_version = ASSAY_DETECTOR_ABI_VERSION;
    table.describe = describe;
    table.create = create;
    table.evaluate = evaluate;
    table.commit = commit;
    table.result = result;
    table.destroy = destroy;
    table.use_threads = use_threads;
    table.limit = limit;
    return table;
  }();
  return &api;
}
