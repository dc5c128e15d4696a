// What each named fact of a curated case means, as a check by the oracle alone.
#pragma once

#include <nlohmann/json.hpp>

#include "corpus/cases/case_file.h"
#include "detector/step_result.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/mesh_features.h"
#include "oracle/mesh/step.h"
#include "oracle/query/contact.h"
#include "oracle/view/touched_by_ghosts.h"
#include "oracle/view/view_sign.h"
#include "properties/faults/fault.h"
#include "properties/judging/exam.h"
#include "tests/meshes.h"
#include "tests/oracle/embedding.h"
#include "tests/test.h"

namespace assay::properties::test {

using detector::ViewSign, nlohmann::json;

using Set = std::vector<std::int32_t>;
using Flags = std::vector<std::uint8_t>;

inline Set members(const Flags& flags) {
  Set set;
  for (std::size_t t = 0; t < flags.size(); ++t)
    if (flags[t]) set.push_back(static_cast<std::int32_t>(t));
  return set;
}

inline bool are_all(const std::vector<ViewSign>& signs, ViewSign wanted) {
  return std::all_of(signs.begin(), signs.end(), [&](auto sign) { return sign == wanted; });
}

inline Flags either(Flags a, const Flags& b) {
  for (std::size_t t = 0; t < b.size(); ++t) a[t] |= b[t];
  return a;
}

inline detector::Positions rows(const std::vector<detector::Point>& points) {
  return tests::matrix_of<detector::Positions>(points);
}

// One step of a curated case with what the oracle says of it: signs, contacts, ghosts.
class CuratedStep {
 public:
  CuratedStep(const corpus::Case& c, std::size_t step)
      : triangles(c.triangles), x_t0(c.frames[step]), x_t1(c.frames[step + 1]) {
    if (c.ghosts) {
      ghosts = c.ghosts->triangles;
      apexes_t0 = rows(c.ghosts->apexes[step]);
      apexes_t1 = rows(c.ghosts->apexes[step + 1]);
    }
    const auto view = corpus::view_of_step(c, step);
    if (view) primitive = *view;
    signs = signs_between(x_t0, x_t1);
    judgement = oracle::judge_step({x_t0, x_t1}, triangles, {});
  }

  std::vector<detector::ViewSign> signs_between(const detector::Positions& from,
                                                const detector::Positions& to) const {
    return oracle::view_signs({from, to}, triangles, {&primitive, 1});
  }
  bool all_signs(detector::ViewSign wanted) const { return are_all(signs, wanted); }
  // Returns whether all triangles of the mesh are positive if it rests at x.
  bool all_positive_at_rest(const detector::Positions& x) const {
    return are_all(signs_between(x, x), ViewSign::positive);
  }

  Flags touched(const detector::Positions& from, const detector::Positions& to) const {
    return oracle::touched_by_ghosts({x_t0, x_t1}, triangles, from, to, ghosts);
  }
  Flags swept() const { return touched(apexes_t0, apexes_t1); }
  // Returns what ghosts touch if this is a first step: triangles that they pierce at t=0 are
  // included (L11).
  Flags swept_alone() const {
    return oracle::touched_by_ghosts({x_t0, x_t1}, triangles, apexes_t0, apexes_t1, ghosts, true);
  }
  // Returns which triangles ghosts touch or pierce at rest, at the start or at the end of the step.
  Flags at_rest(bool end) const {
    const auto &x = end ? x_t1 : x_t0, &apexes = end ? apexes_t1 : apexes_t0;
    return oracle::touched_by_ghosts({x, x}, triangles, apexes, apexes, ghosts, true);
  }
  Flags at_either_end() const { return either(at_rest(false), at_rest(true)); }
  // Returns what ghosts touch if all of their corners stay where they are at t=0.
  Flags by_frozen_ghosts() const {
    detector::Positions corners(3 * ghosts.rows(), 3);
    detector::Triangles frozen(ghosts.rows(), 3);
    const detector::Positions all = oracle::with_apexes(x_t0, apexes_t0);
    for (Eigen::Index i = 0; i < corners.rows(); ++i) {
      corners.row(i) = all.row(ghosts(i / 3, i % 3));
      frozen(i / 3, i % 3) = static_cast<std::int32_t>(x_t0.rows() + i);
    }
    return oracle::touched_by_ghosts({x_t0, x_t1}, triangles, corners, corners, frozen);
  }

