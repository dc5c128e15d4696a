#include "properties/laws/facts/case_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "detector/boundary/boundary_handler.h"
#include "oracle/instant/layers.h"
#include "oracle/view/touched_by_ghosts.h"
#include "oracle/view/view_sign.h"

namespace assay::properties {

namespace {

Triangles rows_of(const detector::Topology& surface, std::span<const std::int32_t> triangles) {
  std::vector<std::array<std::int32_t, 3>> corners;
  for (const auto t : triangles) corners.push_back(surface.triangles[at(t)]);
  return as_rows<Triangles>(corners);
}

Positions apex_rows(const StepResult& result, bool at_end) {
  return detector::with_apexes(Positions(0, 3), result.apexes, at_end);
}

bool same_places(const Positions& a, const Positions& b) { return a.rows() == b.rows() && a == b; }

}  // namespace

struct CaseFacts::StepFacts {
  std::optional<std::vector<ViewSign>> signs;
  std::optional<std::vector<std::uint8_t>> touched, own_contacts;
  std::optional<oracle::Candidates> candidates;
  std::map<std::size_t, std::optional<int>> winding;
  std::optional<ValueRange> range;
  std::optional<CertifiedPatches> certified_patches;
  std::optional<bool> trusted;
};

CaseFacts::CaseFacts(const Case& source, const Options& options,
                     std::span<const StepResult> results, std::span<const StepJudgement> judgements,
                     const detector::Surface& surface, StagesOf stages_of)
    : source_(source),
      options_(options),
      results_(results),
      judgements_(judgements),
      surface_(surface),
      stages_of_(std::move(stages_of)),
      script_(steps_of(source)) {
  assert(results.size() == script_.size() && judgements.size() == script_.size());
  std::optional<std::size_t> committed;
  for (std::size_t s = 0; s < script_.size(); ++s) {
    const bool is_known = committed && same_places(x_t1(*committed), x_t0(s));
    known_from_.push_back(is_known ? committed : std::nullopt);
    if (script_[s].commit && is_answered(results_[s])) committed = s;
  }
  const auto own = surface_.mesh.triangles.size();
  ghosts_ = as_rows<Triangles>(std::span(surface_.all().triangles).subspan(own));
  facts_.resize(script_.size());
}

CaseFacts::~CaseFacts() = default;

bool CaseFacts::has_views(std::size_t s) const {
  const auto& r = results_[s];
  return is_answered(r) && r.signs.size() == surface_.all().triangles.size() &&
         r.doubts.size() == surface_.mesh.triangles.size() &&
         r.primitives.size() == surface_.mesh.components.size() &&
         r.apexes.size() == surface_.loops.size();
}

bool CaseFacts::starts_by_view_alone() const {
  return options_.start == detector::Start::verified && detector::chooses_views(options_.culling);
}

bool CaseFacts::has_ghosts(std::size_t component) const {
  return surface_.all().components[component].triangles.size() >
         surface_.mesh.components[component].triangles.size();
}

bool CaseFacts::has_broken_edges() const {
  const auto& mesh = surface_.mesh;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto around = mesh.edge_triangles.row(static_cast<std::int32_t>(e));
    if (around.size() > 2) return true;
    if (around.size() < 2) continue;
    const auto runs_upward = [&](std::int32_t t) {
      const auto& v = mesh.triangles[at(t)];
      const auto i = static_cast<std::size_t>(std::ranges::find(v, mesh.edges[e][0]) - v.begin());
      return v[(i + 1) % 3] == mesh.edges[e][1];
    };
    if (runs_upward(around[0]) == runs_upward(around[1])) return true;
  }
  return false;
}

Positions CaseFacts::all_t0(std::size_t s) const {
  return oracle::with_apexes(x_t0(s), apex_rows(results_[s], false));
}

Positions CaseFacts::all_t1(std::size_t s) const {
  return oracle::with_apexes(x_t1(s), apex_rows(results_[s], true));
}

