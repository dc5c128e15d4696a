#include "properties/laws/metamorphic/change_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "properties/laws/metamorphic/pinned_run.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"
#include "properties/worker/case_run.h"

namespace assay::properties {

bool is_of_plugins(const Law& law) { return law.change || law.name == threads_law; }

bool is_given_in_form(const Law& law, std::string_view case_id) {
  // With twelve forms about a fifth of the cases is run once more.
  constexpr int one_case_in = 64;
  return Random(Random::hash(case_id), Random::hash(law.name)).one_in(one_case_in);
}

namespace {

// Returns the pairs as pairs of triangles of the case, each with the least of its times. A contact
// of two parts of one triangle is no contact of the case.
std::map<TrianglePair, TimeEnclosure> pairs_of_parents(const StepResult& result,
                                                       const std::vector<std::int32_t>* parent) {
  std::map<TrianglePair, TimeEnclosure> pairs;
  for (const auto& contact : result.pairs) {
    auto [a, b] = contact.pair;
    if (parent) {
      a = (*parent)[at(a)];
      b = (*parent)[at(b)];
    }
    if (a == b) continue;
    const auto [place, is_new] =
        pairs.emplace(TrianglePair{std::min(a, b), std::max(a, b)}, contact.time);
    if (is_new) continue;
    place->second.lo = std::min(place->second.lo, contact.time.lo);
    place->second.hi = std::min(place->second.hi, contact.time.hi);
  }
  return pairs;
}

// Returns whether two layer classes of a component have the same size. The order of triangles then
// decides which is the common one (L9). Looks at the start of the step, and at the starts of the
// steps from which its state comes.
bool common_layer_is_tied(CaseFacts& facts, std::size_t s) {
  for (std::optional<std::size_t> start = s; start; start = facts.known_from(*start)) {
    const auto& layers = facts.layers_at_start(*start);
    std::map<std::pair<std::int32_t, oracle::Layer>, std::size_t> sizes;
    for (std::size_t t = 0; t < layers.layer.size(); ++t) {
      if (layers.layer[t]) ++sizes[{layers.component[t], *layers.layer[t]}];
    }
    for (const auto& [key, size] : sizes) {
      const auto& common = layers.common[at(key.first)];
      if (common && key.second != *common && size == sizes.at({key.first, *common})) return true;
    }
  }
  return false;
}

// Returns the set of the triangle if all of the mesh is turned over.
ViewSign swapped(ViewSign sign) { return static_cast<ViewSign>(-static_cast<int>(sign)); }

std::array<std::size_t, 6> sizes_of_sets(const StepResult& result, bool swaps_signs) {
  const auto &positive = result.view_positive, &negative = result.view_negative;
  return {swaps_signs ? negative : positive,
          swaps_signs ? positive : negative,
          result.view_zero,
          result.against_all,
          result.violated,
          result.dirty};
}

// Compares a step. `exact_start` says that the results rest on the positions of the case itself;
// the oracle's layers are layers at these positions.
std::string compare_step(CaseFacts& facts, std::size_t s, const StepResult& base, const Form& form,
                         const StepResult& other, bool exact_start) {
  auto differs = difference_in_form(base, form, other, false);
  if (!differs.empty()) return differs;
  auto signs = base.signs;
  auto doubts = base.doubts;
  for (std::size_t t = 0; t < form.parent.size(); ++t) {
    const auto sign = other.signs[t];
    signs[at(form.parent[t])] = form.swaps_signs ? swapped(sign) : sign;
    doubts[at(form.parent[t])] = other.doubts[t];
  }
  for (std::size_t t = 0; t < doubts.size(); ++t) {
    if (signs[t] != base.signs[t]) return fmt::format("triangle {} has another sign", t);
  }
  if (doubts == base.doubts) {
    if (sizes_of_sets(base, false) != sizes_of_sets(other, form.swaps_signs))
      return "the sizes of the view sets differ";
    return difference_in_form(base, form, other);
  }
  const bool may_differ =
      form.swaps_signs ? facts.known_from(s) || facts.options().start != detector::Start::verified
                       : exact_start && common_layer_is_tied(facts, s);
  if (!may_differ) return "other triangles are violated or dirty";
  const bool all_pairs = facts.options().pairs == detector::Pairs::all;
  return difference_in_form(base, form, other, all_pairs);
}

}  // namespace

std::string difference_in_form(const StepResult& of_case, const Form& form,
                               const StepResult& of_form, bool pairs) {
  if (of_form.problem) return "refused: " + of_form.problem->message;
  if (of_case.answer != of_form.answer)
    return fmt::format("{} became {}", name_of(of_case.answer), name_of(of_form.answer));
  if (form.same_times && of_case.first != of_form.first)
    return fmt::format("first time [{}, {}] became [{}, {}]", of_case.first.lo, of_case.first.hi,
                       of_form.first.lo, of_form.first.hi);
  if (!pairs) return {};
  const auto before = pairs_of_parents(of_case, nullptr);
  const auto after = pairs_of_parents(of_form, &form.parent);
  const bool same = std::ranges::equal(before, after, [&](const auto& a, const auto& b) {
    return a.first == b.first && (!form.same_times || a.second == b.second);
  });
  return same ? ""
              : fmt::format("the {} pairs became {} pairs, of other triangles or at other times",
                            before.size(), after.size());
}

void check_change(CaseFacts& facts, LawTally& tally, const CaseChange& change) {
  auto base = pinned_run(facts);
  if (base && change.on_grid) base = on_a_grid(std::move(*base));
  const auto form = base ? change.of(*base) : std::nullopt;
  if (!form) return;
  const auto player_of = [&](const Case& run) {
    return PinnedPlayer::make(run, options_with_views(facts), facts.stages_of());
  };
  auto player = change.on_grid ? player_of(*base) : std::nullopt, other = player_of(form->c);
  if (!other || (change.on_grid && !player)) return;
  const auto before = player ? player->play() : std::vector<StepResult>(), after = other->play();
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    const auto& result = player ? before[s] : facts.result(s);
    note(facts, s, compare_step(facts, s, result, *form, after[s], !change.on_grid), tally);
  }
}

