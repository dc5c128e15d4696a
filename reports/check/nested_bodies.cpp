#include "reports/check/nested_bodies.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "oracle/instant/layers.h"
#include "properties/numbering.h"

namespace assay::reports {
namespace {

using detector::Component, properties::at;

struct Body {
  std::vector<const Component*> components;
  Eigen::AlignedBox3d box;
  bool is_closed = true;
};

// The body alone, in the places of its vertices.
class Inside {
 public:
  Inside(const detector::PositionsView& x, const detector::Topology& mesh, const Body& body)
      : instant_(own_places(x, body)), field_(instant_, own_triangles(mesh, body)) {}

  // The components are connected and meet nothing of the body, so one vertex speaks for each.
  bool holds(const detector::PositionsView& x, const Body& other) const {
    return std::all_of(
        other.components.begin(), other.components.end(), [&](const Component* component) {
          return field_.at(detector::point_of(x, component->vertices.front())).value_or(0) != 0;
        });
  }

 private:
  detector::Positions own_places(const detector::PositionsView& x, const Body& body) {
    number_.assign(static_cast<std::size_t>(x.rows()), -1);
    std::vector<Eigen::Index> rows;
    for (const auto* component : body.components) {
      for (const auto v : component->vertices) {
        number_[at(v)] = static_cast<std::int32_t>(rows.size());
        rows.push_back(v);
      }
    }
    return x(rows, Eigen::all);
  }

  detector::Triangles own_triangles(const detector::Topology& mesh, const Body& body) const {
    std::vector<std::int32_t> corners;
    for (const auto* component : body.components) {
      for (const auto t : component->triangles) {
        for (const auto v : mesh.triangles[at(t)]) corners.push_back(number_[at(v)]);
      }
    }
    return Eigen::Map<detector::Triangles>(corners.data(),
                                           static_cast<Eigen::Index>(corners.size() / 3), 3);
  }

  std::vector<std::int32_t> number_;  // by vertex of the mesh
  const oracle::Instant instant_;
  const oracle::WindingField field_;
};

}  // namespace

std::vector<NestedBodies> nested_bodies(const detector::PositionsView& x,
                                        const detector::Topology& mesh,
                                        const std::vector<std::int32_t>& body,
                                        const std::vector<detector::PairContact>& pairs) {
  std::vector<Body> bodies(at(*std::max_element(body.begin(), body.end())) + 1);
  for (const auto& component : mesh.components) {
    if (component.triangles.empty()) continue;
    auto& of = bodies[at(body[at(component.vertices.front())])];
    of.components.push_back(&component);
    of.is_closed = of.is_closed && component.is_cycle;
    for (const auto v : component.vertices) of.box.extend(x.row(v).transpose().eval());
  }
  const auto body_of = [&](std::int32_t t) { return body[at(mesh.triangles[at(t)][0])]; };
  std::set<std::pair<std::int32_t, std::int32_t>> meet;
  for (const auto& contact : pairs) {
    const auto a = body_of(contact.pair.a), b = body_of(contact.pair.b);
    meet.insert({a, b});
    meet.insert({b, a});
  }
  std::vector<NestedBodies> nested;
  for (std::int32_t outer = 0; outer < static_cast<std::int32_t>(bodies.size()); ++outer) {
    const auto& around = bodies[at(outer)];
    if (!around.is_closed || around.components.empty()) continue;
    std::optional<Inside> inside;  // made where a body may be in it
    for (std::int32_t inner = 0; inner < static_cast<std::int32_t>(bodies.size()); ++inner) {
      const auto& other = bodies[at(inner)];
      if (inner == outer || other.components.empty() || meet.count({inner, outer}) ||
          !around.box.contains(other.box))
        continue;
      if (!inside) inside.emplace(x, mesh, around);
      if (inside->holds(x, other)) nested.push_back({inner, outer});
    }
  }
  return nested;
}

std::vector<NestedBodies> innermost(const std::vector<NestedBodies>& nested) {
  std::map<std::int32_t, std::set<std::int32_t>> around;  // by inner
  for (const auto& [inner, outer] : nested) around[inner].insert(outer);
  std::vector<NestedBodies> list;
  for (const auto& [inner, outer] : nested) {
    const auto& others = around[inner];
    const bool is_apart = std::any_of(others.begin(), others.end(), [&, o = outer](auto between) {
      return around.count(between) && around[between].count(o);
    });
    if (!is_apart) list.push_back({inner, outer});
  }
  return list;
}

}  // namespace assay::reports
