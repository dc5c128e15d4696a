
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "detector/boundary/boundary_handler.h"
#include "detector/boxes/moving_box.h"
#include "detector/contact_place.h"
#include "oracle/distance/step_distance.h"
#include "oracle/instant/instant.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/pair_relation.h"
#include "oracle/view/touched_by_ghosts.h"
#include "oracle/view/view_sign.h"
#include "properties/judging/agreement.h"
#include "properties/judging/verdict.h"
#include "properties/numbering.h"
#include "properties/worker/case_run.h"
#include "reports/steps/step_report.h"
#include "reports/terminal/words.h"

namespace assay::reports {

bool StepContacts::cross_at_start(const detector::PairContact& contact) const {
  return contact.time.lo == 0 &&
         oracle::triangles_cross(motion.vertices_t0, triangles, contact.pair);
}

bool StepContacts::cross_at_end(const detector::PairContact& contact) const {
  return oracle::triangles_cross(motion.vertices_t1, triangles, contact.pair);
}

std::string StepContacts::text(std::size_t most) const {
  const auto kinds = marks();
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto count = std::min(most, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](const auto i, const auto j) {
                      return std::tie(pairs[i].time, kinds[i], pairs[i].pair) <
                             std::tie(pairs[j].time, kinds[j], pairs[j].pair);
                    });
  std::string out;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& contact = pairs[order[i]];
    const auto& [pair, time, feature] = contact;
    out += fmt::format("  contact: triangles {} and {}{}", pair.a, pair.b, bodies.text(pair));
    if (!is_at_rest) out += fmt::format(" at t = {}", time_text(time));
    out += fmt::format(", {}", properties::name_of(feature.kind));
    if (feature.vertices[0] >= 0) {
      const auto place = detector::contact_place(motion, triangles, contact);
      // Rounding shows in numbers near 0 alone.
      const auto number = [&](double x) { return std::abs(x) <= place.error ? 0 : x; };
      const auto& [x, y, z] = place.point;
      out += fmt::format(" at ({:.9g}, {:.9g}, {:.9g})", number(x), number(y), number(z));
    }
    out += cross_at_start(contact) ? ", crossing" : ", touching";
    if (time.hi > 0)
      out += cross_at_end(contact) ? "; crossing at the end" : "; not crossing at the end";
    out += "\n";
  }
  if (order.size() > count)
    out += fmt::format("  ... {} more pairs in contact: --json names all\n", order.size() - count);
  if (is_at_rest && count > 0 && pairs.size() <= most_told_apart) {
    const auto touching = std::count(kinds.begin(), kinds.end(), touching_mark);
    out += fmt::format("  crossing: {}, touching: {}\n",
                       pairs.size() - static_cast<std::size_t>(touching), touching);
  }
  return out;
}

std::vector<std::uint8_t> StepContacts::marks() const {
  std::vector<std::uint8_t> marks(pairs.size(), crossing_mark);
  if (!is_at_rest || pairs.size() > most_told_apart) return marks;
  std::transform(pairs.begin(), pairs.end(), marks.begin(), [&](const auto& contact) {
    return cross_at_start(contact) ? crossing_mark : touching_mark;
  });
  return marks;
}

nlohmann::ordered_json StepContacts::json() const {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const auto& contact : pairs) {
    Json json = to_json(contact, bodies);
    json["meeting"] = cross_at_start(contact) ? "crossing" : "touching";
    json["crosses_at_end"] = is_at_rest ? Json() : Json(cross_at_end(contact));
    std::optional<detector::ContactPlace> place;
    if (contact.feature.vertices[0] >= 0)
      place = detector::contact_place(motion, triangles, contact);
    json["point"] = place ? Json(place->point) : Json();
    json["barycentric"] = place ? Json(place->barycentric) : Json();
    json["error"] = place ? Json(place->error) : Json();
    const bool has_normal = place && place->normal;
    json["normal"] = has_normal ? Json(*place->normal) : Json();
    json["normal_error"] = has_normal ? Json(place->normal_error) : Json();
    list.push_back(std::move(json));
  }
  return list;
}