void check_form(CaseFacts& facts, LawTally& tally, const CaseChange& change) {
  if (!facts.stages_of()) return;
  const auto form = form_of(change, facts.source());
  if (!form || form->step.empty()) return;
  auto options = facts.options();
  // Nobody vouches for the starts of the form, because they may differ.
  if (options.start == detector::Start::clean) options.start = detector::Start::verified;
  auto player = CasePlayer::make(form->c, options, facts.stages_of()(options));
  if (!player) return;
  std::vector<StepResult> results;
  for (std::size_t s = 0; s < player.value().steps(); ++s)
    results.push_back(player.value().play(s));
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    if (!facts.is_trusted(s)) continue;
    note(facts, s,
         difference_in_form(facts.result(s), *form, results[form->step[s]],
                            options.pairs == detector::Pairs::all),
         tally);
  }
}

namespace {

template <const CaseChange& change>
constexpr Law law_of(std::string_view name, std::string_view statement,
                     std::string_view needs = "nothing") {
  return {name,
          "change",
          statement,
          needs,
          check_change<change>,
          one_case_in_16,
          PremiseScope::any_culling,
          &change};
}

constexpr Law change_law_table[] = {
    {"L18_RefinedMeshHasTheSameContacts", "L18",
     "Splitting edges at exact places, in all of their triangles and without a loss of area, "
     "changes no times and no pairs, if each part counts as the triangle that it came from.",
     "nothing", check_form<changes::split_edges>, one_case_in_16, PremiseScope::any_culling,
     &changes::split_edges},
    law_of<changes::vertex_numbers>(
        "Change_VertexNumbers",
        "If its vertices are renumbered, a mesh has the same pairs, times, signs and sets.",
        "layers, where two classes tie"),
    law_of<changes::triangle_order>(
        "Change_TriangleOrder",
        "If its triangles are in another order and begin at other corners, a mesh has the same "
        "pairs, times and signs, and the same sets unless two layer classes tie.",
        "layers, where two classes tie"),
    law_of<changes::power_of_two>("Change_PowerOfTwo",
                                  "If a mesh is scaled by a power of two, so that no coordinate "
                                  "loses a bit, all answers are the same."),
    law_of<changes::translation>("Change_Translation",
                                 "If a mesh is translated exactly (after its coordinates are "
                                 "rounded to a grid), all answers are the same."),
    law_of<changes::mirror>("Change_Mirror",
                            "If a mesh is mirrored, and turned over so that outside stays outside, "
                            "all answers are the same."),
    law_of<changes::axes>("Change_AxesExchanged",
                          "If axes are exchanged (and triangles turned over if that mirrors), all "
                          "answers are the same."),
    law_of<changes::inside_out>(
        "Change_InsideOutSwapsSigns",
        "If all triangles are turned over, V+ and V- change places; pairs, times and the doubts of "
        "a verified start stay (L5 releases outward surfaces alone)."),
};

}  // namespace

std::span<const Law> change_laws() { return change_law_table; }

}  // namespace assay::properties
