#include "detector/plugin/assay_builtin_detector.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>

#include "detector/contact_place.h"
#include "detector/plugin/builtin_handle.h"
#include "detector/state/state_bytes.h"

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

template <class Function>
std::int32_t guarded(assay_builtin_error* error, const Function& function) {
  return detector::guarded(function, [&] {
    tell(error, ASSAY_BUILTIN_NO_MEMORY, "not enough memory");
    return ASSAY_OUT_OF_MEMORY;
  });
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
const char* read_options(const assay_builtin_options& given, Options& options) {
  constexpr std::size_t size_before_separation = offsetof(assay_builtin_options, separation);
  if (given.struct_size != sizeof given && given.struct_size != size_before_separation)
    return "struct_size is not the size of the options";
  if (!choose(options.culling, given.culling)) return "no such culling";
  if (!choose(options.start, given.start)) return "no such start";
  if (!choose(options.pairs, given.pairs)) return "no such choice of pairs";
  if (!choose(options.arithmetic, given.arithmetic)) return "no such arithmetic";
  options.threads = given.threads;
  if (given.struct_size == sizeof given) options.separation = given.separation;
  return nullptr;
}

}  // namespace
}  // namespace assay::detector

using namespace assay::detector;

const char* assay_builtin_error_name(std::int32_t code) {
  switch (code) {
    case ASSAY_BUILTIN_NO_ERROR:
      return "no_error";
    case ASSAY_BUILTIN_WRONG_OPTIONS:
      return "wrong_options";
    case ASSAY_BUILTIN_SMALL_BUFFER:
      return "small_buffer";
    case ASSAY_BUILTIN_TOO_MANY:
      return "too_many";
    case ASSAY_BUILTIN_NO_MEMORY:
      return "no_memory";
    default:
      const auto known = assay::from_number<InputError>(code);
      return known ? name_of(*known) : "unknown_error";
  }
}

std::int32_t assay_builtin_create(const std::int32_t* triangles, std::uint64_t triangle_count,
                                  const double* positions, std::uint64_t vertex_count,
                                  const assay_builtin_options* given, assay_handle** handle,
                                  assay_builtin_error* error) {
  return guarded(error, [&]() -> std::int32_t {
    Options options;
    if (const char* wrong = given ? read_options(*given, options) : nullptr)
      return refuse(error, ASSAY_BUILTIN_WRONG_OPTIONS, wrong);
    constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
    if (triangle_count > most || vertex_count > most)
      return refuse(error, ASSAY_BUILTIN_TOO_MANY, "more than 2^31 - 1 triangles or vertices");
    const auto m = static_cast<Eigen::Index>(triangle_count);
    const auto n = static_cast<Eigen::Index>(vertex_count);
    auto made =
        Detector::create(TrianglesMap(triangles, m, 3), PositionsMap(positions, n, 3), options);
    if (!made) return refuse(error, made.error());
    *handle = new assay_handle{std::move(made.value()), n};
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
                    "more view primitives than components");
    std::vector<ViewPrimitive> given(static_cast<std::size_t>(primitive_count));
    if (!given.empty()) std::memcpy(given.data(), primitives, given.size() * sizeof given[0]);
    StopFunction stops;
    if (stop) stops = [=] { return stop(stop_data) != 0; };
    handle->evaluate(x_t0, x_t1, given, stops);
    return handle->result.problem ? refuse(error, *handle->result.problem) : done(error);
  });
}

std::int32_t assay_builtin_first_contact(assay_handle* handle, const double* x_t0,
                                         const double* x_t1, double until,
                                         std::int32_t (*stop)(void* stop_data), void* stop_data,
                                         assay_builtin_error* error) {
  return guarded(error, [&]() -> std::int32_t {
    StopFunction stops;
    if (stop) stops = [=] { return stop(stop_data) != 0; };
    handle->first_contact(x_t0, x_t1, until, stops);
    return handle->result.problem ? refuse(error, *handle->result.problem) : done(error);
  });
}

std::int32_t assay_builtin_limit(assay_handle* handle, const double* x_t0, const double* x_t1,
                                 assay_limit* limit, std::int32_t (*stop)(void* stop_data),
                                 void* stop_data, assay_builtin_error* error) {
  return guarded(error, [&]() -> std::int32_t {
    StopFunction stops;
    if (stop) stops = [=] { return stop(stop_data) != 0; };
    const Eigen::Index n = handle->vertex_count;
    handle->limit =
        handle->detector.limit(PositionsMap(x_t0, n, 3), PositionsMap(x_t1, n, 3), stops);
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
  const auto& mesh = handle->detector.surface().mesh.triangles;
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

std::int32_t assay_builtin_save(const assay_handle* handle, void* buffer, std::uint64_t capacity,
                                std::uint64_t* size, assay_builtin_error* error) {
  return guarded(error, [&]() -> std::int32_t {
    const SavedState saved = handle->detector.state();
    const StateFields& state = saved.fields();
    *size = state_size(state);
    if (!buffer) return done(error);
    if (capacity < *size)
      return refuse(error, ASSAY_BUILTIN_SMALL_BUFFER, "the buffer is smaller than the state");
    write_state(state, {static_cast<std::uint8_t*>(buffer), static_cast<std::size_t>(*size)});
    return done(error);
  });
}

std::int32_t assay_builtin_restore(assay_handle* handle, const void* bytes, std::uint64_t size,
                                   assay_builtin_error* error) {
  return guarded(error, [&]() -> std::int32_t {
    auto state =
        read_state({static_cast<const std::uint8_t*>(bytes), static_cast<std::size_t>(size)});
    if (!state) return refuse(error, state.error());
    if (const auto problem = handle->detector.restore(SavedState(std::move(state.value()))))
      return refuse(error, *problem);
    return done(error);
  });
}
