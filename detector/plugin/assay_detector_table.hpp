// Makes the C interface's table of functions for a class: each function of the table calls the
// class in C++. assay_detector.hpp includes this file and says which functions a class may have; do
// not include this file alone. A class can be tested without loading a library:
//
//   const assay_detector_api* detector = assay::plugin::detail::table<Mine>();
//   if (detector->create(triangles, m, positions, n, &handle, &message) != ASSAY_OK)
//     return report(message);
//   use(detector->evaluate(handle, x_t0, x_t1));
//   detector->destroy(handle);
#ifndef ASSAY_DETECTOR_TABLE_HPP
#define ASSAY_DETECTOR_TABLE_HPP

#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <type_traits>

#include "detector/plugin/assay_detector.hpp"

namespace assay {
namespace plugin {
namespace detail {

static_assert(sizeof(Pair) == 2 * sizeof(std::int32_t), "a Pair must be two integers");
static_assert(sizeof(Interval) == 2 * sizeof(double), "an Interval must be two doubles");

// One line of text that needs no memory from the heap, because there may be none left.
class Line {
 public:
  void clear() { text_[0] = 0; }
  void set(const char* what) noexcept {
    std::strncpy(text_, *what ? what : "an exception without a text", sizeof text_ - 1);
    for (char* c = text_; *c; ++c) *c = *c == '\n' || *c == '\r' ? ' ' : *c;
  }
  bool empty() const { return !text_[0]; }
  const char* c_str() const { return text_; }

 private:
  char text_[512] = {};
};

// Calls work(), which may throw. Turns an exception into a return code, and puts its text into
// `line`.
template <class Work>
std::int32_t guarded(Line& line, const Work& work) noexcept {
  try {
    work();
    return ASSAY_OK;
  } catch (const std::bad_alloc&) {
    line.set("out of memory");
    return ASSAY_OUT_OF_MEMORY;
  } catch (const Refused& refused) {
    line.set(refused.what());
    return ASSAY_REFUSED;
  } catch (const BeyondCapacity& beyond) {
    line.set(beyond.what());
    return ASSAY_BEYOND_CAPACITY;
  } catch (const std::exception& thrown) {
    line.set(thrown.what());
  } catch (...) {
    line.set("an exception that is no std::exception");
  }
  return ASSAY_FAILED;
}

// Returns the text of the last call in this thread that failed, of any function in the table.
template <class D>
Line& last_line() {
  static thread_local Line line;
  return line;
}

template <class D>
const char* error_text() noexcept {
  return last_line<D>().empty() ? nullptr : last_line<D>().c_str();
}

// names_NAME<D> says whether D has a member named NAME, and has_NAME<D> says whether this member
// can be called as the interface calls it.
#define ASSAY_PLUGIN_FINDS(NAME, CALL)                                         \
  template <class D, class = void>                                             \
  struct names_##NAME : std::false_type {};                                    \
  template <class D>                                                           \
  struct names_##NAME<D, std::void_t<decltype(&D::NAME)>> : std::true_type {}; \
  template <class D, class = void>                                             \
  struct has_##NAME : std::false_type {};                                      \
  template <class D>                                                           \
  struct has_##NAME<D, std::void_t<decltype(CALL)>> : std::true_type {}
ASSAY_PLUGIN_FINDS(evaluate, Result(std::declval<D&>().evaluate(std::declval<Positions>(),
                                                                std::declval<Positions>())));
ASSAY_PLUGIN_FINDS(commit, std::declval<D&>().commit());
ASSAY_PLUGIN_FINDS(use_threads, D::use_threads(std::uint32_t()));
ASSAY_PLUGIN_FINDS(query, Result(D::query(std::int32_t(), std::declval<Positions>(),
                                          std::declval<Positions>())));
ASSAY_PLUGIN_FINDS(candidates,
                   std::vector<Pair>(std::declval<D&>().candidates(std::declval<Positions>(),
                                                                   std::declval<Positions>())));
ASSAY_PLUGIN_FINDS(count, std::declval<D&>().count(std::declval<const CountedPairs&>()));
ASSAY_PLUGIN_FINDS(limit, Limit(std::declval<D&>().limit(std::declval<Positions>(),
                                                         std::declval<Positions>())));
#undef ASSAY_PLUGIN_FINDS

template <class D>
struct Handle {
  explicit Handle(const Mesh& mesh) : vertices(mesh.positions.size()), detector(mesh) {}
  static Handle& of(assay_handle* handle) { return *reinterpret_cast<Handle*>(handle); }

