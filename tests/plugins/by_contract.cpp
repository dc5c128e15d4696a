// A detector by brute force whose contract and faults are words of the environment variable
// ASSAY_BY_CONTRACT, such as "start=free miss-at-start": faults that the contract excuses, others.
//
//   start=free, start=apart:D, range=LO:HI, features=vertex-face, features=edge-edge, tolerance=T,
//   margin=D, no-pairs, adjacency=NUMBER, float32,
//   claims=BITS                              its description
//   strangers                                the same as adjacency=2
//   miss-at-start, miss-inside               answers free when the first contact is at 0, above 0
//   miss=vertex-face, miss=edge-edge         does not test these
//   late=S, early=S                          its first time, and those of its pairs, off by S
//   alarm=N                                  answers collision in one of N free steps
//   alarm-share=P                            the same in a share of them, by the coordinates
//   burn=S                                   S seconds where the first time is a double above 0
//   abort-outside                            aborts when a step of the wrong contract is put to it
//   abort                                    aborts in every step
//   whenever                                 collision at [0, 1] in every step
//   with-pairs                               gives pairs, whatever it says
//   drop-last                                does not report its last pair
//   no-interval                              its first time is none
//   changing                                 the interval of every second first time ends at 1
//   print=N                                  prints N lines a step, with an escape character
#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "detector/contact/elementary.h"
#include "detector/plugin/assay_detector.h"

namespace {

using namespace assay::detector;

// The word's value, or nothing; "" for a word without one.
const char* value_of(const char* name) {
  static const std::vector<std::string> words = [] {
    const char* given = std::getenv("ASSAY_BY_CONTRACT");
    std::istringstream in(given ? given : "");
    std::vector<std::string> list;
    for (std::string word; in >> word;) list.push_back(word);
    return list;
  }();
  const std::size_t length = std::strlen(name);
  for (const auto& word : words) {
    if (word == name) return "";
    if (word.starts_with(name) && word[length] == '=') return word.c_str() + length + 1;
  }
  return nullptr;
}
bool has(const char* name) { return value_of(name) != nullptr; }
bool is(const char* name, const char* value) {
  const char* found = value_of(name);
  return found && std::strcmp(found, value) == 0;
}
double number(const char* text) { return text ? std::strtod(text, nullptr) : 0; }
double number_of(const char* name) { return number(value_of(name)); }

assay_description described() {
  assay_description d = {};
  d.name = "by contract";
  d.version = "1";
  d.claims = (ASSAY_CLAIM_TOTAL << 1) - 1;
  if (has("claims")) d.claims = static_cast<std::uint32_t>(number_of("claims"));
  d.margin = number_of("margin");
  if (has("strangers")) d.adjacency = ASSAY_ADJACENCY_NO_SHARED_VERTEX;
  if (is("start", "free")) d.start = ASSAY_START_FREE;
  if (const char* start = value_of("start"); start && std::strncmp(start, "apart:", 6) == 0) {
    d.start = ASSAY_START_APART;
    d.start_distance = number(start + 6);
  }
  if (const char* range = value_of("range")) {
    d.least_nonzero = number(range);
    d.largest = number(std::strchr(range, ':') + 1);
  }
  if (is("features", "vertex-face")) d.features = ASSAY_FEATURES_VERTEX_FACE;
  if (is("features", "edge-edge")) d.features = ASSAY_FEATURES_EDGE_EDGE;
  if (has("adjacency")) d.adjacency = static_cast<std::int32_t>(number_of("adjacency"));
  if (has("float32")) d.coordinates = ASSAY_COORDINATES_FLOAT32;
  d.time_tolerance = number_of("tolerance");
  d.reports = has("no-pairs") ? ASSAY_REPORTS_NO_PAIRS : ASSAY_REPORTS_PAIRS;
  return d;
}

const assay_description& description() {
  static const assay_description d = described();
  return d;
}

}  // namespace

struct assay_handle {
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::size_t vertices = 0;
  const double *x_t0 = nullptr, *x_t1 = nullptr;  // of the step under way
  bool collision = false;
  double lo = 0, hi = 1;
  std::vector<std::int32_t> pairs;
  std::vector<double> times;
  std::uint64_t free_steps = 0;