  // Returns the candidates K with this Vv.
  oracle::Candidates k(Flags violated = {}) const { return {signs, std::move(violated)}; }
  // Returns the pairs in contact that are candidates or, if `held` is false, those that are not.
  std::vector<detector::PairContact> pairs_of(const oracle::Candidates& candidates,
                                              bool held) const {
    std::vector<detector::PairContact> pairs;
    for (const auto& c : judgement.pairs) {
      if (candidates.holds(c.pair) == held) pairs.push_back(c);
    }
    return pairs;
  }
  bool k_finds_nothing(Flags violated = {}) const {
    return pairs_of(k(std::move(violated)), true).empty();
  }
  bool k_finds_the_first(Flags violated = {}) const {
    return !judgement.pairs.empty() &&
           oracle::holds_a_first_contact(judgement.pairs, k(std::move(violated)));
  }
  std::vector<detector::PairContact> pairs_outside_k() const { return pairs_of(k(), false); }
  // Looks at all contacts of features, including later contacts of a pair. Returns the pairs of
  // each contact that has no pair in K.
  std::vector<detector::TrianglePair> lost_feature_pairs() const {
    const auto mesh = oracle::mesh_features(triangles);
    const oracle::Candidates candidates = k();
    std::vector<detector::TrianglePair> lost;
    const detector::SteppedMesh motion = {x_t0, x_t1};
    auto path = [&](std::int32_t v) { return motion.path(v); };
    auto add = [&](std::span<const std::int32_t> of_a, std::span<const std::int32_t> of_b) {
      std::vector<detector::TrianglePair> pairs;
      for (const auto s : of_a) {
        for (const auto t : of_b) {
          pairs.push_back({std::min(s, t), std::max(s, t)});
          if (candidates.holds(pairs.back())) return;
        }
      }
      lost.insert(lost.end(), pairs.begin(), pairs.end());
    };
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh.faces.size()); ++f) {
        const auto& face = mesh.faces[static_cast<std::size_t>(f)];
        if (oracle::holds(face, mesh.vertices[i])) continue;
        const detector::VertexFace query{path(mesh.vertices[i]),
                                         {path(face[0]), path(face[1]), path(face[2])}};
        if (oracle::vertex_face_contact(query, detector::Want::yes_no).contact)
          add(mesh.triangles_of_vertex.of(i), {&f, 1});
      }
    }
    for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
      for (std::size_t j = i + 1; j < mesh.edges.size(); ++j) {
        const auto &a = mesh.edges[i], &b = mesh.edges[j];
        if (oracle::share_vertex(a, b)) continue;
        const detector::EdgeEdge query{{path(a[0]), path(a[1])}, {path(b[0]), path(b[1])}};
        if (oracle::edge_edge_contact(query, detector::Want::yes_no).contact)
          add(mesh.triangles_of_edge.of(i), mesh.triangles_of_edge.of(j));
      }
    }
    return lost;
  }

  detector::Triangles triangles, ghosts{0, 3};
  detector::Positions x_t0, x_t1, apexes_t0{0, 3}, apexes_t1{0, 3};
  detector::ViewPrimitive primitive{};
  std::vector<detector::ViewSign> signs;
  oracle::StepJudgement judgement;
};

// The steps of a case, one or two, and the facts that the case states.
struct Facts {
  explicit Facts(const corpus::Case& c) : stored(json::parse(c.pending)), id(c.id), given(c) {
    for (std::size_t i = 0; i + 1 < c.frames.size(); ++i) steps.emplace_back(c, i);
  }
  const CuratedStep& first() const { return steps.front(); }
  const CuratedStep& last() const { return steps.back(); }
  bool two_steps() const { return steps.size() == 2; }
  Flags stored_flags(const char* name) const {
    Flags flags(static_cast<std::size_t>(last().triangles.rows()), 0);
    for (const std::int32_t t : stored.at(name)) flags[static_cast<std::size_t>(t)] = 1;
    return flags;
  }
  // Returns Vv of the last step, taken as a first step.
  Flags swept() const { return last().ghosts.rows() > 0 ? last().swept_alone() : Flags{}; }

