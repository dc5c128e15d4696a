// Plain data of one step: features, contacts, view primitives, answers. No arithmetic. This
// evaluates a step that is viewed from the origin, and reads which vertices meet a face:
//
//   const ViewPrimitive origin = {{{0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}};
//   const StepResult result = detector.evaluate(x_t0, x_t1, {&origin, 1});
//   for (const PairContact& contact : result.pairs)
//     if (contact.feature.kind == FeatureKind::vertex_face) use(contact.feature.vertices[0]);
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "detector/mesh/enum_names.h"
#include "detector/mesh/types.h"

namespace assay::detector {

// The numbers that a step is computed in. detector/README.md says what each arithmetic promises.
enum class Arithmetic : std::uint8_t {
  exact,             // doubles with proved bounds, integers where these cannot tell: never wrong
  bounded,           // only doubles with proved bounds: undecided pairs count as contacts
  double_precision,  // doubles with bounds 0: promises nothing, made to be measured
  single_precision,  // floats with bounds 0, coordinates rounded to float first: promises nothing
};
constexpr auto names_of(Arithmetic) {
  using enum Arithmetic;
  return std::to_array<Named<Arithmetic>>({{exact, "exact"},
                                           {bounded, "bounded"},
                                           {double_precision, "double"},
                                           {single_precision, "float"}});
}

// Vertex against closed triangle; the two share no mesh vertex.
struct VertexFace {
  MovingPoint vertex;
  std::array<MovingPoint, 3> face;
};

// Closed segment against closed segment; the two share no mesh vertex.
struct EdgeEdge {
  std::array<MovingPoint, 2> a;
  std::array<MovingPoint, 2> b;
};

// Whether a caller wants the first contact time or only the answer.
enum class Want { yes_no, first_time };

// A time in [0,1]. In exact arithmetic (the oracle, the detector's `exact`) lo == hi if the time
// is a double, otherwise lo and hi are the adjacent doubles with lo < time < hi. This enclosure of
// a time is unique, so two exact methods must agree in every bit, and the enclosure of the lesser
// of two times is the lesser enclosure. In bounded arithmetic lo <= time <= hi. In plain doubles
// and floats lo == hi, and nothing is promised.
struct TimeEnclosure {
  double lo = 0, hi = 0;
  friend auto operator<=>(const TimeEnclosure&, const TimeEnclosure&) = default;
};

// A bound on the times of contacts that are looked for: later contacts are left out. The bound 1
// leaves out none. Unique enclosures tell exactly whether a time is later than `until`. Other
// enclosures may not tell; then the contact is not left out.
struct TimeBound {
  double until = 1;
  bool has_unique_times = true;  // true in exact arithmetic
  bool leaves_out(const TimeEnclosure& time) const {
    return (has_unique_times ? time.hi : time.lo) > until;
  }
};

// A distance: the exact sum of two doubles, such as the offsets of two bodies. `second` may be
// negative, so that the sum can lie just below a double. REQUIRES that both are finite, and that
// `first` and the sum are >= 0.
struct Separation {
  double first = 0, second = 0;
  friend bool operator==(const Separation&, const Separation&) = default;
};

// Triangle indices, a < b.
struct TrianglePair {
  std::int32_t a = 0, b = 0;
  friend auto operator<=>(const TrianglePair&, const TrianglePair&) = default;
};

enum class FeatureKind : std::uint8_t { vertex_face, edge_edge, piercing, same_vertices };
constexpr auto names_of(FeatureKind) {
  using enum FeatureKind;
  return std::to_array<Named<FeatureKind>>({{vertex_face, "vertex-face"},
                                            {edge_edge, "edge-edge"},
                                            {piercing, "piercing"},
                                            {same_vertices, "same-vertices"}});
}

// Two features that meet, by their mesh vertices:
//   vertex_face    v, f0 f1 f2
//   edge_edge      a0 a1, b0 b1
//   piercing       e0 e1, f0 f1 f2; the edge goes through the triangle at t=0
//   same_vertices  f0 f1 f2 of two triangles with the same vertices; only the oracle reports it
// Unused elements of `vertices` are -1.
struct Feature {
  FeatureKind kind = FeatureKind::vertex_face;
  std::array<std::int32_t, 5> vertices = {-1, -1, -1, -1, -1};
};

// A triangle pair in contact, with the first time of that contact and a feature pair that meets at
// that time.
struct PairContact {
  TrianglePair pair;
  TimeEnclosure time;
  Feature feature;
};

enum class Answer : std::uint8_t { free, collision, undecided, error };
constexpr auto names_of(Answer) {
  return std::to_array<Named<Answer>>({{Answer::free, "free"},
                                       {Answer::collision, "collision"},
                                       {Answer::undecided, "undecided"},
                                       {Answer::error, "error"}});
}

// The answer of a method to a question that it may be unable to decide. `no` and `yes` are proved.
// `open` means that this method cannot tell; another method may be able to.
enum class Decision : std::uint8_t { no, yes, open };

// Sign of a triangle over the whole step, seen from the view primitive (L1, L2).
enum class ViewSign : std::int8_t { negative = -1, zero = 0, positive = 1 };

// A segment whose ends q0 and q1 move linearly over the step, or a point if q0 and q1 are equal at
// t=0 and at t=1.
struct ViewPrimitive {
  MovingPoint q0, q1;
  bool is_point() const { return q0.t0 == q1.t0 && q0.t1 == q1.t1; }
};

// A function that is called now and then during long work. If it returns true, the work stops and
// the answer is `undecided`. An empty function never stops the work.
using StopFunction = std::function<bool()>;

// The common form of the two elementary queries: four moving points in two groups.
//
// The groups of a vertex-face query are {0} | {1,2,3}, those of an edge-edge query {0,1} | {2,3}.
// The features are the closed convex hulls of the groups, also where these are degenerate: the hull
// of a zero-area triangle is a segment or a point. A contact at t means that the two hulls
// meet at t.
struct FourPoints {
  std::array<MovingPoint, 4> points;
  int first_group = 1;  // number of points in the first group: 1 or 2
  bool in_first_group(int i) const { return i < first_group; }
};

inline FourPoints four_points(const VertexFace& q) {
  return {{q.vertex, q.face[0], q.face[1], q.face[2]}, 1};
}

inline FourPoints four_points(const EdgeEdge& q) { return {{q.a[0], q.a[1], q.b[0], q.b[1]}, 2}; }

}  // namespace assay::detector