  MovingPoint path(std::int32_t v) const {
    const auto at = [v](const double* x) { return Point{x[3 * v], x[3 * v + 1], x[3 * v + 2]}; };
    return {at(x_t0), at(x_t1)};
  }

  // Whether the contract's adjacency leaves these two out.
  static bool leaves_out(const std::array<std::int32_t, 3>& s,
                         const std::array<std::int32_t, 3>& t) {
    const auto shared = std::count_if(s.begin(), s.end(), [&](std::int32_t v) {
      return std::find(t.begin(), t.end(), v) != t.end();
    });
    const auto adjacency = description().adjacency;
    return adjacency != ASSAY_ADJACENCY_ALL &&
           shared > (adjacency == ASSAY_ADJACENCY_NOT_EDGE_SHARING ? 1 : 0);
  }

  void earliest(const FourPoints& query, TimeEnclosure& first) const {
    const auto found = test_contact(query, Want::first_time);
    if (found.contact && found.time < first) first = found.time;
  }

  // The first contact of two triangles; later than any where there is none.
  TimeEnclosure first_contact(const std::array<std::int32_t, 3>& s,
                              const std::array<std::int32_t, 3>& t) const {
    TimeEnclosure first{2, 2};
    const bool vertex_face =
        description().features != ASSAY_FEATURES_EDGE_EDGE && !is("miss", "vertex-face");
    const bool edge_edge =
        description().features != ASSAY_FEATURES_VERTEX_FACE && !is("miss", "edge-edge");
    const auto meets = [](const auto& features, std::int32_t v) {
      return std::find(features.begin(), features.end(), v) != features.end();
    };
    for (const auto* order : {"st", "ts"}) {
      const auto &of = order[0] == 's' ? s : t, &face = order[0] == 's' ? t : s;
      for (int i = 0; i < 3; ++i) {
        if (vertex_face && !meets(face, of[i]))
          earliest({{path(of[i]), path(face[0]), path(face[1]), path(face[2])}, 1}, first);
        const std::array<std::int32_t, 2> a = {of[i], of[(i + 1) % 3]};
        if (edge_edge && vertex_face && !meets(face, a[0]) && !meets(face, a[1]) &&
            segment_pierces_triangle(path(a[0]).t0, path(a[1]).t0,
                                     {path(face[0]).t0, path(face[1]).t0, path(face[2]).t0}))
          first = {0, 0};
        if (!edge_edge || order[0] == 't') continue;
        for (int j = 0; j < 3; ++j) {
          const std::array<std::int32_t, 2> b = {t[j], t[(j + 1) % 3]};
          if (meets(b, a[0]) || meets(b, a[1])) continue;
          earliest({{path(a[0]), path(a[1]), path(b[0]), path(b[1])}, 2}, first);
        }
      }
    }
    return first;
  }
};

namespace {

const assay_description* describe() { return &description(); }

std::int32_t create(const std::int32_t* triangles, std::uint64_t m, const double*, std::uint64_t n,
                    assay_handle** handle, const char**) {
  auto* made = new assay_handle;
  for (std::uint64_t i = 0; i < m; ++i)
    made->triangles.push_back({triangles[3 * i], triangles[3 * i + 1], triangles[3 * i + 2]});
  made->vertices = n;
  *handle = made;
  return ASSAY_OK;
}

void burn(double seconds) {
  const auto now = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  const double until = now() + seconds;
  while (now() < until) {
  }
}

// By a hash of the coordinates, in a share of all steps.
bool is_drawn(const assay_handle& h) {
  std::uint64_t hash = 14695981039346656037u;
  for (std::size_t i = 0; i < 3 * h.vertices; ++i) {
    for (const double x : {h.x_t0[i], h.x_t1[i]}) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &x, sizeof bits);
      hash = (hash ^ bits) * 1099511628211u;
      hash ^= hash >> 29;
    }
  }
  constexpr double all = 18446744073709551616.;  // 2^64
  return static_cast<double>(hash) < number_of("alarm-share") * all;
}

double clamped(double t) { return std::clamp(t, 0., 1.); }

