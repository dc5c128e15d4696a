#include "properties/judging/cause.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "oracle/instant/static_contact.h"
#include "oracle/mesh/contact_shape.h"
#include "properties/words.h"

namespace assay::properties {
namespace {

using detector::FeatureKind;
using detector::MovingPoint;
using detector::PairContact;
using detector::PositionsView;
using detector::SteppedMesh;
using detector::TrianglesView;

constexpr const char* time_words[] = {"t inside", "t at 1", "t at 0"};
constexpr const char* shape_words[] = {
    "generic",        "double root", "at the end of a feature", "coplanar throughout",
    "parallel edges", "without area"};
constexpr const char* number_words[] = {"ordinary numbers", "tiny numbers", "huge numbers"};
constexpr const char* at_rest = "at rest";

CauseTime time_of(const detector::TimeEnclosure& t) {
  return t.hi == 0 ? CauseTime::at_0 : t.lo == 1 ? CauseTime::at_1 : CauseTime::inside;
}

CauseShape shape_of(oracle::ContactShape shape) {
  switch (shape) {
    case oracle::ContactShape::parallel_edges:
      return CauseShape::parallel_edges;
    case oracle::ContactShape::coplanar_throughout:
      return CauseShape::coplanar_throughout;
    case oracle::ContactShape::double_root:
      return CauseShape::double_root;
    case oracle::ContactShape::at_end_of_feature:
      return CauseShape::at_end_of_feature;
    case oracle::ContactShape::generic:
      break;
  }
  return CauseShape::generic;
}

// The two triangles of a pair during a step.
class PairOfStep {
 public:
  PairOfStep(const TrianglesView& triangles, const SteppedMesh& motion, detector::TrianglePair pair)
      : triangles_(triangles), motion_(motion), pair_(pair), faces_{pair.a, pair.b} {}

  // Says which faces count for the area. Without this call both triangles count.
  void set_faces(std::vector<std::int32_t> faces) { faces_ = std::move(faces); }

  MovingPoint path(std::int32_t vertex) const { return motion_.path(vertex); }

  bool moves(std::int32_t vertex) const {
    return (motion_.vertices_t0.row(vertex).array() != motion_.vertices_t1.row(vertex).array())
        .any();
  }

  bool moves() const {
    return std::any_of(std::begin(corners), std::end(corners), [&](int k) {
      return moves(corner(pair_.a, k)) || moves(corner(pair_.b, k));
    });
  }

  CauseNumbers numbers() const {
    bool is_tiny = false, is_huge = false;
    for (const auto triangle : {pair_.a, pair_.b}) {
      for (const int k : corners) {
        for (const auto* x : {&motion_.vertices_t0, &motion_.vertices_t1}) {
          for (int axis = 0; axis < 3; ++axis) {
            const double magnitude = std::abs((*x)(corner(triangle, k), axis));
            is_huge |= magnitude > 0x1p40;
            is_tiny |= magnitude > 0 && magnitude < 0x1p-40;
          }
        }
      }
    }
    return is_huge ? CauseNumbers::huge : is_tiny ? CauseNumbers::tiny : CauseNumbers::ordinary;
  }

  bool is_without_area(const detector::TimeEnclosure& t) const {
    for (const auto triangle : faces_) {
      if (has_no_area(triangle, motion_.vertices_t0) || has_no_area(triangle, motion_.vertices_t1))
        return true;
      if (t.lo == t.hi && has_no_area_at(triangle, t.lo)) return true;
    }
    return false;
  }

  // Tells what is special about the contact of these two features.
  CauseShape shape(const PairContact& contact) const {
    if (is_without_area(contact.time)) return CauseShape::without_area;
    const auto& v = contact.feature.vertices;
    if (contact.feature.kind == FeatureKind::vertex_face) {
      return shape_of(oracle::shape_of(
          detector::VertexFace{path(v[0]), {path(v[1]), path(v[2]), path(v[3])}}, contact.time));
    }
    return shape_of(oracle::shape_of(
        detector::EdgeEdge{{path(v[0]), path(v[1])}, {path(v[2]), path(v[3])}}, contact.time));
  }

