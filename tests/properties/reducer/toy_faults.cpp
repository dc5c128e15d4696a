#include "tests/properties/reducer/toy_faults.h"

#include <algorithm>
#include <stdexcept>

#include "detector/mesh/topology.h"
#include "detector/options.h"
#include "oracle/instant/instant.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/mesh_features.h"
#include "oracle/mesh/step.h"
#include "oracle/view/touched_by_ghosts.h"
#include "oracle/view/view_sign.h"
#include "properties/judging/agreement.h"

namespace assay::properties::toys {
namespace {

using corpus::Case, detector::PairContact, detector::Positions, detector::ViewPrimitive,
    detector::ViewSign;

// What the toy detectors are made of: a step with its view, signs of several kinds, contacts lost.

using Signs = std::vector<detector::ViewSign>;

// One step as a toy detector sees it.
struct ToyStep {
  const corpus::Case& mesh;
  const detector::Positions &x_t0, &x_t1;
  const detector::Topology& topology;
  detector::ViewPrimitive view;
  std::vector<std::uint8_t> dirty;  // by triangle
};

Signs exact_signs(const ToyStep& step) {
  return oracle::view_signs({step.x_t0, step.x_t1}, step.mesh.triangles, {&step.view, 1});
}

// The sign that all instants share; zero when they differ.
Signs sampled_signs(const ToyStep& step, const std::vector<double>& times) {
  Signs shared;
  for (const double t : times) {
    const Positions x = (1 - t) * step.x_t0 + t * step.x_t1;
    const Signs now = oracle::view_signs({x, x}, step.mesh.triangles, {&step.view, 1});
    if (shared.empty()) shared = now;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i] != shared[i]) shared[i] = ViewSign::zero;
    }
  }
  return shared;
}

// As seen from the point of the view-line that is nearest to each triangle's first vertex.
Signs one_vertex_signs(const ToyStep& step) {
  Signs signs;
  const auto& triangles = step.mesh.triangles;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::array<detector::MovingPoint, 3> corners;
    for (int i = 0; i < 3; ++i) {
      corners[static_cast<std::size_t>(i)] =
          detector::SteppedMesh{step.x_t0, step.x_t1}.path(triangles(t, i));
    }
    // The nearest point of the first vertex, at both ends, as a moving point.
    const auto nearest = [&](bool end) {
      const auto place = [&](const detector::MovingPoint& p) {
        const auto& x = end ? p.t1 : p.t0;
        return Eigen::Vector3d(x[0], x[1], x[2]);
      };
      const Eigen::Vector3d q0 = place(step.view.q0), q1 = place(step.view.q1);
      const Eigen::Vector3d d = q1 - q0;
      const double square = d.squaredNorm();
      const double s = square > 0 ? (place(corners[0]) - q0).dot(d) / square : 0;
      const Eigen::Vector3d n = q0 + std::min(1., std::max(0., s)) * d;
      return detector::Point{n[0], n[1], n[2]};
    };
    const detector::MovingPoint q = {nearest(false), nearest(true)};
    signs.push_back(oracle::view_sign(corners, {q, q}));
  }
  return signs;
}

std::optional<Finding> missing(const PairContact& contact, const char* claim, const char* stage,
                               std::size_t step) {
  return Finding{std::string(claim) + "/missing/" + stage + "/" + name_of(contact.feature.kind),
                 {contact.pair.a, contact.pair.b},
                 step};
}

int common_vertices(const detector::Triangles& triangles, const detector::TrianglePair& pair) {
  int common = 0;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) common += triangles(pair.a, i) == triangles(pair.b, k) ? 1 : 0;
  }
  return common;
}

// 1 for triangles of a closed mesh that are touched, or not of the common layer.
std::vector<std::uint8_t> not_clean(const Case& c, const Positions& x) {
  const auto state = oracle::layers_at(oracle::Instant(x), c.triangles, detector::Triangles(0, 3));
  std::vector<std::uint8_t> dirty;
  for (const auto clean : state.clean) dirty.push_back(clean == 0 ? 1 : 0);
  return dirty;
}

