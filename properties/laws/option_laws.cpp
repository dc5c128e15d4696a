// The claims of the detector, in a configuration that is drawn so that every two values of options,
// state, mesh and size meet.
#include "properties/laws/option_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "detector/assembly.h"
#include "properties/judging/trial.h"
#include "properties/laws/metamorphic/forms.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"
#include "properties/worker/case_player.h"

namespace assay::properties {
namespace {

using detector::StepResult;

// The two factors that come with the case, behind those that are chosen.
enum class MeshClass : std::uint8_t { closed, open, broken };
enum class SizeClass : std::uint8_t { few, some, many };

// What a detector has behind it when the case begins.
enum class StateBefore : std::uint8_t {
  fresh,      // nothing
  elsewhere,  // it has committed a step elsewhere
  carried,    // it has committed a step that ends where the case begins
  restored,   // before each step its state goes into a detector that has committed something else
  reset,      // it has played the case, and was reset
};
constexpr auto names_of(StateBefore) {
  using enum StateBefore;
  return std::to_array<Named<StateBefore>>({{fresh, "fresh"},
                                            {elsewhere, "elsewhere"},
                                            {carried, "carried"},
                                            {restored, "restored"},
                                            {reset, "reset"}});
}

// Those that prove nothing are left out.
constexpr detector::Arithmetic arithmetics[] = {detector::Arithmetic::exact,
                                                detector::Arithmetic::bounded};
constexpr std::uint32_t most_threads = 3;

constexpr FactorSizes factor_sizes = {all_values<detector::Culling>.size(),
                                      std::size(arithmetics),
                                      all_values<detector::Start>.size(),
                                      all_values<detector::Pairs>.size(),
                                      most_threads,
                                      all_values<StateBefore>.size(),
                                      2,
                                      3,
                                      3};

struct Drawn {
  detector::Options options;
  StateBefore state = StateBefore::fresh;
  bool is_scaled = false;  // by a power of two, up to the largest doubles or down to the least
};

Drawn drawn(const OptionRow& row) {
  Drawn d;
  d.options.culling = all_values<detector::Culling>[row[0]];
  d.options.arithmetic = arithmetics[row[1]];
  d.options.start = all_values<detector::Start>[row[2]];
  d.options.pairs = all_values<detector::Pairs>[row[3]];
  d.options.threads = row[4] + 1u;
  d.state = all_values<StateBefore>[row[5]];
  d.is_scaled = row[6] != 0;
  return d;
}

std::string text_of(const Drawn& d) {
  const auto& o = d.options;
  return fmt::format("{}, {}, start {}, pairs {}, {} threads, {}{}", name_of(o.culling),
                     name_of(o.arithmetic), name_of(o.start), name_of(o.pairs), o.threads,
                     name_of(d.state), d.is_scaled ? ", scaled" : "");
}

MeshClass mesh_class(const CaseFacts& facts) {
  return facts.surface().is_closed() ? MeshClass::closed
         : facts.has_broken_edges()  ? MeshClass::broken
                                     : MeshClass::open;
}

SizeClass size_class(const CaseFacts& facts) {
  constexpr std::size_t few = 12, some = 60;
  const auto count = facts.surface().mesh.triangles.size();
  return count <= few ? SizeClass::few : count <= some ? SizeClass::some : SizeClass::many;
}

// One of the rows of the case's mesh and size, of one of several arrays.
Drawn drawn_for(const CaseFacts& facts) {
  constexpr std::uint64_t arrays = 16;
  static const auto all = [] {
    std::vector<std::vector<OptionRow>> made;
    for (std::uint64_t seed = 0; seed < arrays; ++seed)
      made.push_back(covering_rows(factor_sizes, seed));
    return made;
  }();
  const auto own = static_cast<std::uint64_t>(facts.options().culling);
  Random random(Random::hash(facts.source().id), own);
  const auto& array = all[random.next() % arrays];
  const auto mesh = static_cast<std::uint8_t>(mesh_class(facts));
  const auto size = static_cast<std::uint8_t>(size_class(facts));
  std::vector<OptionRow> fitting;
  std::copy_if(array.begin(), array.end(), std::back_inserter(fitting),
               [&](const OptionRow& row) { return row[7] == mesh && row[8] == size; });
  return drawn(fitting[random.next() % fitting.size()]);
}

// The case behind the step that the state asks for.
corpus::Case with_step_before(corpus::Case c, StateBefore state) {
  const auto last = static_cast<std::int32_t>(c.frames.size()) - 1;
  auto script = corpus::steps_of(c);
  if (state == StateBefore::elsewhere) script.insert(script.begin(), {last, last, true});
  if (state == StateBefore::carried) script.insert(script.begin(), {last, script[0].from, true});
  c.script = std::move(script);
  return c;
}

// Goes on in a detector that was made elsewhere, and has committed something else.
bool go_on_elsewhere(CasePlayer& player, const corpus::Case& c, const detector::Options& options,
                     const StagesOf& stages_of) {
  const auto saved = detector::SavedState::read(player.detector().state().bytes());
  const auto& elsewhere = c.frames.back();
  auto made = detector::assemble(c.triangles, elsewhere, options, stages_of(options));
  if (!saved || !made) return false;
  made.value().step(elsewhere, elsewhere);
  if (made.value().restore(saved.value())) return false;
  player.detector() = std::move(made.value());
  return true;
}

// One result for each step of the case; fewer if a state was not taken, or the mesh is refused.
std::vector<StepResult> play(const corpus::Case& c, const Drawn& d, const StagesOf& stages_of) {
  auto player = CasePlayer::make(c, d.options, stages_of(d.options));
  if (!player) return {};
  const auto steps = player.value().steps();
  if (d.state == StateBefore::reset) {
    for (std::size_t s = 0; s < steps; ++s) player.value().play(s);
    player.value().detector().reset();
  }
  std::vector<StepResult> results;
  for (std::size_t s = 0; s < steps; ++s) {
    if (d.state == StateBefore::restored &&
        !go_on_elsewhere(player.value(), c, d.options, stages_of))
      break;
    results.push_back(player.value().play(s));
  }
  return results;
}

// Whether what the caller vouches for is true (CaseFacts::is_trusted). A step without views does
// not tell its apexes. All that it takes from a clean start is that nothing pierces its own
// component there; what has ghosts it leaves dirty (L15). So it will do if with the apexes of
// `facts` all is clean.
bool is_vouched_rightly(CaseFacts& told, CaseFacts& facts, std::size_t s, std::size_t before) {
  if (told.is_trusted(s)) return true;
  if (const auto& known = told.known_from(s))
    return is_vouched_rightly(told, facts, *known, before);
  if (s < before || told.has_views(s) || !facts.has_views(s - before)) return false;
  const auto& clean = facts.layers_at_start(s - before).clean;
  return std::all_of(clean.begin(), clean.end(), [](std::uint8_t c) { return c != 0; });
}

void check_options(CaseFacts& facts, LawTally& tally) {
  if (!facts.stages_of()) return;
  Drawn d = drawn_for(facts);
  const auto scaled = d.is_scaled ? scaled_form(facts.source()) : std::nullopt;
  d.is_scaled = scaled.has_value();  // some cases have no such form
  const corpus::Case c = with_step_before(scaled ? scaled->c : facts.source(), d.state);
  const auto results = play(c, d, facts.stages_of());
  const std::size_t steps = corpus::steps_of(c).size(), before = steps - facts.steps();
  if (results.size() < steps) {
    note(facts, 0, text_of(d) + ": refused", tally);
    return;
  }
  std::vector<oracle::StepJudgement> judgements(before);
  for (std::size_t s = 0; s < facts.steps(); ++s) judgements.push_back(facts.judgement(s));
  CaseFacts told(c, d.options, results, judgements, facts.surface(), facts.stages_of());
  const Claims claims = claims_of(d.options);
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    if (!facts.is_judged(s) || !is_vouched_rightly(told, facts, s + before, before)) continue;
    const auto& result = results[s + before];
    const auto diff = compare(result, facts.judgement(s), claims, {}, c.triangles);
    const std::string wrong =
        diff.outcome != Outcome::defect
            ? ""
            : fmt::format("{}: {}", text_of(d), failure_of(diff, result, {}).explanation);
    note(facts, s, wrong, tally);
  }
}

constexpr Law option_law_table[] = {
    {"Claim_InEveryPairOfOptions", "claim",
     "In a configuration that is drawn so that every two values of culling, arithmetic, start, "
     "pairs, threads, state before the case, mesh and size meet, the claims hold. Where the caller "
     "vouches for a clean start, that is true.",
     "contacts, and layers of a clean start", check_options, 4},
};

}  // namespace

