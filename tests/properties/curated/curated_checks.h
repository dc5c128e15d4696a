// What each named fact of a curated case means, as a check by the oracle alone.
#pragma once

#include "detector/step_result.h"
#include "oracle/instant/layers.h"
#include "oracle/mesh/loops.h"
#include "properties/judging/fault_run.h"
#include "tests/oracle/embedding.h"
#include "tests/properties/curated/curated_context.h"

namespace assay::properties::test {

using detector::ViewSign, nlohmann::json;

// The steps of a case: `b` is the last one, `a` the one before it where there are two.
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
  // Vv of the last step by itself.
  Flags swept() const { return last().ghosts.rows() > 0 ? last().swept_alone() : Flags{}; }

  json stored;
  std::string id;
  corpus::Case given;
  std::vector<CuratedStep> steps;
};

// True: holds; false: does not; nothing: this case has not what the check needs.
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
  for (const auto& layer : layers(s).layer) {
    if (layer) seen.insert(*layer);
  }
  return static_cast<int>(seen.size());
}

inline bool is_cycle(const CuratedStep& s) { return oracle::closes(s.triangles, s.ghosts); }

inline int distinct_unmatched_edges(const detector::Triangles& triangles) {
  std::set<oracle::DirectedEdge> edges;
  for (auto [u, v] : oracle::unmatched_edges(triangles)) {
    edges.insert({std::min(u, v), std::max(u, v)});
  }
  return static_cast<int>(edges.size());
}

inline int common_vertices(const CuratedStep& s, const detector::TrianglePair& pair) {
  int common = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) common += s.triangles(pair.a, i) == s.triangles(pair.b, j);
  }
  return common;
}

// The thesis as printed in one place: Vv taken out of U (and so of V+, V- and V0's partners).
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
  const auto in_k = oracle::split(f.last().judgement.pairs, f.last().k()).in_k;
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
    return common_vertices(s, c.pair) == 0 && (!wanted_in_k || s.k().holds(c.pair));
  });
}

// What the planted fault says in the last step.
inline std::optional<detector::StepResult> said_by(const Facts& f, const Fault* fault) {
  return fault ? std::optional(run_case(f.given, *fault).back()) : std::nullopt;
}

// The fault whose case this is: its name there was the mutant's.
inline std::optional<detector::StepResult> said_by_mutant(const Facts& f) {
  const auto all = faults();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Fault& fault) { return fault.curated == f.id; });
  return said_by(f, found == all.end() ? nullptr : &*found);
}

inline std::optional<bool> says_all_positive(const std::optional<detector::StepResult>& result) {
  if (!result) return std::nullopt;
  return std::all_of(result->signs.begin(), result->signs.end(),
                     [](auto sign) { return sign == ViewSign::positive; });
}

