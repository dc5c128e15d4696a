#include "properties/judging/cause.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "oracle/distance/feature_distance.h"
#include "oracle/instant/instant.h"
#include "oracle/query/contact.h"
#include "properties/judging/contracted_case.h"
#include "properties/words.h"

namespace assay::properties {
namespace {

using detector::FeatureKind;
using detector::MovingPoint;
using detector::PairContact;
using detector::PositionsView;
using detector::SteppedMesh;
using detector::TrianglesView;

using Rational = std::array<mpq_class, 3>;

bool is_zero_cross(const Rational& u, const Rational& v) {
  return u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0];
}

template <class PlaceOf>
bool has_no_area_by(const TrianglesView& triangles, std::int32_t triangle, const PlaceOf& place) {
  Rational u, v;
  for (int axis = 0; axis < 3; ++axis) {
    const mpq_class origin = place(triangles(triangle, 0), axis);
    u[axis] = place(triangles(triangle, 1), axis) - origin;
    v[axis] = place(triangles(triangle, 2), axis) - origin;
  }
  return is_zero_cross(u, v);
}

constexpr const char* time_words[] = {"t inside", "t at 1", "t near 0", "t at 0"};
constexpr const char* shape_words[] = {"generic",
                                       "double root",
                                       "at the end of a feature",
                                       "coplanar throughout",
                                       "parallel edges",
                                       "without area",
                                       "distance to a face",
                                       "distance of two edges",
                                       "distance to an edge",
                                       "distance of two vertices",
                                       "beyond the distance"};
constexpr const char* number_words[] = {"ordinary numbers", "tiny numbers", "huge numbers"};
constexpr const char* sharing_words[] = {"sharing nothing", "sharing a vertex", "sharing an edge"};
constexpr const char* at_rest = "at rest";
constexpr const char* near_start = "near contact at the start";

CauseTime time_of(const detector::TimeEnclosure& t) {
  constexpr double thousandth = 0x1p-10, last_units = 0x1p-40;
  if (t.hi == 0) return CauseTime::at_0;
  if (t.lo >= 1 - last_units) return CauseTime::at_1;
  return t.hi <= thousandth ? CauseTime::near_0 : CauseTime::inside;
}

// A share of the extent at t = 0, as a distance: of the longest side of the box around all
// vertices.
double share_of_extent(const PositionsView& x, double share) {
  double half = 0;  // so that the difference of two doubles does not overflow
  for (int axis = 0; axis < 3; ++axis) {
    half = std::max(half, 0.5 * x.col(axis).maxCoeff() - 0.5 * x.col(axis).minCoeff());
  }
  return half * (2 * share);
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

  // Says that the pair holds the two features of a query: of its vertices these alone count, and of
  // its triangles the face alone.
  void set_query(const detector::Feature& features) {
    query_ = features;
    faces_.clear();
    if (features.kind == FeatureKind::vertex_face) faces_.push_back(pair_.b);
  }

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

  CauseSharing sharing() const {
    if (query_) return CauseSharing::nothing;
    int shared = 0;
    for (const int k : corners) {
      for (const int l : corners) shared += corner(pair_.a, k) == corner(pair_.b, l);
    }
    return static_cast<CauseSharing>(std::min(shared, 2));
  }

  bool is_near_at_start() const {
    constexpr double near_share = 1e-5;
    const auto& x = motion_.vertices_t0;
    if (query_) {
      detector::FourPoints q;
      q.first_group = query_->kind == FeatureKind::vertex_face ? 1 : 2;
      detector::Positions places(4, 3);
      for (std::size_t i = 0; i < 4; ++i) {
        q.points[i] = path(query_->vertices[i]);
        places.row(static_cast<Eigen::Index>(i)) = x.row(query_->vertices[i]);
      }
      const double distance = share_of_extent(places, near_share);
      return distance > 0 && !start_apart(q, distance);
    }
    detector::Triangles two(2, 3);
    two << triangles_.row(pair_.a), triangles_.row(pair_.b);
    const double distance = share_of_extent(x, near_share);
    return distance > 0 && oracle::any_nearer_than(x, two, distance,
                                                   [](std::int32_t, std::int32_t) { return true; });
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
  CauseShape shape(const PairContact& contact, bool of_distance) const {
    if (is_without_area(contact.time)) return CauseShape::without_area;
    return of_distance ? shape_of_distance(contact)
                       : shape_of(oracle::shape_of(oracle::points_of(motion_, contact.feature),
                                                   contact.time));
  }

 private:
  CauseShape shape_of_distance(const PairContact& contact) const {
    const bool is_vertex_face = contact.feature.kind == FeatureKind::vertex_face;
    const auto places =
        oracle::closest_places(oracle::points_of(motion_, contact.feature), contact.time.lo);
    const auto is_inside = [](double share) { return 0 < share && share < 1; };
    const bool first = is_inside(places.first), second = is_inside(places.second);
    if (!is_vertex_face) {
      return first && second   ? CauseShape::distance_of_edges
             : first || second ? CauseShape::distance_to_edge
                               : CauseShape::distance_of_vertices;
    }
    const bool beside_first = is_inside(1 - places.first - places.second);
    const int corners_held = (places.first > 0) + (places.second > 0) + beside_first;
    return corners_held == 3   ? CauseShape::distance_to_face
           : corners_held == 2 ? CauseShape::distance_to_edge
                               : CauseShape::distance_of_vertices;
  }

  static constexpr int corners[] = {0, 1, 2};

  std::int32_t corner(std::int32_t triangle, int k) const { return triangles_(triangle, k); }

  bool has_no_area(std::int32_t triangle, const PositionsView& x) const {
    return has_no_area_by(triangles_, triangle,
                          [&](std::int32_t v, int axis) { return mpq_class(x(v, axis)); });
  }

  bool has_no_area_at(std::int32_t triangle, double t) const {
    const mpq_class time(t);
    return has_no_area_by(triangles_, triangle, [&](std::int32_t v, int axis) {
      const mpq_class from(motion_.vertices_t0(v, axis)), to(motion_.vertices_t1(v, axis));
      return mpq_class(from + time * (to - from));
    });
  }

  const TrianglesView& triangles_;
  const SteppedMesh& motion_;
  const detector::TrianglePair pair_;
  std::vector<std::int32_t> faces_;
  std::optional<detector::Feature> query_;
};

Cause cause_of_contact(const PairOfStep& pair, const PairContact& contact, bool of_distance) {
  Cause cause{time_of(contact.time), false, std::nullopt, pair.numbers(), pair.sharing()};
  cause.is_near_at_start = cause.time != CauseTime::at_0 && pair.is_near_at_start();
  for (const std::int32_t v : contact.feature.vertices) cause.is_moving |= v >= 0 && pair.moves(v);
  const bool has_shape = contact.feature.kind == FeatureKind::vertex_face ||
                         contact.feature.kind == FeatureKind::edge_edge;
  if (has_shape) cause.shape = pair.shape(contact, of_distance);
  // Features that rest and meet are coplanar anyway, so that says nothing.
  if (!cause.is_moving && cause.shape == CauseShape::coplanar_throughout)
    cause.shape = CauseShape::generic;
  return cause;
}

Cause cause_without_contact(const PairOfStep& pair, bool of_distance) {
  Cause cause{std::nullopt,   pair.moves(),   std::nullopt,
              pair.numbers(), pair.sharing(), pair.is_near_at_start()};
  if (of_distance) cause.shape = CauseShape::beyond_distance;
  return cause;
}

}  // namespace

Cause cause_of(const TrianglesView& triangles, const SteppedMesh& motion,
               const PairContact& contact, bool of_distance) {
  return cause_of_contact({triangles, motion, contact.pair}, contact, of_distance);
}

Cause cause_of_query(const TrianglesView& triangles, const SteppedMesh& motion,
                     const PairContact& contact, bool of_distance) {
  PairOfStep pair(triangles, motion, contact.pair);
  pair.set_query(contact.feature);
  return cause_of_contact(pair, contact, of_distance);
}

Cause cause_of_query(const TrianglesView& triangles, const SteppedMesh& motion,
                     const detector::Feature& features, bool of_distance) {
  PairOfStep pair(triangles, motion, {0, 1});
  pair.set_query(features);
  return cause_without_contact(pair, of_distance);
}

Cause cause_of(const TrianglesView& triangles, const SteppedMesh& motion,
               detector::TrianglePair pair, bool of_distance) {
  return cause_without_contact({triangles, motion, pair}, of_distance);
}

std::string text_of(const Cause& cause) {
  std::string text;
  const auto add = [&](const char* word) { text.append(text.empty() ? "" : ", ").append(word); };
  if (cause.time) add(word_of(time_words, *cause.time));
  add(cause.is_moving ? "moving" : at_rest);
  if (cause.shape) add(word_of(shape_words, *cause.shape));
  if (cause.sharing != CauseSharing::nothing) add(word_of(sharing_words, cause.sharing));
  if (cause.is_near_at_start) add(near_start);
  if (cause.numbers != CauseNumbers::ordinary) add(word_of(number_words, cause.numbers));
  return text;
}

int oddity_of(std::string_view signature) {
  // The order goes by the numbers first, then by a near start, then by what is shared, then by what
  // is at rest, then by the shape, then by the time.
  const auto place_of = [&](const auto& words) {
    int place = 0;
    for (std::size_t i = 0; i < std::size(words); ++i) {
      if (signature.find(std::string(", ") + words[i]) != std::string_view::npos)
        place = static_cast<int>(i);
    }
    return place;
  };
  const auto says = [&](const char* word) {
    return signature.find(std::string(", ") + word) != std::string_view::npos ? 1 : 0;
  };
  int oddity = place_of(number_words);
  oddity = 2 * oddity + says(near_start);
  oddity = 3 * oddity + place_of(sharing_words);
  oddity = 2 * oddity + says(at_rest);
  oddity = static_cast<int>(std::size(shape_words)) * oddity + place_of(shape_words);
  return 10 * oddity + place_of(time_words);
}

bool LeastOddFirst::operator()(std::string_view a, std::string_view b) const {
  return std::pair(oddity_of(a), a) < std::pair(oddity_of(b), b);
}

}  // namespace assay::properties
