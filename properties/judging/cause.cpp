#include "properties/judging/cause.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "oracle/distance/feature_distance.h"
#include "oracle/instant/instant.h"
#include "oracle/query/contact.h"
#include "properties/judging/contracted_case.h"

namespace assay::properties {
namespace {

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

// The words of a cause. Each list goes from the most ordinary to the oddest. An empty word stands
// for something not worth a word.
constexpr const char *inside = "t inside", *at_1 = "t at 1", *near_0 = "t near 0", *at_0 = "t at 0";
constexpr const char* time_words[] = {inside, at_1, near_0, at_0};

constexpr const char *generic = "generic", *double_root = "double root",
                     *at_end_of_feature = "at the end of a feature",
                     *coplanar_throughout = "coplanar throughout",
                     *parallel_edges = "parallel edges", *without_area = "without area",
                     *distance_to_face = "distance to a face",
                     *distance_of_edges = "distance of two edges",
                     *distance_to_edge = "distance to an edge",
                     *distance_of_vertices = "distance of two vertices",
                     *beyond_distance = "beyond the distance";
constexpr const char* shape_words[] = {
    generic,          double_root,          at_end_of_feature, coplanar_throughout,
    parallel_edges,   without_area,         distance_to_face,  distance_of_edges,
    distance_to_edge, distance_of_vertices, beyond_distance};

constexpr const char* number_words[] = {"", "tiny numbers", "huge numbers"};
constexpr const char* sharing_words[] = {"", "sharing a vertex", "sharing an edge"};
constexpr const char *at_rest = "at rest", *near_start = "near contact at the start";

const char* time_of(const TimeEnclosure& t) {
  constexpr double thousandth = 0x1p-10, last_units = 0x1p-40;
  if (t.hi == 0) return at_0;
  if (t.lo >= 1 - last_units) return at_1;
  return t.hi <= thousandth ? near_0 : inside;
}

// Returns a share of the extent at t = 0, which is the longest side of the box around all vertices.
double share_of_extent(const PositionsView& x, double share) {
  double half = 0;  // so that the difference of two doubles does not overflow
  for (int axis = 0; axis < 3; ++axis) {
    half = std::max(half, 0.5 * x.col(axis).maxCoeff() - 0.5 * x.col(axis).minCoeff());
  }
  return half * (2 * share);
}

const char* word_of(oracle::ContactShape shape) {
  constexpr const char* words[] = {parallel_edges, coplanar_throughout, double_root,
                                   at_end_of_feature, generic};
  return words[static_cast<std::size_t>(shape)];
}

// The two triangles of a pair during a step.
class PairOfStep {
 public:
  // `query`: the pair holds the two features of a query. Then only their vertices count, and of the
  // triangles only the face.
  PairOfStep(const TrianglesView& triangles, const SteppedMesh& motion, TrianglePair pair,
             const std::optional<Feature>& query)
      : triangles_(triangles), motion_(motion), pair_(pair), query_(query) {
    if (!query || query->kind == FeatureKind::vertex_face) faces_.push_back(pair.b);
    if (!query) faces_.push_back(pair.a);
  }

  MovingPoint path(std::int32_t vertex) const { return motion_.path(vertex); }

  bool moves(std::int32_t vertex) const {
    return (motion_.vertices_t0.row(vertex).array() != motion_.vertices_t1.row(vertex).array())
        .any();
  }

  bool moves() const {
    return std::ranges::any_of(
        corners, [&](int k) { return moves(corner(pair_.a, k)) || moves(corner(pair_.b, k)); });
  }

  const char* numbers() const {
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
    return number_words[is_huge ? 2 : is_tiny ? 1 : 0];
  }

  const char* sharing() const {
    const int shared = query_ ? 0 : shared_vertices(triangles_, pair_);
    return sharing_words[std::min(shared, 2)];
  }