inline std::map<std::string, Check> checks() {
  auto with = [](auto test) {
    return [=](const Facts& f) { return std::optional<bool>(test(f)); };
  };
  auto of_sequence = [](auto test) {
    return
        [=](const Facts& f) { return f.two_steps() ? std::optional<bool>(test(f)) : std::nullopt; };
  };
  const Check cycle = with([](const Facts& f) { return is_cycle(f.first()); });
  const Check embedded0 =
      with([](const Facts& f) { return oracle::embedded(f.first().x_t0, f.first().triangles); });
  const Check start_b =
      with([](const Facts& f) { return oracle::embedded(f.last().x_t0, f.last().triangles); });
  const Check contacts = with([](const Facts& f) { return !f.last().judgement.pairs.empty(); });
  const Check no_contact = with([](const Facts& f) { return f.first().judgement.pairs.empty(); });
  const Check all_plus =
      with([](const Facts& f) { return f.last().all_signs(ViewSign::positive); });
  const Check not_all_plus =
      with([](const Facts& f) { return !f.last().all_signs(ViewSign::positive); });
  const Check k_nothing = with([](const Facts& f) { return f.last().k_finds_nothing(); });
  const Check first_found =
      with([](const Facts& f) { return f.last().k_finds_the_first(f.swept()); });
  const Check some_lost =
      with([](const Facts& f) { return !f.last().lost_feature_pairs().empty(); });
  // D9: a centre that stands still in step 1 and is at its last place all through step 2.
  auto jumped = [](const Facts& f) {
    return f.last().touched(f.last().apexes_t1, f.last().apexes_t1);
  };
  auto time = [](double t) {
    return [=](const Facts& f) {
      return std::optional<bool>(f.last().judgement.first == detector::TimeEnclosure{t, t});
    };
  };

  return {
      {"closed_cycle", cycle},
      {"closed", cycle},
      {"cycle", cycle},
      {"cycle_with_ghosts", cycle},
      {"not_a_cycle", with([](const Facts& f) { return !is_cycle(f.first()); })},
      {"embedded0", embedded0},
      {"M_embedded0", embedded0},
      {"M_embedded", embedded0},
      {"M_embedded_startA",
       [=](const Facts& f) { return f.two_steps() ? embedded0(f) : std::nullopt; }},
      {"M_embedded_startB", start_b},
      {"not_embedded0", with([=](const Facts& f) { return !*embedded0(f); })},
      {"contacts", contacts},
      {"contacts_B", contacts},
      {"no_contact", no_contact},
      {"stepA_no_contact",
       [=](const Facts& f) { return f.two_steps() ? no_contact(f) : std::nullopt; }},
      {"first_at_end", time(1)},
      {"mid", time(0.5)},
      {"single_event", with([](const Facts& f) {
         const auto& pairs = f.last().judgement.pairs;
         return std::all_of(pairs.begin(), pairs.end(),
                            [&](const auto& c) { return c.time == pairs[0].time; });
       })},
      {"all_Vplus", all_plus},
      {"all_M_Vplus", all_plus},
      {"strict_not_all_positive", not_all_plus},
      {"exact_line_test_not_all_positive", not_all_plus},
      {"all_V0", with([](const Facts& f) { return f.last().all_signs(ViewSign::zero); })},
      {"only_one_V0", with([](const Facts& f) {
         const auto& signs = f.last().signs;
         return std::count(signs.begin(), signs.end(), ViewSign::zero) == 1;
       })},
      {"positive_at_0_and_1", with([](const Facts& f) {
         const auto& s = f.last();
         return s.all_positive_at_rest(s.x_t0) && s.all_positive_at_rest(s.x_t1);
       })},
      {"positive_at_samples", with([](const Facts& f) {
         const auto& s = f.last();
         const detector::Positions mid = (s.x_t0 + s.x_t1) / 2;
         EXPECT_EQ(mid * 2, s.x_t0 + s.x_t1);
         return s.all_positive_at_rest(s.x_t0) && s.all_positive_at_rest(mid) &&
                s.all_positive_at_rest(s.x_t1);
       })},
      {"viewline_never_pierced", with([](const Facts& f) {
         const auto& s = f.last();
         return !oracle::meets_primitive({s.x_t0, s.x_t1}, s.triangles, s.primitive);
       })},
      {"K_empty", k_nothing},
      {"K_finds_nothing", k_nothing},
      {"K_without_Vv_finds_nothing", k_nothing},
      {"sound_rule_first_ok", first_found},
      {"exact_K_first_ok", first_found},
      {"first_found", first_found},
      {"found", first_found},
      {"found_by_K_with_V0", first_found},
      {"K_finds", first_found},
      {"K_with_adjacent_finds", first_found},
      {"swept_ok", first_found},
      {"some_lost", some_lost},
      {"some_pair_lost", with([](const Facts& f) { return !f.last().pairs_outside_k().empty(); })},
      {"lost_all_plus", with([](const Facts& f) { return lost_all(f, ViewSign::positive); })},
      {"lost_all_minus", with([](const Facts& f) { return lost_all(f, ViewSign::negative); })},
      {"only_block", with(only_block_of_name)},
      {"nonadjacent_pairs_in_contact",
       with([](const Facts& f) { return non_adjacent_pairs(f, false); })},
      {"none_of_them_in_K", with([](const Facts& f) { return !non_adjacent_pairs(f, true); })},
      {"M_clear_of_ghosts_at_0",
       with([](const Facts& f) { return members(f.first().at_rest(false)).empty(); })},
      {"M_clear_of_ghost_startA",
       of_sequence([](const Facts& f) { return members(f.first().at_rest(false)).empty(); })},
      {"static_Vv_empty",
       with([](const Facts& f) { return members(f.last().at_either_end()).empty(); })},
      {"static_finds_nothing",
       with([](const Facts& f) { return f.last().k_finds_nothing(f.last().at_either_end()); })},
      {"static_Vv_misses_first",
       with([](const Facts& f) { return !f.last().k_finds_the_first(f.last().at_either_end()); })},
      {"U_minus_Vv_finds_nothing",
       with([](const Facts& f) { return reduced_u_finds_nothing(f.last(), f.swept()); })},
      {"frozen_finds_nothing",
       with([](const Facts& f) { return f.last().k_finds_nothing(f.last().by_frozen_ghosts()); })},
      {"frozen_ghost_does_not_taint_tetra", with([](const Facts& f) {
         const Flags frozen = f.last().by_frozen_ghosts();
         return std::none_of(frozen.begin() + 10, frozen.end(), [](auto t) { return t != 0; });
       })},
      {"tip_in_Vv_after_A", of_sequence([](const Facts& f) {
         const Flags after = f.first().swept(), tip = f.stored_flags("tip_faces");
         return std::equal(tip.begin(), tip.end(), after.begin(), std::less_equal<>());
       })},
      {"tip_not_in_Vv_of_B_alone", with([](const Facts& f) {
         const Flags b = f.swept(), tip = f.stored_flags("tip_faces");
         return std::equal(tip.begin(), tip.end(), b.begin(),
                           [](auto in_tip, auto in_b) { return !in_tip || !in_b; });
       })},
      {"released_finds_nothing",
       with([](const Facts& f) { return f.last().k_finds_nothing(f.swept()); })},
      {"persistent_finds", with([](const Facts& f) {
         Flags carried = f.two_steps() ? f.first().swept() : f.stored_flags("Vv_after_A");
         const Flags b = f.swept();
         for (std::size_t t = 0; t < b.size(); ++t) carried[t] |= b[t];
         return f.last().k_finds_the_first(carried);
       })},
      {"step1_no_taint", of_sequence([](const Facts& f) {
         return members(f.first().touched(f.first().apexes_t0, f.first().apexes_t0)).empty();
       })},
      {"no_ghost_contact_step2",
       of_sequence([=](const Facts& f) { return members(jumped(f)).empty(); })},
      {"K_plus_Vv_finds_nothing",
       of_sequence([=](const Facts& f) { return f.last().k_finds_nothing(jumped(f)); })},
      {"mutant_finds_nothing_exact",
       [](const Facts& f) {
         const auto result = said_by_mutant(f);
         return result ? std::optional(result->answer == detector::Answer::free) : std::nullopt;
       }},
      {"mutant_says_all_Vplus",
       [](const Facts& f) { return says_all_positive(said_by_mutant(f)); }},
      {"nonstrict_all_nonneg",
       [](const Facts& f) {
         return says_all_positive(said_by(f, find_fault("view/touching-zero-is-positive")));
       }},
      {"layers_differ", with([](const Facts& f) { return layer_classes(f.first()) > 1; })},
      {"four_triangles_at_one_edge", with([](const Facts& f) {
         std::map<oracle::DirectedEdge, int> uses;
         for (Eigen::Index t = 0; t < f.first().triangles.rows(); ++t) {
           for (int k = 0; k < 3; ++k) {
             const auto u = f.first().triangles(t, k), v = f.first().triangles(t, (k + 1) % 3);
             ++uses[{std::min(u, v), std::max(u, v)}];
           }
         }
         return std::any_of(uses.begin(), uses.end(), [](const auto& e) { return e.second == 4; });
       })},
      {"connected_by_shared_edge", with([](const Facts& f) {
         const auto component = layers(f.first()).component;
         return std::all_of(component.begin(), component.end(), [](auto c) { return c == 0; });
       })},
  };
}

}  // namespace assay::properties::test
