#include "detector/search/feature_contacts.h"

#include "detector/contact/contact_filter.h"
#include "detector/search/stopwatch.h"

namespace assay::detector {
namespace {

// As many tests come together as keep the code and the data of a phase at hand.
constexpr std::size_t tests_at_once = 2048;

}  // namespace

struct FeatureContacts::OneType {
  Representatives representatives;
  std::vector<TriangleType> types;
};

FeatureContacts::FeatureContacts(const Topology& mesh, const PositionsView& x_t0,
                                 const PositionsView& x_t1, const ElementaryTest& elementary,
                                 Want want, const Representatives& representatives,
                                 const std::vector<TriangleType>& types, PacedStop* pace)
    : mesh_(mesh),
      x_t0_(x_t0),
      x_t1_(x_t1),
      elementary_(elementary),
      want_(want),
      pairs_(mesh, x_t0, x_t1, representatives, types, pace) {
  untested_.reserve(tests_at_once + FeaturePairs::max_keys);
}

FeatureContacts::FeatureContacts(const Topology& mesh, const PositionsView& x_t0,
                                 const PositionsView& x_t1, const ElementaryTest& elementary,
                                 Want want, std::unique_ptr<OneType> own, PacedStop* pace)
    : FeatureContacts(mesh, x_t0, x_t1, elementary, want, own->representatives, own->types, pace) {
  own_ = std::move(own);
}

FeatureContacts::FeatureContacts(const Topology& mesh, const PositionsView& x_t0,
                                 const PositionsView& x_t1, const ElementaryTest& elementary,
                                 Want want, PacedStop* pace)
    : FeatureContacts(mesh, x_t0, x_t1, elementary, want,
                      std::unique_ptr<OneType>(
                          new OneType{Representatives(mesh, pace),
                                      std::vector(mesh.triangles.size(), TriangleType::positive)}),
                      pace) {}

FeatureContacts::~FeatureContacts() = default;

FourPoints FeatureContacts::query(FeatureKey key) const {
  const auto point = [&](std::int32_t v) { return moving_point(x_t0_, x_t1_, v); };
  if (kind_of(key) == FeatureKind::vertex_face) {
    const auto& f = mesh_.triangles[at(second_of(key))];
    return {{point(first_of(key)), point(f[0]), point(f[1]), point(f[2])}, 1};
  }
  const auto &a = mesh_.edges[at(first_of(key))], &b = mesh_.edges[at(second_of(key))];
  return {{point(a[0]), point(a[1]), point(b[0]), point(b[1])}, 2};
}

bool FeatureContacts::add_candidate(std::int32_t a, std::int32_t b, bool may_pierce,
                                    const StopFunction& stop) {
  pairs_.append(a, b, may_pierce, untested_);
  return untested_.size() < tests_at_once || run(stop);
}

void FeatureContacts::test(FeatureKey key) {
  const auto first = first_of(key), second = second_of(key);
  const auto& face = mesh_.triangles[at(second)];
  if (kind_of(key) == FeatureKind::piercing) {
    const auto& e = mesh_.edges[at(first)];
    const Point e0 = point_of(x_t0_, e[0]), e1 = point_of(x_t0_, e[1]);
    const std::array<Point, 3> corners = {point_of(x_t0_, face[0]), point_of(x_t0_, face[1]),
                                          point_of(x_t0_, face[2])};
    if (!elementary_.pierces(e0, e1, corners)) return;
    const TimeEnclosure time = elementary_.piercing_time(e0, e1, corners);
    const Feature feature{FeatureKind::piercing, {e[0], e[1], face[0], face[1], face[2]}};
    for (const auto t : mesh_.edge_triangles.row(first)) add(t, second, time, feature);
  } else {
    const FourPoints points = query(key);
    if (separated_along_an_axis(points)) {
      counts_.rungs.add(ContactRung::axis);
      return;
    }
    ++counts_.elementary_tests;
    const ContactResult result = elementary_.test(points, want_);
    counts_.rungs.add(result.rung);
    if (!result.contact) return;
    if (kind_of(key) == FeatureKind::vertex_face) {
      const Feature feature{FeatureKind::vertex_face, {first, face[0], face[1], face[2], -1}};
      for (const auto t : mesh_.vertex_triangles.row(first)) add(t, second, result.time, feature);
    } else {
      const auto &a = mesh_.edges[at(first)], &b = mesh_.edges[at(second)];
      const Feature feature{FeatureKind::edge_edge, {a[0], a[1], b[0], b[1], -1}};
      for (const auto t : mesh_.edge_triangles.row(first)) {
        for (const auto s : mesh_.edge_triangles.row(second)) add(t, s, result.time, feature);
      }
    }
  }
}

bool FeatureContacts::run(const StopFunction& stop) {
  Stopwatch watch(test_time_);
  constexpr std::size_t tests_between_stops = 256;
  for (std::size_t i = 0; i < untested_.size(); ++i) {
    if (i % tests_between_stops == 0 && stop && stop()) return false;
    if (contacts_.is_nearly_full() && !contacts_.make_room(stop)) return false;
    test(untested_[i]);
  }
  untested_.clear();
  return true;
}

}  // namespace assay::detector
