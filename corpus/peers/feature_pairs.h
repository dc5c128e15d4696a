// The common part of the peers that test features. Two triangles have six pairs of a vertex and a
// face, and nine pairs of two edges. The peer's elementary tests judge all of these pairs that
// share no vertex, as in FCL's own traversal of meshes. The first time of the two triangles is the
// least time of the tests. Two features that belong to several pairs of triangles are tested again
// for each pair of triangles.
#pragma once

#include <type_traits>
#include <utility>

#include "corpus/peers/triangle_pairs.h"

namespace assay::peers {

// Four points of a step: a vertex and the corners of a face, or the end points of two edges.
struct FourPaths {
  const double* at[2][4];  // at t = 0 and at t = 1
};

// Calls test(four points at t = 0, the four points at t = 1, more...) with points of the peer's own
// type, which has a constructor of three numbers.
template <class Point, class Test, class... More>
auto ask_points(const Test& test, const FourPaths& paths, More&&... more) {
  using Number = std::decay_t<decltype(std::declval<Point&>()[0])>;
  const auto p = [&](int at, int i) {
    const double* x = paths.at[at][i];
    return Point(static_cast<Number>(x[0]), static_cast<Number>(x[1]), static_cast<Number>(x[2]));
  };
  return test(p(0, 0), p(0, 1), p(0, 2), p(0, 3), p(1, 0), p(1, 1), p(1, 2), p(1, 3),
              std::forward<More>(more)...);
}

// Return the time of a contact, or nothing if `found` is false. at_time is for a peer that tells
// the time, not_before for a peer that tells a lower bound of the time, some_time for a peer that
// tells no time.
inline Time at_time(bool found, double time) {
  return found ? Time(plugin::Interval{{time, time}}) : std::nullopt;
}
inline Time not_before(bool found, double time) {
  return found ? Time(plugin::Interval{{time, std::max(time, 1.)}}) : std::nullopt;
}
inline Time some_time(bool found) { return not_before(found, 0); }

// Returns the description that most peers have in common. These peers demand a start without
// contact, and coordinates of usual sizes, because their tolerances are lengths. They claim to be
// deterministic and total, because they are functions of their arguments that return a bool.
inline plugin::Description usual_description(const char* name, const char* version,
                                             std::uint32_t claims) {
  plugin::Description d;
  d.name = name;
  d.version = version;
  d.claims = claims | ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL;
  d.start = ASSAY_START_FREE;
  d.least_nonzero = 1e-6;
  d.largest = 1e6;
  return d;
}

// `Tests` has `Time vertex_face(const FourPaths&)` and `edge_edge`, which return the first time at
// which the two features meet, or nothing if they do not meet.
template <class Tests>
struct FeatureTests {
  static Time first_time(const TrianglePath& s, const TrianglePath& t) {
    Time first;
    for (const auto& [of, face] : {std::pair(&s, &t), std::pair(&t, &s)}) {
      for (int i = 0; i < 3; ++i) {
        if (face->has(of->vertex[i])) continue;
        FourPaths paths;
        for (int e = 0; e < 2; ++e) {
          paths.at[e][0] = of->at[e][i];
          for (int k = 0; k < 3; ++k) paths.at[e][k + 1] = face->at[e][k];
        }
        keep_earlier(Tests::vertex_face(paths), first);
      }
    }
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, j1 = (j + 1) % 3;
        const std::int32_t a = s.vertex[i], b = s.vertex[i1], c = t.vertex[j], d = t.vertex[j1];
        if (a == c || a == d || b == c || b == d) continue;
        FourPaths paths;
        for (int e = 0; e < 2; ++e) {
          paths.at[e][0] = s.at[e][i];
          paths.at[e][1] = s.at[e][i1];
          paths.at[e][2] = t.at[e][j];
          paths.at[e][3] = t.at[e][j1];
        }
        keep_earlier(Tests::edge_edge(paths), first);
      }
    }
    return first;
  }

 private:
  static void keep_earlier(const Time& time, Time& first) {
    if (time && (!first || (*time)[0] < (*first)[0])) first = time;
  }
};

template <class Tests>
class FeaturePairs : public TrianglePairs<FeatureTests<Tests>> {
 public:
  explicit FeaturePairs(const plugin::Mesh& mesh, double separation = 0)
      : TrianglePairs<FeatureTests<Tests>>(mesh, separation) {}

  static plugin::Result query(std::int32_t kind, plugin::Positions x_t0, plugin::Positions x_t1) {
    FourPaths paths;
    for (std::size_t i = 0; i < 4; ++i) {
      paths.at[0][i] = x_t0[i];
      paths.at[1][i] = x_t1[i];
    }
    const bool is_vertex_face = kind == ASSAY_QUERY_VERTEX_FACE;
    const Time time = is_vertex_face ? Tests::vertex_face(paths) : Tests::edge_edge(paths);
    plugin::Result result;
    if (!time) return result;
    result.answer = ASSAY_COLLISION;
    result.first = *time;
    return result;
  }
};

// The peer with the elementary tests of `Tests`, which also has `static plugin::Description
// describe()`.
template <class Tests>
struct PeerOf : FeaturePairs<Tests> {
  explicit PeerOf(const plugin::Mesh& mesh) : FeaturePairs<Tests>(mesh, describe().separation) {}
  static plugin::Description describe() { return Tests::describe(); }
};

}  // namespace assay::peers
