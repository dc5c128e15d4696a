// A detector by brute force. Its contract and its faults are words of the environment variable
// ASSAY_BY_CONTRACT, such as "start=free miss-at-start". The contract excuses some of the faults.
//
//   (those of told.h)                        its description
//   strangers                                the same as adjacency=2
//   miss-at-start, miss-inside               answers free if the first contact is at 0, above 0
//   miss=vertex-face, miss=edge-edge         does not test these
//   late=S, early=S                          first time and times of pairs are off by S
//   alarm=N                                  answers collision in one of N free steps
//   alarm-share=P                            the same in a share P of them, by the coordinates
//   burn=S                                   uses S seconds if the first time is a double above 0
//   abort-outside                            aborts if it gets a step outside of its contract
//   abort                                    aborts in every step
//   whenever                                 collision at [0, 1] in every step, with its true pairs
//   with-pairs                               gives pairs, even if it claims to give none
//   drop-last                                does not report its last pair
//   no-interval                              its first time is no interval
//   changing                                 the interval of every second first time ends at 1
//   rounds-end                               rounds the end of a displacement to float32
//   refuse-from=N                            refuses meshes of N triangles or more (capacity)
//   refuse-pairs-from=N                      refuses steps with N pairs in contact or more
//   print=N                                  prints N lines a step, with an escape character
#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cstdio>

#include "detector/contact/elementary.h"
#include "tests/plugins/told.h"

namespace {

using namespace assay::detector;
using assay::plugin::Result, assay::plugin::Description;

const assay::tests::Told told("ASSAY_BY_CONTRACT");

const Description& description() {
  static const Description d = [] {
    auto described = told.description("by contract", (ASSAY_CLAIM_TOTAL << 1) - 1);
    if (told.has("strangers")) described.adjacency = ASSAY_ADJACENCY_NO_SHARED_VERTEX;
    return described;
  }();
  return d;
}

double clamped(double t) { return std::clamp(t, 0., 1.); }

class ByContract {
 public:
  static Description describe() { return description(); }

  explicit ByContract(const assay::plugin::Mesh& mesh) : vertices(mesh.positions.size()) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto* corners = mesh.triangles[i];
      triangles.push_back({corners[0], corners[1], corners[2]});
    }
    if (is_from("refuse-from", triangles.size()))
      throw assay::plugin::BeyondCapacity("so many triangles");
  }

  Result evaluate(assay::plugin::Positions start, assay::plugin::Positions end) {
    x_t0 = start.data();
    x_t1 = end.data();
    if (told.has("displacement")) x_t1 = end_of_displacement(end);
    sweep_boxes();
    Result found = Result::collision();
    TimeEnclosure first{2, 2};
    const double shift = told.number_of("late") - told.number_of("early");
    for (std::size_t t = 1; t < triangles.size(); ++t) {
      for (std::size_t s = 0; s < t; ++s) {
        if (!boxes[s].intersects(boxes[t]) || leaves_out(triangles[s], triangles[t])) continue;
        const auto time = first_contact(triangles[s], triangles[t]);
        if (time.lo > 1) continue;
        found.add(static_cast<std::int32_t>(s), static_cast<std::int32_t>(t),
                  clamped(time.lo + shift), clamped(time.hi + shift));
        if (time < first) first = time;
      }
    }
    if (is_from("refuse-pairs-from", found.pairs.size()))
      throw assay::plugin::BeyondCapacity("so many pairs");
    const auto lines = static_cast<int>(told.number_of("print"));
    for (int i = 1; i <= lines; ++i)
      std::fprintf(stderr, "line %d of \x1b[31m%d triangles\n", i,
                   static_cast<int>(triangles.size()));
    if (told.has("abort")) std::abort();
    if (told.has("abort-outside")) abort_outside(first.lo);
    if (told.has("burn") && first.lo == first.hi && first.lo > 0 && first.lo <= 1)
      assay::tests::burn(told.number_of("burn"));
    const bool at_start = first.lo == 0 && first.hi == 0;
    bool collides = first.lo <= 1 && !told.has(at_start ? "miss-at-start" : "miss-inside");
    found.first = {clamped(first.lo + shift), clamped(first.hi + shift)};
    const auto one_of = static_cast<std::uint64_t>(told.number_of("alarm"));
    const bool is_alarm =
        first.lo > 1 && ((one_of > 0 && ++free_steps % one_of == 0) || is_drawn());
    if (is_alarm || told.has("whenever")) {
      collides = true;
      found.first = {0, 1};
    }
    if (told.has("drop-last") && !found.pairs.empty()) {
      found.pairs.pop_back();
      found.pair_times.pop_back();
    }
    if (told.has("no-interval")) found.first[1] = found.first[0] - 1;
    static std::atomic<int> calls = 0;
    if (told.has("changing") && ++calls % 2 == 0) found.first[1] = 1;
    if (told.has("no-pairs") && !told.has("with-pairs")) found.pairs.clear();
    return collides ? found : Result::free();
  }

 private:
  static bool is_from(const char* word, std::size_t count) {
    return told.has(word) && static_cast<double>(count) >= told.number_of(word);
  }

  const double* end_of_displacement(assay::plugin::Positions way) {
    ends.assign(way.data(), way.data() + 3 * way.size());
    for (std::size_t i = 0; i < ends.size(); ++i) {
      ends[i] += x_t0[i];  // exact, in doubles
      if (told.has("rounds-end")) ends[i] = static_cast<float>(ends[i]);
    }
    return ends.data();
  }

  // What holds each triangle on its whole way: most pairs are far apart.
  void sweep_boxes() {
    boxes.assign(triangles.size(), {});
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (const auto v : triangles[t]) {
        for (const double* x : {x_t0, x_t1}) boxes[t].extend(Eigen::Vector3d(x + 3 * v));
      }
    }
  }

  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<double> ends;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::size_t vertices;
  const double *x_t0 = nullptr, *x_t1 = nullptr;  // of the step under way
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
        description().features != ASSAY_FEATURES_EDGE_EDGE && !told.is("miss", "vertex-face");
    const bool edge_edge =
        description().features != ASSAY_FEATURES_VERTEX_FACE && !told.is("miss", "edge-edge");
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

  // By a hash of the coordinates, in a share of all steps.
  bool is_drawn() const {
    std::uint64_t hash = 14695981039346656037u;
    for (std::size_t i = 0; i < 3 * vertices; ++i) {
      for (const double x : {x_t0[i], x_t1[i]}) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &x, sizeof bits);
        hash = (hash ^ bits) * 1099511628211u;
        hash ^= hash >> 29;
      }
    }
    constexpr double all = 18446744073709551616.;  // 2^64
    return static_cast<double>(hash) < told.number_of("alarm-share") * all;
  }

  void abort_outside(double first) const {
    if (description().start == ASSAY_START_FREE && first == 0) std::abort();
    if (description().largest == 0) return;
    for (std::size_t i = 0; i < 3 * vertices; ++i) {
      if (std::abs(x_t0[i]) > description().largest) std::abort();
    }
    for (const auto& corners : triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        double length = 0;
        for (int k = 0; k < 3; ++k)
          length = std::max(
              length, std::abs(x_t0[3 * corners[i] + k] - x_t0[3 * corners[(i + 1) % 3] + k]));
        if (length > 0 && length < description().least_nonzero) std::abort();
      }
    }
  }
};

}  // namespace

ASSAY_EXPORT_DETECTOR(ByContract);