bool is_cycle(const detector::Topology& mesh) {
  for (const auto& component : mesh.components) {
    if (!component.is_cycle) return false;
  }
  return true;
}

// The case's own, or else the origin.
ViewPrimitive view_of(const Case& c, std::size_t step) {
  return corpus::view_of_step(c, step).value_or(ViewPrimitive{});
}

// Runs `judge_one` on each step until it finds something. Closed meshes only; dirty is what the
// layers at the start of the step say.
template <class JudgeOne>
Judge step_judge(JudgeOne judge_one) {
  return [judge_one](const Case& c) -> std::optional<Finding> {
    const auto topology = detector::make_topology(c.triangles, c.frames.front().rows());
    if (!is_cycle(topology)) return std::nullopt;
    const auto steps = corpus::steps_of(c);
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const auto &x_t0 = start_of(c, steps[s]), &x_t1 = end_of(c, steps[s]);
      const auto judgement = oracle::judge_step({x_t0, x_t1}, c.triangles, {});
      if (judgement.answer != detector::Answer::collision) continue;
      const ToyStep step = {c, x_t0, x_t1, topology, view_of(c, s), not_clean(c, x_t0)};
      if (auto found = judge_one(step, judgement, s)) return found;
    }
    return std::nullopt;
  };
}

// The first contact is lost when none of its pairs is a candidate: those of these signs, less those
// that `drop` takes away.
template <class SignsOf, class Drop>
Judge first_contact_judge(const char* stage, SignsOf signs_of, Drop drop) {
  return step_judge([=](const ToyStep& step, const oracle::StepJudgement& judgement,
                        std::size_t s) -> std::optional<Finding> {
    const Signs signs = signs_of(step);
    const oracle::Candidates k(signs, step.dirty, step.topology.component_of_triangle);
    const PairContact* lost = nullptr;
    for (const auto& contact : judgement.pairs) {
      if (contact.time != judgement.first) continue;
      const auto a = static_cast<std::size_t>(contact.pair.a);
      const auto b = static_cast<std::size_t>(contact.pair.b);
      const bool dirty = step.dirty[a] != 0 || step.dirty[b] != 0;
      if (k.holds(contact.pair) && (dirty || !drop(signs[a], signs[b]))) return std::nullopt;
      if (!lost) lost = &contact;
    }
    return missing(*lost, "first-pairs", stage, s);
  });
}

template <class SignsOf>
Judge sign_judge(SignsOf signs_of) {
  return first_contact_judge("view sets", signs_of, [](ViewSign, ViewSign) { return false; });
}

template <class Drop>
Judge pair_rule_judge(Drop drop) {
  return first_contact_judge("pair rule", exact_signs, drop);
}

bool both(ViewSign a, ViewSign b, ViewSign x, ViewSign y) {
  return (a == x && b == y) || (a == y && b == x);
}

// Candidates with `least` or more common vertices are not looked at.
Judge adjacency_judge(int least) {
  return step_judge([least](const ToyStep& step, const oracle::StepJudgement& judgement,
                            std::size_t s) -> std::optional<Finding> {
    const oracle::Candidates k(exact_signs(step), step.dirty, step.topology.component_of_triangle);
    const PairContact* lost = nullptr;
    for (const auto& contact : judgement.pairs) {
      if (contact.time != judgement.first) continue;
      if (k.holds(contact.pair) && common_vertices(step.mesh.triangles, contact.pair) < least) {
        return std::nullopt;
      }
      if (!lost) lost = &contact;
    }
    return missing(*lost, "first-pairs", "pair search", s);
  });
}

Judge no_closure_judge() {
  return step_judge([](const ToyStep& step, const oracle::StepJudgement& judgement,
                       std::size_t s) -> std::optional<Finding> {
    const oracle::Candidates k(exact_signs(step), step.dirty, step.topology.component_of_triangle);
    for (const auto& contact : judgement.pairs) {
      if (!k.holds(contact.pair)) return missing(contact, "all-pairs", "closure", s);
    }
    return std::nullopt;
  });
}