  json stored;
  std::string id;
  corpus::Case given;
  std::vector<CuratedStep> steps;
};

// Returns whether the fact holds; nothing if the case lacks what the check needs.
using Check = std::function<std::optional<bool>(const Facts&)>;

inline detector::Triangles with_ghosts(const CuratedStep& s) {
  detector::Triangles all(s.triangles.rows() + s.ghosts.rows(), 3);
  all << s.triangles, s.ghosts;
  return all;
}

inline oracle::LayerState layers(const CuratedStep& s) {
  const oracle::Instant start(oracle::with_apexes(s.x_t0, s.apexes_t0));
  return oracle::layers_at(start, s.triangles, s.ghosts);
}

inline int layer_classes(const CuratedStep& s) {
  std::set<oracle::Layer> seen;
  for (const auto& layer : layers(s).layer)
    if (layer) seen.insert(*layer);
  return static_cast<int>(seen.size());
}

inline bool is_cycle(const CuratedStep& s) { return oracle::closes(s.triangles, s.ghosts); }

inline int distinct_unmatched_edges(const detector::Triangles& triangles) {
  std::set<oracle::DirectedEdge> edges;
  for (auto [u, v] : oracle::unmatched_edges(triangles))
    edges.insert({std::min(u, v), std::max(u, v)});
  return static_cast<int>(edges.size());
}

// Returns whether no pair is found if, as in one place of the printed thesis, U lacks Vv (and so do
// the partners of V+, V- and V0).
inline bool reduced_u_finds_nothing(const CuratedStep& s, const Flags& violated) {
  return std::none_of(s.judgement.pairs.begin(), s.judgement.pairs.end(), [&](const auto& c) {
    return !(violated[c.pair.a] && violated[c.pair.b]) && s.k(violated).holds(c.pair);
  });
}

inline bool only_block_of_name(const Facts& f) {
  auto letter = [&](std::int32_t t) {
    return std::string(1, "MZP"[static_cast<int>(f.last().signs[t]) + 1]);
  };
  const std::string wanted = f.id.substr(f.id.size() - 2);
  const auto in_k = f.last().pairs_of(f.last().k(), true);
  return !in_k.empty() && std::all_of(in_k.begin(), in_k.end(), [&](const auto& c) {
    const std::string a = letter(c.pair.a), b = letter(c.pair.b);
    return a + b == wanted || b + a == wanted;
  });
}

inline bool lost_all(const Facts& f, ViewSign sign) {
  const auto lost = f.last().lost_feature_pairs();
  return !lost.empty() && std::all_of(lost.begin(), lost.end(), [&](const auto& pair) {
    return f.last().signs[pair.a] == sign && f.last().signs[pair.b] == sign;
  });
}

inline bool non_adjacent_pairs(const Facts& f, bool wanted_in_k) {
  const auto& s = f.last();
  return std::any_of(s.judgement.pairs.begin(), s.judgement.pairs.end(), [&](const auto& c) {
    return shared_vertices(s.triangles, c.pair) == 0 && (!wanted_in_k || s.k().holds(c.pair));
  });
}

// Returns the result of the detector with the planted fault in the last step.
inline std::optional<detector::StepResult> said_by(const Facts& f, const Fault* fault) {
  if (!fault) return std::nullopt;
  return run_case(f.given, {"", fault->options, std::string(fault->name)}).steps.back();
}

// Returns the result of the detector with the planted fault whose curated case this is. The facts
// call this fault the mutant.
inline std::optional<detector::StepResult> said_by_mutant(const Facts& f) {
  const auto all = faults();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Fault& fault) { return fault.curated == f.id; });
  return said_by(f, found == all.end() ? nullptr : &*found);
}

inline std::optional<bool> says_all_positive(const std::optional<detector::StepResult>& result) {
  if (!result) return std::nullopt;
  return are_all(result->signs, ViewSign::positive);
}