void abort_outside(const assay_handle& h, double first) {
  if (description().start == ASSAY_START_FREE && first == 0) std::abort();
  if (description().largest == 0) return;
  for (std::size_t i = 0; i < 3 * h.vertices; ++i) {
    if (std::abs(h.x_t0[i]) > description().largest) std::abort();
  }
  for (const auto& corners : h.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      double length = 0;
      for (int k = 0; k < 3; ++k) {
        length = std::max(
            length, std::abs(h.x_t0[3 * corners[i] + k] - h.x_t0[3 * corners[(i + 1) % 3] + k]));
      }
      if (length > 0 && length < description().least_nonzero) std::abort();
    }
  }
}

std::int32_t evaluate(assay_handle* h, const double* x_t0, const double* x_t1) {
  h->x_t0 = x_t0;
  h->x_t1 = x_t1;
  h->pairs.clear();
  h->times.clear();
  TimeEnclosure first{2, 2};
  const double shift = number_of("late") - number_of("early");
  for (std::size_t t = 1; t < h->triangles.size(); ++t) {
    for (std::size_t s = 0; s < t; ++s) {
      if (assay_handle::leaves_out(h->triangles[s], h->triangles[t])) continue;
      const auto time = h->first_contact(h->triangles[s], h->triangles[t]);
      if (time.lo > 1) continue;
      h->pairs.insert(h->pairs.end(), {static_cast<std::int32_t>(s), static_cast<std::int32_t>(t)});
      h->times.insert(h->times.end(), {clamped(time.lo + shift), clamped(time.hi + shift)});
      if (time < first) first = time;
    }
  }
  const auto lines = static_cast<int>(number_of("print"));
  for (int i = 1; i <= lines; ++i)
    std::fprintf(stderr, "line %d of \x1b[31m%d triangles\n", i,
                 static_cast<int>(h->triangles.size()));
  if (has("abort")) std::abort();
  if (has("abort-outside")) abort_outside(*h, first.lo);
  if (has("burn") && first.lo == first.hi && first.lo > 0 && first.lo <= 1) burn(number_of("burn"));
  h->collision = first.lo <= 1;
  const bool at_start = first.lo == 0 && first.hi == 0;
  if (has(at_start ? "miss-at-start" : "miss-inside")) h->collision = false;
  h->lo = clamped(first.lo + shift);
  h->hi = clamped(first.hi + shift);
  const auto one_of = static_cast<std::uint64_t>(number_of("alarm"));
  const bool is_alarm =
      first.lo > 1 && ((one_of > 0 && ++h->free_steps % one_of == 0) || is_drawn(*h));
  if (is_alarm || has("whenever")) {
    h->collision = true;
    h->lo = 0;
    h->hi = 1;
  }
  if (has("drop-last") && !h->pairs.empty()) h->pairs.resize(h->pairs.size() - 2);
  if (has("no-interval")) h->hi = h->lo - 1;
  static std::atomic<int> calls = 0;
  if (has("changing") && ++calls % 2 == 0) h->hi = 1;
  if (!h->collision) h->pairs.clear();
  return ASSAY_OK;
}

std::int32_t commit(assay_handle*) { return ASSAY_OK; }

std::int32_t result(assay_handle* h, assay_result* out) {
  out->answer = h->collision ? ASSAY_COLLISION : ASSAY_FREE;
  out->first_lo = h->collision ? h->lo : 0;
  out->first_hi = h->collision ? h->hi : 0;
  if (has("no-pairs") && !has("with-pairs")) return ASSAY_OK;
  out->pair_count = h->pairs.size() / 2;
  out->pairs = h->pairs.data();
  out->pair_times = h->times.data();
  return ASSAY_OK;
}

void destroy(assay_handle* h) { delete h; }

}  // namespace

const assay_detector_api* assay_detector() {
  static const assay_detector_api api = [] {
    assay_detector_api table = {};
    table.abi_version = ASSAY_DETECTOR_ABI_VERSION;
    table.describe = describe;
    table.create = create;
    table.evaluate = evaluate;
    table.commit = commit;
    table.result = result;
    table.destroy = destroy;
    return table;
  }();
  return &api;
}
