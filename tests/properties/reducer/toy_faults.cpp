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
  std::size_t number;
  bool is_new_start;

  oracle::Candidates candidates(const Signs& signs,
                                const std::vector<std::uint8_t>& violated) const {
    return {signs, violated, topology.component_of_triangle};
  }
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
    for (std::size_t i = 0; i < now.size(); ++i)
      if (now[i] != shared[i]) shared[i] = ViewSign::zero;
  }
  return shared;
}

// As seen from the point of the view-line that is nearest to each triangle's first vertex.
Signs one_vertex_signs(const ToyStep& step) {
  Signs signs;
  const auto& triangles = step.mesh.triangles;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const auto corner = [&](int i) {
      return detector::SteppedMesh{step.x_t0, step.x_t1}.path(triangles(t, i));
    };
    const std::array<detector::MovingPoint, 3> corners = {corner(0), corner(1), corner(2)};
    // The nearest point of the first vertex, at both ends, as a moving point.
    const auto nearest = [&](bool end) {
      const auto place = [&](const detector::MovingPoint& p) -> Eigen::Vector3d {
        return Eigen::Vector3d::Map((end ? p.t1 : p.t0).data());
      };
      const Eigen::Vector3d q0 = place(step.view.q0), d = place(step.view.q1) - q0;
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

// Of the contact that is lost; nothing if none is.
std::optional<Finding> missing(const PairContact* lost, const char* claim, const char* stage,
                               std::size_t step) {
  if (!lost) return std::nullopt;
  return Finding{std::string(claim) + "/missing/" + stage + "/" + name_of(lost->feature.kind),
                 {lost->pair.a, lost->pair.b},
                 step};
}

// A pair that meets first, if none of these is found.
template <class IsFound>
const PairContact* lost_first(const oracle::StepJudgement& judgement, IsFound is_found) {
  const PairContact* lost = nullptr;
  for (const auto& contact : judgement.pairs) {
    if (contact.time != judgement.first) continue;
    if (is_found(contact.pair)) return nullptr;
    if (!lost) lost = &contact;
  }
  return lost;
}

// 1 for triangles that are touched, or not of the common layer.
std::vector<std::uint8_t> not_clean(const oracle::Instant& start, const detector::Triangles& mesh,
                                    const detector::Triangles& ghosts) {
  auto flags = oracle::layers_at(start, mesh, ghosts).clean;
  for (auto& flag : flags) flag = flag == 0 ? 1 : 0;
  return flags;
}

bool is_cycle(const detector::Topology& mesh) {
  for (const auto& component : mesh.components)
    if (!component.is_cycle) return false;
  return true;
}

// The case's own, or else the origin.
ViewPrimitive view_of(const Case& c, std::size_t step) {
  return corpus::view_of_step(c, step).value_or(ViewPrimitive{});
}

// Runs `judge_one` on each step that collides until it finds something. Closed meshes only, or else
// unclosed ones of one component alone; dirty is what the layers at the start of the step say.
template <class JudgeOne>
Judge step_judge(JudgeOne judge_one, bool is_closed = true) {
  return [=](const Case& c) -> std::optional<Finding> {
    const auto topology = detector::make_topology(c.triangles, c.frames.front().rows());
    if (is_cycle(topology) != is_closed) return std::nullopt;
    if (!is_closed && topology.components.size() != 1) return std::nullopt;
    const auto steps = corpus::steps_of(c);
    for (std::size_t s = 0; s < steps.size(); ++s) {
      const auto &x_t0 = start_of(c, steps[s]), &x_t1 = end_of(c, steps[s]);
      const auto judgement = oracle::judge_step({x_t0, x_t1}, c.triangles, {});
      if (judgement.answer != detector::Answer::collision) continue;
      const bool is_new_start = s == 0 || steps[s - 1].to != steps[s].from;
      const auto dirty =
          is_closed ? not_clean(oracle::Instant(x_t0), c.triangles, detector::Triangles(0, 3))
                    : std::vector<std::uint8_t>{};
      const ToyStep step = {c, x_t0, x_t1, topology, view_of(c, s), dirty, s, is_new_start};
      if (auto found = judge_one(step, judgement)) return found;
    }
    return std::nullopt;
  };
}

// The first contact is lost when none of its pairs is a candidate: those of these signs, less those
// that `drop` takes away.
template <class SignsOf, class Drop>
Judge first_contact_judge(const char* stage, SignsOf signs_of, Drop drop) {
  return step_judge([=](const ToyStep& step, const oracle::StepJudgement& judgement) {
    const Signs signs = signs_of(step);
    const auto k = step.candidates(signs, step.dirty);
    const auto is_found = [&](const detector::TrianglePair& pair) {
      const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
      const bool dirty = step.dirty[a] != 0 || step.dirty[b] != 0;
      return k.holds(pair) && (dirty || !drop(signs[a], signs[b]));
    };
    return missing(lost_first(judgement, is_found), "first-pairs", stage, step.number);
  });
}

template <class SignsOf>
Judge sign_judge(SignsOf signs_of) {
  return first_contact_judge("view sets", signs_of, [](ViewSign, ViewSign) { return false; });
}

bool both(ViewSign a, ViewSign b, ViewSign x, ViewSign y) {
  return (a == x && b == y) || (a == y && b == x);
}

// Candidates with `least` or more common vertices are not looked at.
Judge adjacency_judge(int least) {
  return step_judge([least](const ToyStep& step, const oracle::StepJudgement& judgement) {
    const auto k = step.candidates(exact_signs(step), step.dirty);
    const auto is_found = [&](const detector::TrianglePair& pair) {
      return k.holds(pair) && shared_vertices(step.mesh.triangles, pair) < least;
    };
    return missing(lost_first(judgement, is_found), "first-pairs", "pair search", step.number);
  });
}

Judge no_closure_judge() {
  return step_judge([](const ToyStep& step, const oracle::StepJudgement& judgement) {
    const auto candidates = step.candidates(exact_signs(step), step.dirty);
    const auto lost = std::ranges::find_if(
        judgement.pairs, [&](const auto& contact) { return !candidates.holds(contact.pair); });
    return missing(lost == judgement.pairs.end() ? nullptr : &*lost, "all-pairs", "closure",
                   step.number);
  });
}

// All positive, all of one group: answered free, whatever the layers are, or the holes.
Judge free_where_positive_judge(const char* stage, bool is_closed) {
  return step_judge(
      [stage](const ToyStep& step, const oracle::StepJudgement& judgement) {
        const Signs signs = exact_signs(step);
        const bool all = std::count(signs.begin(), signs.end(), ViewSign::positive) ==
                         static_cast<std::ptrdiff_t>(signs.size());
        return missing(all ? &judgement.pairs.front() : nullptr, "free-sound", stage, step.number);
      },
      is_closed);
}

// Dirty triangles of the first step's start are known, those of later steps are forgotten.
Judge dirty_not_carried_judge() {
  return step_judge([](const ToyStep& step, const oracle::StepJudgement& judgement) {
    const auto k = step.candidates(exact_signs(step),
                                   step.is_new_start ? step.dirty : std::vector<std::uint8_t>{});
    return missing(lost_first(judgement, [&](const auto& pair) { return k.holds(pair); }),
                   "first-pairs", "state", step.number);
  });
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
        carried = not_clean(start, c.triangles, ghosts);
      }
      auto violated =
          oracle::touched_by_ghosts({x_t0, x_t1}, c.triangles, a_t0, a_t1, ghosts, is_new_start);
      for (std::size_t t = 0; t < violated.size(); ++t) violated[t] |= carried[t];
      const auto judgement = oracle::judge_step({x_t0, x_t1}, c.triangles, {});
      const ToyStep step = {c, x_t0, x_t1, topology, view_of(c, s), violated, s, is_new_start};
      const auto k = step.candidates(exact_signs(step), violated);
      const auto* lost = lost_first(judgement, [&](const auto& pair) { return k.holds(pair); });
      if (lost) return missing(lost, "first-pairs", "ghosts", s);
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
    return first_contact_judge("pair rule", exact_signs,
                               [x, y](ViewSign a, ViewSign b) { return both(a, b, x, y); });
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
      {"winding not checked", free_where_positive_judge("start", true), Start::nested_shells, 8,
       "A2_nested_outward"},
      {"open taken as closed", free_where_positive_judge("ghosts", false), Start::open, 11,
       "D1_open_allplus"},
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
  for (const auto& fault : toy_faults())
    if (fault.name == name) return fault;
  throw std::runtime_error("no toy fault " + name);
}

}  // namespace assay::properties::toys