bool CaseFacts::is_trusted(std::size_t s) {
  if (options_.start != detector::Start::clean) return true;
  auto& trusted = facts_[s].trusted;
  if (trusted) return *trusted;
  // If a caller vouched wrongly for one start, the steps that continue from it are wrong too.
  if (known_from_[s]) return *(trusted = is_trusted(*known_from_[s]));
  // A step without views does not tell its apexes, so nothing can be said of an unclosed mesh.
  if (!surface_.is_closed() && !has_views(s)) return *(trusted = false);
  const auto& clean = layers_at_start(s).clean;
  trusted = std::ranges::all_of(clean, [](std::uint8_t c) { return c != 0; });
  return *trusted;
}

const std::vector<ViewSign>& CaseFacts::signs(std::size_t s) {
  auto& signs = facts_[s].signs;
  if (signs) return *signs;
  const auto& all = surface_.all();
  std::vector<ViewPrimitive> primitives(all.triangles.size());
  std::vector<std::int32_t> every(all.triangles.size());
  for (std::size_t c = 0; c < all.components.size(); ++c) {
    for (const auto t : all.components[c].triangles) {
      primitives[at(t)] = results_[s].primitives[c];
      every[at(t)] = t;
    }
  }
  signs = oracle::view_signs({all_t0(s), all_t1(s)}, rows_of(all, every), primitives);
  return *signs;
}

const std::vector<std::uint8_t>& CaseFacts::touched(std::size_t s) {
  auto& touched = facts_[s].touched;
  if (touched) return *touched;
  touched.emplace(surface_.mesh.triangles.size(), 0);
  const bool is_new = !known_from_[s];
  const Positions apexes_t0 = apex_rows(results_[s], false);
  const Positions apexes_t1 = apex_rows(results_[s], true);
  for (std::size_t c = 0; c < surface_.mesh.components.size(); ++c) {
    const std::span<const std::int32_t> own = surface_.mesh.components[c].triangles;
    const auto ghosts = std::span(surface_.all().components[c].triangles).subspan(own.size());
    if (ghosts.empty()) continue;
    const auto part =
        oracle::touched_by_ghosts({x_t0(s), x_t1(s)}, rows_of(surface_.all(), own), apexes_t0,
                                  apexes_t1, rows_of(surface_.all(), ghosts), is_new);
    for (std::size_t i = 0; i < part.size(); ++i) (*touched)[at(own[i])] = part[i];
  }
  return *touched;
}

const oracle::Candidates& CaseFacts::candidates(std::size_t s) {
  auto& candidates = facts_[s].candidates;
  if (candidates) return *candidates;
  const auto& all = signs(s);
  const auto own = static_cast<std::ptrdiff_t>(surface_.mesh.triangles.size());
  candidates.emplace(std::vector(all.begin(), all.begin() + own), results_[s].doubts,
                     surface_.mesh.component_of_triangle);
  return *candidates;
}

std::optional<int> CaseFacts::winding_at_start(std::size_t s, std::size_t component) {
  auto& winding = facts_[s].winding;
  if (const auto place = winding.find(component); place != winding.end()) return place->second;
  const auto& all = surface_.all();
  const oracle::Instant start(all_t0(s));
  const oracle::WindingField field(start, rows_of(all, all.components[component].triangles));
  return winding[component] = field.at(results_[s].primitives[component].q0.t0);
}

bool CaseFacts::is_free_by_view(std::size_t s, std::size_t component) {
  const auto& triangles = surface_.all().components[component].triangles;
  const auto& of_step = signs(s);
  return std::ranges::all_of(
             triangles, [&](std::int32_t t) { return of_step[at(t)] == ViewSign::positive; }) &&
         winding_at_start(s, component) == 1;
}

const oracle::LayerState& CaseFacts::layers_of(const Positions& all) {
  for (const auto& [places, layers] : layers_) {
    if (same_places(places, all)) return *layers;
  }
  const Triangles mesh = source_.triangles;
  layers_.emplace_back(all, std::make_unique<oracle::LayerState>(
                                oracle::layers_at(oracle::Instant(all), mesh, ghosts_)));
  return *layers_.back().second;
}

const oracle::LayerState& CaseFacts::layers_at_start(std::size_t s) { return layers_of(all_t0(s)); }

const oracle::LayerState& CaseFacts::layers_at_end(std::size_t s) { return layers_of(all_t1(s)); }