  std::size_t vertices;
  D detector;
  Result result;
  std::vector<Pair> candidates;
  Limit limit;
  Line line;  // text of the exception that the last evaluate() threw; empty if it threw none
};

template <class D>
const assay_description* describe() noexcept {
  static assay_description c = {};
  static const std::int32_t code = guarded(last_line<D>(), [] { c = D::describe(); });
  return code == ASSAY_OK ? &c : nullptr;
}

template <class D>
std::int32_t create(const std::int32_t* triangles, std::uint64_t triangle_count,
                    const double* positions, std::uint64_t vertex_count, assay_handle** handle,
                    const char** message) noexcept {
  auto& line = last_line<D>();
  const std::int32_t code = guarded(line, [&] {
    const Mesh mesh = {{triangles, static_cast<std::size_t>(triangle_count)},
                       {positions, static_cast<std::size_t>(vertex_count)}};
    *handle = reinterpret_cast<assay_handle*>(std::make_unique<Handle<D>>(mesh).release());
  });
  if (code != ASSAY_OK) *message = line.c_str();
  return code;
}

template <class D>
std::int32_t evaluate(assay_handle* handle, const double* x_t0, const double* x_t1) noexcept {
  auto& h = Handle<D>::of(handle);
  h.line.clear();
  h.result = Result();
  const std::int32_t code = guarded(h.line, [&] {
    h.result = h.detector.evaluate({x_t0, h.vertices}, {x_t1, h.vertices});
  });
  // result() reports all other exceptions, with their texts.
  if (code == ASSAY_BEYOND_CAPACITY) last_line<D>() = h.line;
  return code == ASSAY_OUT_OF_MEMORY || code == ASSAY_BEYOND_CAPACITY ? code : ASSAY_OK;
}

template <class D>
std::int32_t commit(assay_handle* handle) noexcept {
  if constexpr (has_commit<D>::value) {
    return guarded(last_line<D>(), [&] { Handle<D>::of(handle).detector.commit(); });
  } else {
    return static_cast<void>(handle), ASSAY_OK;
  }
}

template <class D>
std::int32_t result(assay_handle* handle, assay_result* out) noexcept {
  const auto& h = Handle<D>::of(handle);
  if (!h.line.empty()) {
    out->answer = ASSAY_ERROR;
    out->message = h.line.c_str();
    return ASSAY_OK;
  }
  out->answer = h.result.answer;
  out->first_lo = h.result.first[0];
  out->first_hi = h.result.first[1];
  out->pair_count = h.result.pairs.size();
  if (!h.result.pairs.empty()) {
    out->pairs = h.result.pairs.front().data();
    if (h.result.pair_times.size() == h.result.pairs.size())
      out->pair_times = h.result.pair_times.front().data();
  }
  if (h.result.answer == ASSAY_ERROR) out->message = h.result.text.c_str();
  return ASSAY_OK;
}

template <class D>
void destroy(assay_handle* handle) noexcept {
  Line line;
  guarded(line, [&] { delete &Handle<D>::of(handle); });
}

template <class D>
void use_threads(std::uint32_t count) noexcept {
  guarded(last_line<D>(), [&] { D::use_threads(count); });
}

template <class D>
std::int32_t query(std::int32_t kind, const double* x_t0, const double* x_t1,
                   assay_query_result* out) noexcept {
  auto& line = last_line<D>();
  line.clear();
  return guarded(line, [&] {
    const Result found = D::query(kind, {x_t0, 4}, {x_t1, 4});
    out->answer = found.answer;
    out->first_lo = found.first[0];
    out->first_hi = found.first[1];
    if (found.answer == ASSAY_ERROR) line.set(found.text.c_str());
  });
}

template <class D>
std::int32_t candidates(assay_handle* handle, const double* x_t0, const double* x_t1,
                        assay_candidates* out) noexcept {
  auto& h = Handle<D>::of(handle);
  return guarded(last_line<D>(), [&] {
    h.candidates.clear();
    h.candidates = h.detector.candidates({x_t0, h.vertices}, {x_t1, h.vertices});
    out->pair_count = h.candidates.size();
    if (!h.candidates.empty()) out->pairs = h.candidates.front().data();
  });
}

template <class D>
std::int32_t count(assay_handle* handle, const assay_counted_pairs* counted) noexcept {
  return guarded(last_line<D>(), [&] { Handle<D>::of(handle).detector.count(*counted); });
}

template <class D>
std::int32_t limit(assay_handle* handle, const double* x_t0, const double* x_t1,
                   assay_limit* out) noexcept {
  auto& h = Handle<D>::of(handle);
  return guarded(last_line<D>(), [&] {
    h.limit = h.detector.limit({x_t0, h.vertices}, {x_t1, h.vertices});
    if (!h.limit.positions.empty() && h.limit.positions.size() != 3 * h.vertices)
      throw std::runtime_error("limit() gives positions for a wrong number of vertices");
    out->share = h.limit.share;
    if (!h.limit.positions.empty()) out->positions = h.limit.positions.data();
  });
}

// Returns the table of a class. If a member has the name of an optional function, it must be
// callable as this function, because it would otherwise be left out silently.
template <class D>
const assay_detector_api* table() {
  static_assert(has_evaluate<D>::value || !names_evaluate<D>::value,
                "declare Result evaluate(Positions x_t0, Positions x_t1)");
  static_assert(has_commit<D>::value || !names_commit<D>::value, "declare void commit()");
  static_assert(has_use_threads<D>::value || !names_use_threads<D>::value,
                "declare static void use_threads(std::uint32_t count)");
  static_assert(has_query<D>::value || !names_query<D>::value,
                "declare static Result query(std::int32_t kind, Positions x_t0, Positions x_t1)");
  static_assert(has_candidates<D>::value || !names_candidates<D>::value,
                "declare std::vector<Pair> candidates(Positions x_t0, Positions x_t1)");
  static_assert(has_limit<D>::value || !names_limit<D>::value,
                "declare Limit limit(Positions x_t0, Positions x_t1)");
  static_assert(has_evaluate<D>::value || has_query<D>::value || has_candidates<D>::value ||
                    has_limit<D>::value,
                "a detector needs evaluate(), query(), candidates() or limit()");
  static_assert(has_count<D>::value || !names_count<D>::value,
                "declare void count(const CountedPairs& counted)");
  static_assert(has_evaluate<D>::value || !has_commit<D>::value, "commit() needs evaluate()");
  static const assay_detector_api api = [] {
    assay_detector_api functions = {};
    functions.abi_version = ASSAY_DETECTOR_ABI_VERSION;
    functions.describe = &detail::describe<D>;
    functions.error_text = &detail::error_text<D>;
    if constexpr (has_evaluate<D>::value || has_candidates<D>::value || has_limit<D>::value) {
      functions.create = &detail::create<D>;
      functions.destroy = &detail::destroy<D>;
    }
    if constexpr (has_evaluate<D>::value) {
      functions.evaluate = &detail::evaluate<D>;
      functions.commit = &detail::commit<D>;
      functions.result = &detail::result<D>;
    }
    if constexpr (has_count<D>::value) functions.count = &detail::count<D>;
    if constexpr (has_use_threads<D>::value) functions.use_threads = &detail::use_threads<D>;
    if constexpr (has_query<D>::value) functions.query = &detail::query<D>;
    if constexpr (has_candidates<D>::value) functions.candidates = &detail::candidates<D>;
    if constexpr (has_limit<D>::value) functions.limit = &detail::limit<D>;
    return functions;
  }();
  return &api;
}

}  // namespace detail
}  // namespace plugin
}  // namespace assay

#endif