std::string rest_text(const std::vector<detector::PairContact>& pairs,
                      const properties::BodyNames& bodies) {
  if (bodies.empty())
    return pairs.empty() ? "the mesh does not meet itself"
                         : "the mesh meets itself: " + pairs_text(pairs.size());
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> counts;
  for (const auto& contact : pairs) {
    const auto [low, high] =
        std::minmax(bodies.of(contact.pair.a).body, bodies.of(contact.pair.b).body);
    ++counts[{low, high}];
  }
  if (counts.empty()) return "no body meets another or itself";
  constexpr std::size_t most_listed = 10;
  std::vector<std::string> list;
  for (const auto& [two, count] : counts) {
    if (list.size() == most_listed) break;
    list.push_back(
        fmt::format("body {} meets {}: {}", two.first,
                    two.first == two.second ? "itself" : fmt::format("body {}", two.second),
                    pairs_text(count)));
  }
  if (counts.size() > most_listed)
    list.push_back(fmt::format("and {} more pairs of bodies", counts.size() - most_listed));
  return join(list, ", ");
}

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

  // Returns whether this body holds the other one. Each component of the other body is connected
  // and meets nothing of this one, so one of its vertices decides.
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

using detector::doubt::dirty;
using detector::doubt::violated;

const char* sign_text(detector::ViewSign sign) {
  constexpr const char* from_negative[] = {"V-", "V0", "V+"};
  return from_negative[static_cast<int>(sign) + 1];
}

class PairStory {
 public:
  PairStory(const corpus::Case& c, const detector::Detector& detector,
            const detector::TrianglePair& pair, double separation)
      : case_(c),
        detector_(detector),
        pair_(pair),
        separation_(separation),
        is_asked_(
            !leaves_out(properties::contract_of({.separation = separation}), c.triangles, pair)),
        counts_(is_asked_) {
    if (!c.counted) return;
    const auto features = oracle::mesh_features(c.triangles);
    const oracle::PairRelation relation(c.counted->pairs, features);
    bodies_meet_ = relation.bodies_meet(c.triangles(pair.a, 0), c.triangles(pair.b, 0));
    counts_ = is_asked_ && relation.counts_faces(pair.a, pair.b);
  }

  std::string of_step(const detector::StepResult& result, const detector::Positions& x_t0,
                      const detector::Positions& x_t1, const oracle::StepJudgement& truth) const {
    std::string out;
    const auto layers = separation_ > 0 ? std::nullopt : layers_at_start(result, x_t0);
    for (const auto t : {pair_.a, pair_.b}) out += triangle_text(t, result, layers);
    const detector::RoundedPositions points({x_t0, x_t1});
    const auto& triangles = detector_.topology().triangles;
    const auto by = points.grid().margin(separation_) / 2;  // as the detector's tree grows them
    const bool boxes_apart = apart(grown(points.box(triangles[at(pair_.a)]), by),
                                   grown(points.box(triangles[at(pair_.b)]), by));
    out += fmt::format("    {}; moving boxes{} {}\n", rule_text(result),
                       separation_ > 0 ? fmt::format(" grown by {}", separation_) : "",
                       boxes_apart ? "are apart: never tested" : "meet");
    if (!counts_) out += "    the pair does not count: neither oracle nor detector reports it\n";
    out += fmt::format("    oracle: {}\n", oracle_text({x_t0, x_t1}, truth));
    const bool reported = std::any_of(result.pairs.begin(), result.pairs.end(),
                                      [&](const auto& contact) { return contact.pair == pair_; });
    return out + fmt::format("    detector: {}\n", reported ? "reported" : "not reported");
  }