  bool is_near_at_start() const {
    constexpr double near_share = 1e-5;
    const auto& x = motion_.vertices_t0;
    if (query_) {
      FourPoints q;
      q.first_group = query_->kind == FeatureKind::vertex_face ? 1 : 2;
      Positions places(4, 3);
      for (std::size_t i = 0; i < 4; ++i) {
        q.points[i] = path(query_->vertices[i]);
        places.row(static_cast<Eigen::Index>(i)) = x.row(query_->vertices[i]);
      }
      const double distance = share_of_extent(places, near_share);
      return distance > 0 && !start_apart(q, distance);
    }
    Triangles two(2, 3);
    two << triangles_.row(pair_.a), triangles_.row(pair_.b);
    const double distance = share_of_extent(x, near_share);
    return distance > 0 && oracle::any_nearer_than(x, two, distance,
                                                   [](std::int32_t, std::int32_t) { return true; });
  }

  bool is_without_area(const TimeEnclosure& t) const {
    for (const auto triangle : faces_) {
      if (has_no_area(triangle, motion_.vertices_t0) || has_no_area(triangle, motion_.vertices_t1))
        return true;
      if (t.lo == t.hi && has_no_area_at(triangle, t.lo)) return true;
    }
    return false;
  }

  // Tells the special properties of the contact of these two features.
  const char* shape(const PairContact& contact, bool of_distance) const {
    if (is_without_area(contact.time)) return without_area;
    return of_distance ? shape_of_distance(contact)
                       : word_of(oracle::shape_of(oracle::points_of(motion_, contact.feature),
                                                  contact.time));
  }

 private:
  const char* shape_of_distance(const PairContact& contact) const {
    const bool is_vertex_face = contact.feature.kind == FeatureKind::vertex_face;
    const auto places =
        oracle::closest_places(oracle::points_of(motion_, contact.feature), contact.time.lo);
    const auto is_inside = [](double share) { return 0 < share && share < 1; };
    const bool first = is_inside(places.first), second = is_inside(places.second);
    if (!is_vertex_face) {
      return first && second   ? distance_of_edges
             : first || second ? distance_to_edge
                               : distance_of_vertices;
    }
    const bool beside_first = is_inside(1 - places.first - places.second);
    const int corners_held = (places.first > 0) + (places.second > 0) + beside_first;
    return corners_held == 3   ? distance_to_face
           : corners_held == 2 ? distance_to_edge
                               : distance_of_vertices;
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
  const TrianglePair pair_;
  std::vector<std::int32_t> faces_;
  std::optional<Feature> query_;
};

std::string joined(std::initializer_list<std::string_view> words) {
  std::string text;
  for (const auto word : words) {
    if (!word.empty()) text.append(text.empty() ? "" : ", ").append(word);
  }
  return text;
}

}  // namespace

std::string cause_of(const TrianglesView& triangles, const SteppedMesh& motion,
                     const PairContact& contact, bool of_distance, bool of_query) {
  const auto& [kind, vertices] = contact.feature;
  const PairOfStep pair(triangles, motion, contact.pair,
                        of_query ? std::optional(contact.feature) : std::nullopt);
  const char* const time = time_of(contact.time);
  const bool moves =
      std::ranges::any_of(vertices, [&](std::int32_t v) { return v >= 0 && pair.moves(v); });
  const bool has_shape = kind == FeatureKind::vertex_face || kind == FeatureKind::edge_edge;
  const char* shape = has_shape ? pair.shape(contact, of_distance) : "";
  // Features that rest and meet are coplanar anyway, so that says nothing.
  if (!moves && shape == coplanar_throughout) shape = generic;
  return joined({time, moves ? "moving" : at_rest, shape, pair.sharing(),
                 time != at_0 && pair.is_near_at_start() ? near_start : "", pair.numbers()});
}

std::string cause_of(const TrianglesView& triangles, const SteppedMesh& motion, TrianglePair of,
                     bool of_distance, const std::optional<Feature>& query) {
  const PairOfStep pair(triangles, motion, of, query);
  return joined({pair.moves() ? "moving" : at_rest, of_distance ? beyond_distance : "",
                 pair.sharing(), pair.is_near_at_start() ? near_start : "", pair.numbers()});
}

int oddity_of(std::string_view signature) {
  // The order is by numbers first, then near start, shared vertices, rest, shape, and time.
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