 private:
  static constexpr int corners[] = {0, 1, 2};
  using Rational = std::array<mpq_class, 3>;

  std::int32_t corner(std::int32_t triangle, int k) const { return triangles_(triangle, k); }

  static bool is_zero_cross(const Rational& u, const Rational& v) {
    return u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0];
  }

  template <class PlaceOf>
  bool has_no_area_by(std::int32_t triangle, const PlaceOf& place) const {
    Rational u, v;
    for (int axis = 0; axis < 3; ++axis) {
      const mpq_class origin = place(corner(triangle, 0), axis);
      u[axis] = place(corner(triangle, 1), axis) - origin;
      v[axis] = place(corner(triangle, 2), axis) - origin;
    }
    return is_zero_cross(u, v);
  }

  bool has_no_area(std::int32_t triangle, const PositionsView& x) const {
    return has_no_area_by(triangle,
                          [&](std::int32_t v, int axis) { return mpq_class(x(v, axis)); });
  }

  bool has_no_area_at(std::int32_t triangle, double t) const {
    const mpq_class time(t);
    return has_no_area_by(triangle, [&](std::int32_t v, int axis) {
      const mpq_class from(motion_.vertices_t0(v, axis)), to(motion_.vertices_t1(v, axis));
      return mpq_class(from + time * (to - from));
    });
  }

  const TrianglesView& triangles_;
  const SteppedMesh& motion_;
  const detector::TrianglePair pair_;
  std::vector<std::int32_t> faces_;
};

Cause cause_of_contact(const PairOfStep& pair, const PairContact& contact) {
  Cause cause{time_of(contact.time), false, std::nullopt, pair.numbers()};
  for (const std::int32_t v : contact.feature.vertices) cause.is_moving |= v >= 0 && pair.moves(v);
  const bool has_shape = contact.feature.kind == FeatureKind::vertex_face ||
                         contact.feature.kind == FeatureKind::edge_edge;
  if (has_shape) cause.shape = pair.shape(contact);
  // Features that rest and meet are coplanar anyway, so that says nothing.
  if (!cause.is_moving && cause.shape == CauseShape::coplanar_throughout)
    cause.shape = CauseShape::generic;
  return cause;
}

}  // namespace

Cause cause_of(const TrianglesView& triangles, const SteppedMesh& motion,
               const PairContact& contact) {
  return cause_of_contact({triangles, motion, contact.pair}, contact);
}

Cause cause_of_query(const TrianglesView& triangles, const SteppedMesh& motion,
                     const PairContact& contact) {
  PairOfStep pair(triangles, motion, contact.pair);
  if (contact.feature.kind == FeatureKind::vertex_face) {
    pair.set_faces({contact.pair.b});
  } else {
    pair.set_faces({});
  }
  return cause_of_contact(pair, contact);
}

Cause cause_of(const TrianglesView& triangles, const SteppedMesh& motion,
               detector::TrianglePair pair) {
  const PairOfStep of(triangles, motion, pair);
  return {std::nullopt, of.moves(), std::nullopt, of.numbers()};
}

std::string text_of(const Cause& cause) {
  std::string text;
  const auto add = [&](const char* word) { text.append(text.empty() ? "" : ", ").append(word); };
  if (cause.time) add(word_of(time_words, *cause.time));
  add(cause.is_moving ? "moving" : at_rest);
  if (cause.shape) add(word_of(shape_words, *cause.shape));
  if (cause.numbers != CauseNumbers::ordinary) add(word_of(number_words, cause.numbers));
  return text;
}

int oddity_of(std::string_view signature) {
  // The order goes by the numbers first, then by what is at rest, then by the shape, then by the
  // time.
  const auto place_of = [&](const auto& words) {
    int place = 0;
    for (std::size_t i = 0; i < std::size(words); ++i) {
      if (signature.find(std::string(", ") + words[i]) != std::string_view::npos)
        place = static_cast<int>(i);
    }
    return place;
  };
  const bool rests = signature.find(", at rest") != std::string_view::npos;
  return place_of(number_words) * 1000 + (rests ? 500 : 0) + place_of(shape_words) * 10 +
         place_of(time_words);
}

}  // namespace assay::properties