 private:
  std::string oracle_text(const detector::SteppedMesh& motion,
                          const oracle::StepJudgement& truth) const {
    if (!counts_) return "not asked";
    const auto place = std::find_if(truth.pairs.begin(), truth.pairs.end(),
                                    [&](const auto& contact) { return contact.pair == pair_; });
    if (place != truth.pairs.end())
      return fmt::format("{} at t = {} ({})", met_text(separation_), time_text(place->time),
                         properties::name_of(place->feature.kind));
    const std::string never = "never " + met_text(separation_);
    if (separation_ == 0) return never;
    oracle::DistanceOptions options;
    options.counted = corpus::counted_of(case_);
    options.also_asked = [&](std::int32_t a, std::int32_t b) {
      return detector::TrianglePair{a, b} == pair_;
    };
    const auto least = oracle::least_distance(motion, case_.triangles, options);
    return fmt::format("{}; least distance {}", never, least.distance);
  }

  std::int32_t component(std::int32_t t) const {
    return detector_.topology().component_of_triangle[at(t)];
  }

  std::optional<oracle::LayerState> layers_at_start(const detector::StepResult& result,
                                                    const detector::Positions& x_t0) const {
    const auto& surface = detector_.surface();
    if (result.apexes.size() != surface.loops.size()) return std::nullopt;
    const auto& all = surface.all().triangles;
    const auto own = surface.mesh.triangles.size();
    detector::Triangles ghosts(static_cast<Eigen::Index>(all.size() - own), 3);
    for (std::size_t g = own; g < all.size(); ++g) {
      ghosts.row(static_cast<Eigen::Index>(g - own)) << all[g][0], all[g][1], all[g][2];
    }
    const oracle::Instant start(detector::with_apexes(x_t0, result.apexes, false));
    return oracle::layers_at(start, case_.triangles, ghosts);
  }

  std::string triangle_text(std::int32_t t, const detector::StepResult& result,
                            const std::optional<oracle::LayerState>& layers) const {
    std::string out = fmt::format("    triangle {}: component {}", t, component(t));
    if (!result.doubts.empty()) {
      out += fmt::format(", {}{}{}", sign_text(result.signs[at(t)]),
                         result.doubts[at(t)] & violated ? ", violated" : "",
                         result.doubts[at(t)] & dirty ? ", dirty" : "");
    }
    if (layers) {
      const auto& layer = layers->layer[at(t)];
      out += layer ? fmt::format(", layer ({}, {})", layer->inside, layer->outside)
                   : ", touched at the start";
      out += layers->clean[at(t)] ? ", clean by the oracle" : ", not clean by the oracle";
    }
    return out + "\n";
  }

  std::string rule_text(const detector::StepResult& result) const {
    if (!is_asked_) return "a common vertex: a separation leaves such pairs out";
    if (!bodies_meet_) return "these bodies are said not to meet: not searched (L19)";
    if (component(pair_.a) != component(pair_.b)) return "two components: always a candidate (L10)";
    if (result.doubts.empty()) return "no view sets: every pair is a candidate";
    const oracle::Candidates k(
        {result.signs.begin(), result.signs.begin() + case_.triangles.rows()}, result.doubts);
    return k.holds(pair_) ? "a candidate, because it is in K (L3)"
                          : "no candidate (not in K): tested only if the closure reaches it (L7)";
  }

  const corpus::Case& case_;
  const detector::Detector& detector_;
  detector::TrianglePair pair_;
  double separation_;
  bool is_asked_;  // false for a common vertex, if there is a separation
  bool counts_;    // false if the case's relation leaves it out
  bool bodies_meet_ = true;
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

std::string pair_story(const corpus::Case& c, const detector::Options& options,
                       const detector::TrianglePair& pair,
                       const std::vector<oracle::StepJudgement>& truth) {
  auto creation = properties::CasePlayer::make(c, options);
  if (!creation) return fmt::format("  refused: {}\n", creation.error().message);
  std::string out =
      fmt::format("  why {}, {}{}:\n", pair.a, pair.b,
                  properties::BodyNames(corpus::counted_of(c), c.triangles).text(pair));
  auto& player = creation.value();
  const PairStory story(c, player.detector(), pair, options.separation);
  for (std::size_t s = 0; s < player.steps(); ++s) {
    out += fmt::format("   step {}:\n", s + 1) +
           story.of_step(player.play(s), player.x_t0(s), player.x_t1(s), truth[s]);
  }
  return out;
}

}  // namespace assay::reports