// All positive, all of one group: answered free, whatever the layers are.
Judge no_winding_judge() {
  return step_judge([](const ToyStep& step, const oracle::StepJudgement& judgement,
                       std::size_t s) -> std::optional<Finding> {
    for (const ViewSign sign : exact_signs(step)) {
      if (sign != ViewSign::positive) return std::nullopt;
    }
    return missing(judgement.pairs.front(), "free-sound", "start", s);
  });
}

// An unclosed mesh is taken for a closed one.
Judge open_as_closed_judge() {
  return [](const Case& c) -> std::optional<Finding> {
    const auto topology = detector::make_topology(c.triangles, c.frames.front().rows());
    if (topology.components.size() != 1 || topology.components[0].is_cycle) return std::nullopt;
    const auto steps = corpus::steps_of(c);
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const auto &x_t0 = start_of(c, steps[s]), &x_t1 = end_of(c, steps[s]);
      const ToyStep step = {c, x_t0, x_t1, topology, view_of(c, s), {}};
      bool positive = true;
      for (const ViewSign sign : exact_signs(step)) positive &= sign == ViewSign::positive;
      if (!positive) continue;
      const auto judgement = oracle::judge_step({x_t0, x_t1}, c.triangles, {});
      if (judgement.answer != detector::Answer::collision) continue;
      return missing(judgement.pairs.front(), "free-sound", "ghosts", s);
    }
    return std::nullopt;
  };
}

// Dirty triangles of the first step's start are known, those of later steps are forgotten.
Judge dirty_not_carried_judge() {
  return [](const Case& c) -> std::optional<Finding> {
    const auto topology = detector::make_topology(c.triangles, c.frames.front().rows());
    const auto steps = corpus::steps_of(c);
    if (!is_cycle(topology)) return std::nullopt;
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const auto &x_t0 = start_of(c, steps[s]), &x_t1 = end_of(c, steps[s]);
      const bool is_new_start = s == 0 || steps[s - 1].to != steps[s].from;
      const auto judgement = oracle::judge_step({x_t0, x_t1}, c.triangles, {});
      const ToyStep step = {
          c,        x_t0,          x_t1,
          topology, view_of(c, s), is_new_start ? not_clean(c, x_t0) : std::vector<std::uint8_t>{}};
      const oracle::Candidates k(exact_signs(step), step.dirty, topology.component_of_triangle);
      if (oracle::holds_a_first_contact(judgement.pairs, k)) continue;
      for (const auto& contact : judgement.pairs) {
        if (contact.time == judgement.first) return missing(contact, "first-pairs", "state", s);
      }
    }
    return std::nullopt;
  };
}

