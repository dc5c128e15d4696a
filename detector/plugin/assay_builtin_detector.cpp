#include "detector/plugin/assay_builtin_detector.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <limits>
#include <new>

#include "detector/contact_place.h"
#include "detector/plugin/builtin_handle.h"

namespace assay::detector {
namespace {

static_assert(sizeof(assay_view_primitive) == sizeof(ViewPrimitive));

void tell(assay_builtin_error* error, std::int32_t code, const char* message) {
  if (!error) return;
  error->code = code;
  const std::size_t length = std::min(std::strlen(message), sizeof(error->message) - 1);
  std::memcpy(error->message, message, length);
  error->message[length] = 0;
}

std::int32_t done(assay_builtin_error* error) {
  tell(error, ASSAY_BUILTIN_NO_ERROR, "");
  return ASSAY_OK;
}

std::int32_t refuse(assay_builtin_error* error, std::int32_t code, const char* message) {
  tell(error, code, message);
  return ASSAY_REFUSED;
}

std::int32_t refuse(assay_builtin_error* error, const Problem& problem) {
  return refuse(error, static_cast<std::int32_t>(problem.error), problem.message.c_str());
}

// Calls function(), and says so if memory runs out. The built-in detector throws nothing but
// std::bad_alloc, so no exception crosses the border to C.
template <class Function>
std::int32_t guarded(assay_builtin_error* error, const Function& function) {
  try {
    return function();
  } catch (const std::bad_alloc&) {
    tell(error, ASSAY_BUILTIN_NO_MEMORY, "not enough memory");
    return ASSAY_OUT_OF_MEMORY;
  }
}

StopFunction stop_function(std::int32_t (*stop)(void* stop_data), void* stop_data) {
  if (!stop) return {};
  return [=] { return stop(stop_data) != 0; };
}

// Sets `choice` to the value with this number. False, and nothing is set, if there is none.
template <class Enum>
bool choose(Enum& choice, std::int32_t number) {
  const auto value = from_number<Enum>(number);
  if (value) choice = *value;
  return value.has_value();
}

// Copies the given options. Returns what is wrong with them, or null. The numbers of the C
// interface are those of the enumerations in C++.
const char* read_options(const assay_builtin_options& input, Options& options) {
  constexpr std::size_t size_before_separation = offsetof(assay_builtin_options, separation);
  if (input.struct_size != sizeof input && input.struct_size != size_before_separation)
    return "`struct_size` is not the size of assay_builtin_options";
  if (!choose(options.culling, input.culling)) return "`culling` has an unknown value";
  if (!choose(options.start, input.start)) return "`start` has an unknown value";
  if (!choose(options.pairs, input.pairs)) return "`pairs` has an unknown value";
  if (!choose(options.arithmetic, input.arithmetic)) return "`arithmetic` has an unknown value";
  options.threads = input.threads;
  if (input.struct_size == sizeof input) options.separation = input.separation;
  return nullptr;
}

// The functions of the table.

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
  return guarded(nullptr, [&]() -> std::int32_t {
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
  return guarded(nullptr, [&]() -> std::int32_t {
    h->evaluate(x_t0, x_t1);
    return ASSAY_OK;
  });
}

std::int32_t commit(assay_handle* h) {
  return guarded(nullptr,
                 [&]() -> std::int32_t { return h->detector.commit() ? ASSAY_FAILED : ASSAY_OK; });
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

// Returns the table of assay_detector.h for the built-in detector.
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

const char* assay_builtin_error_name(std::int32_t code) {
  switch (code) {
    case ASSAY_BUILTIN_NO_ERROR:
      return "no_error";
    case ASSAY_BUILTIN_WRONG_OPTIONS:
      return "wrong_options";
    case ASSAY_BUILTIN_TOO_MANY:
      return "too_many";
    case ASSAY_BUILTIN_NO_MEMORY:
      return "no_memory";
    default:
      const auto error = assay::from_number<InputError>(code);
      return error ? name_of(*error) : "unknown_error";
  }
}

std::int32_t assay_builtin_create(const std::int32_t* triangles, std::uint64_t triangle_count,
                                  const double* positions, std::uint64_t vertex_count,
                                  const assay_builtin_options* input, assay_handle** handle,
                                  assay_builtin_error* error) {
  return guarded(error, [&]() -> std::int32_t {
    Options options;
    if (const char* wrong = input ? read_options(*input, options) : nullptr)
      return refuse(error, ASSAY_BUILTIN_WRONG_OPTIONS, wrong);
    constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
    if (triangle_count > most || vertex_count > most)
      return refuse(error, ASSAY_BUILTIN_TOO_MANY, "more than 2^31 - 1 triangles or vertices");
    const auto m = static_cast<Eigen::Index>(triangle_count);
    const auto n = static_cast<Eigen::Index>(vertex_count);
    auto result =
        Detector::create(TrianglesMap(triangles, m, 3), PositionsMap(positions, n, 3), options);
    if (!result) return refuse(error, result.error());
    *handle = new assay_handle{std::move(result.value()), n};
    return done(error);
  });
}

std::int32_t assay_builtin_evaluate(assay_handle* handle, const double* x_t0, const double* x_t1,
                                    const assay_view_primitive* primitives,
                                    std::uint64_t primitive_count,
                                    std::int32_t (*stop)(void* stop_data), void* stop_data,
                                    assay_builtin_error* error) {
  return guarded(error, [&]() -> std::int32_t {
    if (primitive_count > std::max<std::uint64_t>(1, handle->detector.topology().components.size()))
      return refuse(error, ASSAY_BUILTIN_WRONG_PRIMITIVE_COUNT,
                    "there are more view primitives than components");
    std::vector<ViewPrimitive> views(static_cast<std::size_t>(primitive_count));
    if (!views.empty()) std::memcpy(views.data(), primitives, views.size() * sizeof views[0]);
    handle->evaluate(x_t0, x_t1, views, stop_function(stop, stop_data));
    return handle->result.problem ? refuse(error, *handle->result.problem) : done(error);
  });
}

std::int32_t assay_builtin_first_contact(assay_handle* handle, const double* x_t0,
                                         const double* x_t1, double until,
                                         std::int32_t (*stop)(void* stop_data), void* stop_data,
                                         assay_builtin_error* error) {
  return guarded(error, [&]() -> std::int32_t {
    handle->first_contact(x_t0, x_t1, until, stop_function(stop, stop_data));
    return handle->result.problem ? refuse(error, *handle->result.problem) : done(error);
  });
}

std::int32_t assay_builtin_limit(assay_handle* handle, const double* x_t0, const double* x_t1,
                                 assay_limit* limit, std::int32_t (*stop)(void* stop_data),
                                 void* stop_data, assay_builtin_error* error) {
  return guarded(error, [&]() -> std::int32_t {
    const Eigen::Index n = handle->vertex_count;
    handle->limit = handle->detector.limit(PositionsMap(x_t0, n, 3), PositionsMap(x_t1, n, 3),
                                           stop_function(stop, stop_data));
    if (handle->limit.problem) return refuse(error, *handle->limit.problem);
    *limit = {handle->limit.share, handle->limit.positions.data()};
    return done(error);
  });
}

std::int32_t assay_builtin_limit_is_short(const assay_handle* handle) {
  return handle->limit.is_short ? 1 : 0;
}

std::int32_t assay_builtin_place(const assay_handle* handle, const double* x_t0, const double* x_t1,
                                 std::uint64_t pair, assay_contact_place* place) {
  if (pair >= handle->result.pairs.size()) return 0;
  auto contact = handle->result.pairs[pair];
  const auto& mesh = handle->detector.topology().triangles;
  Eigen::Matrix<std::int32_t, 2, 3, Eigen::RowMajor> two;
  for (int k = 0; k < 3; ++k) {
    two(0, k) = mesh[at(contact.pair.a)][static_cast<std::size_t>(k)];
    two(1, k) = mesh[at(contact.pair.b)][static_cast<std::size_t>(k)];
  }
  contact.pair = {0, 1};
  const auto n = handle->vertex_count;
  const PositionsMap from(x_t0, n, 3), to(x_t1, n, 3);
  const auto found = contact_place({from, to}, two, contact);
  *place = {};
  std::copy(found.point.begin(), found.point.end(), place->point);
  for (std::size_t side = 0; side < 2; ++side)
    std::copy(found.barycentric[side].begin(), found.barycentric[side].end(),
              place->barycentric[side]);
  place->error = found.error;
  if (found.normal) std::copy(found.normal->begin(), found.normal->end(), place->normal);
  place->normal_error = found.normal_error;
  return 1;
}

std::int32_t assay_builtin_commit(assay_handle* handle, assay_builtin_error* error) {
  return guarded(error, [&]() -> std::int32_t {
    const auto problem = handle->detector.commit();
    return problem ? refuse(error, *problem) : done(error);
  });
}

void assay_builtin_get_sets(const assay_handle* handle, assay_builtin_sets* sets) {
  const StepResult& result = handle->result;
  *sets = {result.view_positive, result.view_negative, result.view_zero, result.against_all,
           result.violated,      result.dirty,         nullptr};
  if (!result.doubts.empty()) sets->doubts = result.doubts.data();
}

void assay_builtin_reset(assay_handle* handle) { handle->detector.reset(); }