std::span<const Law> option_laws() { return option_law_table; }

namespace {

// Which pairs of values stand together in some row.
class PairsOfValues {
 public:
  explicit PairsOfValues(const FactorSizes& sizes) {
    for (std::size_t f = 0; f < option_factors; ++f) {
      first_[f] = values_;
      values_ += sizes[f];
    }
    met_.assign(values_ * values_, 0);
  }
  bool met(std::size_t f, std::uint8_t a, std::size_t g, std::uint8_t b) const {
    return met_[(first_[f] + a) * values_ + first_[g] + b] != 0;
  }
  void add(const OptionRow& row) {
    for (std::size_t f = 0; f < option_factors; ++f) {
      for (std::size_t g = 0; g < option_factors; ++g)
        met_[(first_[f] + row[f]) * values_ + first_[g] + row[g]] = 1;
    }
  }

 private:
  std::array<std::size_t, option_factors> first_{};
  std::size_t values_ = 0;
  std::vector<std::uint8_t> met_;
};

struct TwoValues {
  std::size_t f, g;
  std::uint8_t a, b;
};

}  // namespace

std::vector<OptionRow> covering_rows(const FactorSizes& sizes, std::uint64_t seed) {
  Random random(seed, Random::hash("rows"));
  PairsOfValues pairs(sizes);
  std::vector<TwoValues> open;
  for (std::size_t f = 0; f < option_factors; ++f) {
    for (std::size_t g = f + 1; g < option_factors; ++g) {
      for (std::uint8_t a = 0; a < sizes[f]; ++a)
        for (std::uint8_t b = 0; b < sizes[g]; ++b) open.push_back({f, g, a, b});
    }
  }
  open = shuffled(random, std::move(open));
  std::vector<OptionRow> rows;
  for (; !open.empty(); open.pop_back()) {
    const auto [f, g, a, b] = open.back();
    if (pairs.met(f, a, g, b)) continue;
    OptionRow row{};
    std::array<bool, option_factors> is_set{};
    row[f] = a;
    row[g] = b;
    is_set[f] = is_set[g] = true;
    for (const auto i : shuffled(random, in_order(option_factors))) {
      const auto h = static_cast<std::size_t>(i);
      if (is_set[h]) continue;
      int most = -1;
      for (const auto value : shuffled(random, in_order(sizes[h]))) {
        int fresh = 0;
        for (std::size_t k = 0; k < option_factors; ++k)
          fresh += is_set[k] && !pairs.met(h, static_cast<std::uint8_t>(value), k, row[k]) ? 1 : 0;
        if (fresh <= most) continue;
        most = fresh;
        row[h] = static_cast<std::uint8_t>(value);
      }
      is_set[h] = true;
    }
    pairs.add(row);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace assay::properties