const std::vector<std::uint8_t>& CaseFacts::own_contacts(std::size_t s) {
  auto& flags = facts_[s].own_contacts;
  if (flags) return *flags;
  flags.emplace(surface_.mesh.triangles.size(), 0);
  for (const auto& contact : judgements_[s].pairs) {
    if (same_component(contact.pair)) {
      (*flags)[at(contact.pair.a)] = (*flags)[at(contact.pair.b)] = 1;
    }
  }
  return *flags;
}

const ValueRange& CaseFacts::view_range(std::size_t s) {
  auto& range = facts_[s].range;
  if (range) return *range;
  const Positions all_start = all_t0(s), all_end = all_t1(s);
  for (std::size_t c = 0; c < surface_.mesh.components.size(); ++c) {
    const auto part = properties::view_range(surface_.all(), surface_.all().components[c].triangles,
                                             {all_start, all_end}, results_[s].primitives[c]);
    if (range) range->widen(part);
    if (!range) range = part;
  }
  return *range;
}

bool CaseFacts::is_close(std::size_t s) {
  return has_views(s) && properties::is_close(view_range(s));
}

TraditionalScheme* CaseFacts::traditional_scheme() {
  if (!traditional_scheme_) {
    traditional_scheme_.emplace();
    if (stages_of_) {
      Options traditional = options_;
      traditional.culling = Culling::normal_cone;
      *traditional_scheme_ =
          TraditionalScheme::make(stages_of_(traditional), surface_.mesh, source_.frames.front());
    }
  }
  return traditional_scheme_->get();
}

const CertifiedPatches& CaseFacts::certified_patches(std::size_t s) {
  auto& patches = facts_[s].certified_patches;
  if (!patches) patches = traditional_scheme()->certify({x_t0(s), x_t1(s)});
  return *patches;
}

PairBlock block_of(ViewSign a, ViewSign b, bool either_violated) {
  if (either_violated) return PairBlock::violated;
  if (a == ViewSign::zero && b == ViewSign::zero) return PairBlock::zero_zero;
  if (a == ViewSign::zero || b == ViewSign::zero) {
    const ViewSign other = a == ViewSign::zero ? b : a;
    return other == ViewSign::positive ? PairBlock::positive_zero : PairBlock::negative_zero;
  }
  if (a != b) return PairBlock::positive_negative;
  return a == ViewSign::positive ? PairBlock::positive_positive : PairBlock::negative_negative;
}

using OptionalLayers = std::vector<std::optional<oracle::Layer>>;  // by component

namespace {

std::size_t component_of(const CaseFacts& facts, std::size_t triangle) {
  return at(facts.component_of(static_cast<std::int32_t>(triangle)));
}

// Returns whether every triangle of S is positive where the step starts.
bool is_positive_at_start(CaseFacts& facts, std::size_t s, std::size_t component) {
  auto still = facts.result(s).primitives[component];
  still.q0.t1 = still.q0.t0;
  still.q1.t1 = still.q1.t0;
  const auto x = facts.all_t0(s);
  const auto& surface = facts.surface().all();
  const auto& triangles = surface.components[component].triangles;
  return std::ranges::all_of(triangles, [&](std::int32_t t) {
    const auto& v = surface.triangles[at(t)];
    const auto corner = [&](std::size_t i) { return SteppedMesh{x, x}.path(v[i]); };
    return oracle::view_sign({corner(0), corner(1), corner(2)}, still) == ViewSign::positive;
  });
}

// Returns which triangles of `in_question` are untouched and in the right layer: that of the
// triangles of their component that are not in doubt or, if there are none, the common layer.
TriangleFlags clean_beside(CaseFacts& facts, std::size_t s, const TriangleFlags& in_question,
                           const TriangleFlags& in_doubt) {
  const auto& layers = facts.layers_at_start(s);
  OptionalLayers layers_in_doubt(facts.surface().mesh.components.size());
  for (std::size_t t = 0; t < in_doubt.size(); ++t) {
    auto& layer = layers_in_doubt[component_of(facts, t)];
    if (!layer && !in_doubt[t]) layer = layers.layer[t];
  }
  TriangleFlags clean(in_doubt.size(), 0);
  for (std::size_t t = 0; t < in_doubt.size(); ++t) {
    if (!in_question[t] || layers.touched[t]) continue;
    const auto& layer = layers_in_doubt[component_of(facts, t)];
    clean[t] = layer ? layer == layers.layer[t] : layers.clean[t] != 0;
  }
  return clean;
}

TriangleFlags dirty_at_a_new_start(CaseFacts& facts, std::size_t s) {
  const auto start = facts.options().start;
  const bool looks_alone = facts.starts_by_view_alone();
  TriangleFlags dirty;
  if (!looks_alone && start != detector::Start::unknown) {
    for (const auto clean : facts.layers_at_start(s).clean) dirty.push_back(clean == 0);
    return dirty;
  }
  TriangleFlags free;
  for (std::size_t c = 0; c < facts.surface().mesh.components.size(); ++c)
    free.push_back(facts.is_free_by_view(s, c) ||
                   (looks_alone && is_free_by_view_at_start(facts, s, c)));
  for (std::size_t t = 0; t < facts.surface().mesh.triangles.size(); ++t)
    dirty.push_back(!free[component_of(facts, t)]);
  return dirty;
}

}  // namespace