// Returns the checks by the names of the facts.
inline std::map<std::string, Check> checks() {
  auto of_sequence = [](Check check) -> Check {
    return [=](const Facts& f) { return f.two_steps() ? check(f) : std::nullopt; };
  };
  const Check cycle = [](const Facts& f) { return is_cycle(f.first()); };
  const Check embedded0 = [](const Facts& f) {
    return oracle::embedded(f.first().x_t0, f.first().triangles);
  };
  const Check no_contact = [](const Facts& f) { return f.first().judgement.pairs.empty(); };
  const Check clear_of_ghosts = [](const Facts& f) {
    return members(f.first().at_rest(false)).empty();
  };
  // D9: a centre that rests in step 1, and is at its last place throughout step 2.
  auto jumped = [](const Facts& f) {
    return f.last().touched(f.last().apexes_t1, f.last().apexes_t1);
  };
  auto time = [](double t) -> Check {
    return [=](const Facts& f) {
      return f.last().judgement.first == detector::TimeEnclosure{t, t};
    };
  };

  const std::vector<std::pair<const char*, Check>> by_names = {
      {"closed_cycle closed cycle cycle_with_ghosts", cycle},
      {"not_a_cycle", [](const Facts& f) { return !is_cycle(f.first()); }},
      {"embedded0 M_embedded0 M_embedded", embedded0},
      {"M_embedded_startA", of_sequence(embedded0)},
      {"M_embedded_startB",
       [](const Facts& f) { return oracle::embedded(f.last().x_t0, f.last().triangles); }},
      {"not_embedded0", [=](const Facts& f) { return !*embedded0(f); }},
      {"contacts contacts_B", [](const Facts& f) { return !f.last().judgement.pairs.empty(); }},
      {"no_contact", no_contact},
      {"stepA_no_contact", of_sequence(no_contact)},
      {"first_at_end", time(1)},
      {"mid", time(0.5)},
      {"single_event",
       [](const Facts& f) {
         const auto& pairs = f.last().judgement.pairs;
         return std::all_of(pairs.begin(), pairs.end(),
                            [&](const auto& c) { return c.time == pairs[0].time; });
       }},
      {"all_Vplus all_M_Vplus",
       [](const Facts& f) { return f.last().all_signs(ViewSign::positive); }},
      {"strict_not_all_positive exact_line_test_not_all_positive",
       [](const Facts& f) { return !f.last().all_signs(ViewSign::positive); }},
      {"all_V0", [](const Facts& f) { return f.last().all_signs(ViewSign::zero); }},
      {"only_one_V0",
       [](const Facts& f) {
         const auto& signs = f.last().signs;
         return std::count(signs.begin(), signs.end(), ViewSign::zero) == 1;
       }},
      {"positive_at_0_and_1",
       [](const Facts& f) {
         const auto& s = f.last();
         return s.all_positive_at_rest(s.x_t0) && s.all_positive_at_rest(s.x_t1);
       }},
      {"positive_at_samples",
       [](const Facts& f) {
         const auto& s = f.last();
         const detector::Positions mid = (s.x_t0 + s.x_t1) / 2;
         EXPECT_EQ(mid * 2, s.x_t0 + s.x_t1);
         return s.all_positive_at_rest(s.x_t0) && s.all_positive_at_rest(mid) &&
                s.all_positive_at_rest(s.x_t1);
       }},
      {"viewline_never_pierced",
       [](const Facts& f) {
         const auto& s = f.last();
         return !oracle::meets_primitive({s.x_t0, s.x_t1}, s.triangles, s.primitive);
       }},
      {"K_empty K_finds_nothing K_without_Vv_finds_nothing",
       [](const Facts& f) { return f.last().k_finds_nothing(); }},
      {"sound_rule_first_ok exact_K_first_ok first_found found found_by_K_with_V0 K_finds "
       "K_with_adjacent_finds swept_ok",
       [](const Facts& f) { return f.last().k_finds_the_first(f.swept()); }},
      {"some_lost", [](const Facts& f) { return !f.last().lost_feature_pairs().empty(); }},
      {"some_pair_lost", [](const Facts& f) { return !f.last().pairs_outside_k().empty(); }},
      {"lost_all_plus", [](const Facts& f) { return lost_all(f, ViewSign::positive); }},
      {"lost_all_minus", [](const Facts& f) { return lost_all(f, ViewSign::negative); }},
      {"only_block", only_block_of_name},
      {"nonadjacent_pairs_in_contact", [](const Facts& f) { return non_adjacent_pairs(f, false); }},
      {"none_of_them_in_K", [](const Facts& f) { return !non_adjacent_pairs(f, true); }},
      {"M_clear_of_ghosts_at_0", clear_of_ghosts},
      {"M_clear_of_ghost_startA", of_sequence(clear_of_ghosts)},
      {"static_Vv_empty", [](const Facts& f) { return members(f.last().at_either_end()).empty(); }},
      {"static_finds_nothing",
       [](const Facts& f) { return f.last().k_finds_nothing(f.last().at_either_end()); }},
      {"static_Vv_misses_first",
       [](const Facts& f) { return !f.last().k_finds_the_first(f.last().at_either_end()); }},
      {"U_minus_Vv_finds_nothing",
       [](const Facts& f) { return reduced_u_finds_nothing(f.last(), f.swept()); }},
      {"frozen_finds_nothing",
       [](const Facts& f) { return f.last().k_finds_nothing(f.last().by_frozen_ghosts()); }},
      {"frozen_ghost_does_not_taint_tetra",
       [](const Facts& f) {
         const Flags frozen = f.last().by_frozen_ghosts();
         return std::none_of(frozen.begin() + 10, frozen.end(), [](auto t) { return t != 0; });
       }},
      {"tip_in_Vv_after_A", of_sequence([](const Facts& f) {
         const Flags after = f.first().swept(), tip = f.stored_flags("tip_faces");
         return std::equal(tip.begin(), tip.end(), after.begin(), std::less_equal<>());
       })},
      {"tip_not_in_Vv_of_B_alone",
       [](const Facts& f) {
         const Flags b = f.swept(), tip = f.stored_flags("tip_faces");
         return std::equal(tip.begin(), tip.end(), b.begin(),
                           [](auto in_tip, auto in_b) { return !in_tip || !in_b; });
       }},
      {"released_finds_nothing",
       [](const Facts& f) { return f.last().k_finds_nothing(f.swept()); }},
      {"persistent_finds",
       [](const Facts& f) {
         return f.last().k_finds_the_first(
             either(f.two_steps() ? f.first().swept() : f.stored_flags("Vv_after_A"), f.swept()));
       }},
      {"step1_no_taint", of_sequence([](const Facts& f) {
         return members(f.first().touched(f.first().apexes_t0, f.first().apexes_t0)).empty();
       })},
      {"no_ghost_contact_step2",
       of_sequence([=](const Facts& f) { return members(jumped(f)).empty(); })},
      {"K_plus_Vv_finds_nothing",
       of_sequence([=](const Facts& f) { return f.last().k_finds_nothing(jumped(f)); })},
      {"mutant_finds_nothing_exact",
       [](const Facts& f) -> std::optional<bool> {
         const auto result = said_by_mutant(f);
         if (!result) return std::nullopt;
         return result->answer == detector::Answer::free;
       }},
      {"mutant_says_all_Vplus",
       [](const Facts& f) { return says_all_positive(said_by_mutant(f)); }},
      {"nonstrict_all_nonneg",
       [](const Facts& f) {
         return says_all_positive(said_by(f, find_fault("view/touching-zero-is-positive")));
       }},
      {"layers_differ", [](const Facts& f) { return layer_classes(f.first()) > 1; }},
      {"four_triangles_at_one_edge",
       [](const Facts& f) {
         std::map<oracle::DirectedEdge, int> uses;
         for (const auto& t : f.first().triangles.rowwise())
           for (int k = 0; k < 3; ++k) {
             const auto [u, v] = std::minmax({t[k], t[(k + 1) % 3]});
             ++uses[{u, v}];
           }
         return std::any_of(uses.begin(), uses.end(), [](const auto& e) { return e.second == 4; });
       }},
      {"connected_by_shared_edge",
       [](const Facts& f) {
         const auto component = layers(f.first()).component;
         return std::all_of(component.begin(), component.end(), [](auto c) { return c == 0; });
       }},
  };
  std::map<std::string, Check> by_name;
  for (const auto& [names, check] : by_names)
    for (const auto& name : tests::words(names)) by_name[name] = check;
  return by_name;
}

}  // namespace assay::properties::test