// Holes are closed by fans from the means of their loops. What a ghost touches is dirty in this
// step and forgotten in the next; what was in contact stays dirty.
Judge violated_not_carried_judge() {
  return [](const Case& c) -> std::optional<Finding> {
    const auto vertices = static_cast<std::int32_t>(c.frames.front().rows());
    const auto topology = detector::make_topology(c.triangles, vertices);
    const auto loops = oracle::boundary_loops(c.triangles);
    const auto ghosts = oracle::ghost_triangles(loops, vertices);
    const auto apexes_of = [&](const Positions& x) {
      Positions apexes = Positions::Zero(static_cast<Eigen::Index>(loops.size()), 3);
      for (std::size_t k = 0; k < loops.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        for (const auto v : loops[k]) apexes.row(row) += x.row(v);
        apexes.row(row) /= static_cast<double>(loops[k].size());
      }
      return apexes;
    };
    std::vector<std::uint8_t> carried;
    const auto steps = corpus::steps_of(c);
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const auto &x_t0 = start_of(c, steps[s]), &x_t1 = end_of(c, steps[s]);
      const bool is_new_start = s == 0 || steps[s - 1].to != steps[s].from;
      const Positions a_t0 = apexes_of(x_t0), a_t1 = apexes_of(x_t1);
      if (is_new_start) {
        const oracle::Instant start(oracle::with_apexes(x_t0, a_t0));
        carried.clear();
        for (const auto clean : oracle::layers_at(start, c.triangles, ghosts).clean) {
          carried.push_back(clean == 0 ? 1 : 0);
        }
      }
      auto violated =
          oracle::touched_by_ghosts({x_t0, x_t1}, c.triangles, a_t0, a_t1, ghosts, is_new_start);
      for (std::size_t t = 0; t < violated.size(); ++t) violated[t] |= carried[t];
      const auto judgement = oracle::judge_step({x_t0, x_t1}, c.triangles, {});
      const ToyStep step = {c, x_t0, x_t1, topology, view_of(c, s), violated};
      const oracle::Candidates k(exact_signs(step), violated, topology.component_of_triangle);
      if (!oracle::holds_a_first_contact(judgement.pairs, k)) {
        for (const auto& contact : judgement.pairs) {
          if (contact.time == judgement.first) return missing(contact, "first-pairs", "ghosts", s);
        }
      }
      for (const auto& contact : judgement.pairs) {
        carried[static_cast<std::size_t>(contact.pair.a)] = 1;
        carried[static_cast<std::size_t>(contact.pair.b)] = 1;
      }
    }
    return std::nullopt;
  };
}

std::vector<ToyFault> make_faults() {
  const auto Z = ViewSign::zero, P = ViewSign::positive, M = ViewSign::negative;
  const auto samples = [](std::vector<double> times) {
    return sign_judge([times](const ToyStep& step) { return sampled_signs(step, times); });
  };
  const auto dropped = [](ViewSign x, ViewSign y) {
    return pair_rule_judge([x, y](ViewSign a, ViewSign b) { return both(a, b, x, y); });
  };
  return {
      {"sign at t=0 only", samples({0}), Start::closed, 4, "M_start"},
      {"sign at the end points only", samples({0, 1}), Start::closed, 4, "A4_endpoints_only"},
      {"three time samples", samples({0, 0.5, 1}), Start::closed, 4, "A4b_three_samples"},
      {"(V0,V0) dropped", dropped(Z, Z), Start::closed, 4, "M_pDropZZ"},
      {"(V+,V0) dropped", dropped(P, Z), Start::closed, 4, "M_pDropPZ"},
      {"(V-,V0) dropped", dropped(M, Z), Start::closed, 5, "M_pDropMZ_first"},
      {"(V+,V-) dropped", dropped(P, M), Start::closed, 5, "M_pDropPM"},
      {"vertex-sharing pairs skipped", adjacency_judge(1), Start::closed, 6, "M_pSkipVertex"},
      {"edge-sharing pairs skipped", adjacency_judge(2), Start::closed, 5, "M_pSkipEdge"},
      {"no closure", no_closure_judge(), Start::closed, 6, "C1_lost_plus_plus"},
      {"one vertex for the view-line", sign_judge(one_vertex_signs), Start::tube_with_line, 7,
       "B1_one_vertex_own_nearest"},
      {"winding not checked", no_winding_judge(), Start::nested_shells, 8, "A2_nested_outward"},
      {"open taken as closed", open_as_closed_judge(), Start::open, 11, "D1_open_allplus"},
      {"dirty not carried", dirty_not_carried_judge(), Start::closed, 4, ""},
      {"violated not carried", violated_not_carried_judge(), Start::open, 22,
       "D8_release_arm_sequence"},
  };
}

}  // namespace

const std::vector<ToyFault>& toy_faults() {
  static const std::vector<ToyFault> faults = make_faults();
  return faults;
}

const ToyFault& toy_fault(const std::string& name) {
  for (const auto& fault : toy_faults()) {
    if (fault.name == name) return fault;
  }
  throw std::runtime_error("no toy fault " + name);
}

}  // namespace assay::properties::toys