bool is_free_by_view_at_start(CaseFacts& facts, std::size_t s, std::size_t component) {
  return is_positive_at_start(facts, s, component) && facts.winding_at_start(s, component) == 1;
}

std::string what_is_not_clean(const CaseFacts& facts, const oracle::LayerState& layers,
                              const TriangleFlags& is_held) {
  OptionalLayers shared(facts.surface().mesh.components.size());
  for (std::size_t t = 0; t < is_held.size(); ++t) {
    if (!is_held[t]) continue;
    if (layers.touched[t]) return fmt::format("triangle {} is touched", t);
    auto& layer = shared[component_of(facts, t)];
    if (!layer) layer = layers.layer[t];
    if (layer != layers.layer[t]) return fmt::format("triangle {} is of another layer", t);
  }
  return {};
}

TriangleFlags may_be_clean(CaseFacts& facts, std::size_t s, const TriangleFlags& in_question) {
  TriangleFlags in_doubt = dirty_triangles(facts, s);
  for (std::size_t t = 0; t < in_doubt.size(); ++t) in_doubt[t] |= in_question[t];
  return clean_beside(facts, s, in_question, in_doubt);
}

bool has_account(CaseFacts& facts, std::size_t s) {
  if (facts.options().arithmetic != Arithmetic::exact) return false;
  if (!facts.is_judged(s) || !facts.is_trusted(s)) return false;
  const auto p = facts.known_from(s);
  return !p || has_account(facts, *p);
}

TriangleFlags in_doubt_after(CaseFacts& facts, std::size_t s) {
  TriangleFlags flags = account_of_dirty(facts, s);
  const bool has_views = facts.has_views(s);
  const bool incomplete = facts.options().pairs != detector::Pairs::all &&
                          facts.judgement(s).answer == Answer::collision;
  for (std::size_t t = 0; t < flags.size(); ++t) {
    const bool swept_clean =
        has_views ? !facts.touched(s)[t] : !facts.has_ghosts(component_of(facts, t));
    flags[t] |= incomplete | facts.own_contacts(s)[t] | !swept_clean;
  }
  return flags;
}

TriangleFlags account_of_dirty(CaseFacts& facts, std::size_t s) {
  const auto p = facts.known_from(s);
  if (!facts.has_views(s)) {
    if (p) return in_doubt_after(facts, *p);
    return TriangleFlags(facts.surface().mesh.triangles.size(),
                         facts.options().start != detector::Start::clean);
  }
  if (!p) return dirty_at_a_new_start(facts, s);
  TriangleFlags dirty = in_doubt_after(facts, *p);
  const auto released = clean_beside(facts, s, dirty, dirty);
  for (std::size_t t = 0; t < dirty.size(); ++t) dirty[t] = dirty[t] && !released[t];
  return dirty;
}

TriangleFlags dirty_triangles(const CaseFacts& facts, std::size_t s) {
  TriangleFlags dirty;
  for (const auto doubts : facts.result(s).doubts) {
    dirty.push_back((doubts & detector::doubt::dirty) != 0);
  }
  return dirty;
}

}  // namespace assay::properties
