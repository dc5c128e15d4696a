// Laws about further questions to a detector: which pairs come within a distance (L16), how far a
// step may go (L17), and stopped steps.
#include <fmt/format.h>

#include <cmath>

#include "detector/assembly.h"
#include "properties/judging/agreement.h"
#include "properties/judging/contracted_case.h"
#include "properties/judging/verdict.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"
#include "properties/worker/case_run.h"

namespace assay::properties {
namespace {

// The oracle takes long for distances among many triangles.
constexpr std::size_t most_triangles_apart = 40;

// Returns a power of two, from an eighth of the mesh down to its 2^-20; 0 for a mesh without
// extent.
double drawn_distance(const CaseFacts& facts, Random& random) {
  const double extent = extent_of(facts.source());
  if (!(extent > 0) || !std::isfinite(extent)) return 0;
  return std::ldexp(1, std::ilogb(extent) - random.between(3, random.one_in(4) ? 20 : 8));
}

// Checks under one culling, because distances are the same under every culling of the case.
void check_distance(CaseFacts& facts, LawTally& tally) {
  if (!facts.stages_of() || facts.options().culling != Culling::view_line ||
      facts.surface().mesh.triangles.size() > most_triangles_apart)
    return;
  Random random(Random::hash(facts.source().id), Random::hash("distance"));
  Options options;
  options.culling = random.one_in(4) ? Culling::none : Culling::bvh;
  options.threads = static_cast<std::uint32_t>(random.between(1, 3));
  options.separation = drawn_distance(facts, random);
  if (!(options.separation > 0x1p-400 && options.separation < 0x1p400)) return;
  const Contract contract = contract_of(options);
  const auto& c = facts.source();
  auto creation =
      detector::assemble(c.triangles, c.frames.front(), options, facts.stages_of()(options));
  for (std::size_t s = 0; creation && s < facts.steps(); ++s) {
    const auto result = creation.value().step(facts.x_t0(s), facts.x_t1(s));
    const auto judgement = judge_under(contract, {facts.x_t0(s), facts.x_t1(s)}, c.triangles, {});
    const auto diff = compare(result, judgement, claims_of(options), contract, c.triangles);
    note(facts, s,
         diff.outcome == Outcome::holds
             ? ""
             : fmt::format("within {}, {}: {}", options.separation, name_of(options.culling),
                           diff.breaches.empty() ? "no answer"
                                                 : failure_of(diff, result, contract).explanation),
         tally);
  }
}

void check_limits(CaseFacts& facts, LawTally& tally) {
  if (!facts.stages_of() || facts.options().pairs != detector::Pairs::all) return;
  auto options = facts.options();
  if (options.start == detector::Start::clean) options.start = detector::Start::verified;
  auto player = CasePlayer::make(facts.source(), options, facts.stages_of()(options));
  auto alone = CasePlayer::make(facts.source(), options, facts.stages_of()(options));
  if (!player || !alone) return;
  Contract contract;
  contract.progress = built_in_progress;
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    const auto &x_t0 = facts.x_t0(s), &x_t1 = facts.x_t1(s);
    const auto limit = player.value().detector().limit(x_t0, x_t1);
    StepDiff diff;
    if (!limit.problem)
      judge_limit(LimitAnswer{limit.share, limit.positions},
                  {{x_t0, x_t1},
                   facts.source().triangles,
                   {},
                   facts.judgement(s),
                   claims_on_limits,
                   contract},
                  diff);
    std::string wrong = limit.problem ? "refused" : "";
    for (const auto claim : diff.breaches) wrong = fmt::format("{}", name_of(claim));
    // The state stays as it is.
    const StepResult after = player.value().play(s), expectation = alone.value().play(s);
    if (wrong.empty()) wrong = difference(expectation, after);
    if (facts.is_judged(s)) note(facts, s, wrong, tally);
  }
}

void check_stops(CaseFacts& facts, LawTally& tally) {
  if (!facts.stages_of()) return;
  const auto make = [&] {
    return CasePlayer::make(facts.source(), facts.options(), facts.stages_of()(facts.options()));
  };
  auto player = make(), alone = make();
  if (!player || !alone) return;
  Random random(Random::hash(facts.source().id), Random::hash("stops"));
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    std::string wrong;
    bool is_stopped = true;
    for (int stop_at = 1; is_stopped && stop_at < 100; stop_at += random.between(1, 4)) {
      int questions = 0;
      const auto answer = player.value().look(s, [&] { return ++questions == stop_at; });
      is_stopped = questions >= stop_at;
      if (!is_stopped) break;
      if (answer.answer != Answer::undecided) wrong = "the answer of a stopped step";
      if (!player.value().detector().commit()) wrong = "whether a stopped step commits";
    }
    const StepResult after = player.value().play(s);
    alone.value().play(s);
    if (wrong.empty()) wrong = difference(facts.result(s), after);
    if (wrong.empty() && player.value().detector().state() != alone.value().detector().state())
      wrong = "the state after the step";
    note(facts, s, wrong.empty() ? holds() : wrong + " differs", tally);
  }
}

constexpr int one_case_in_64 = 64;

constexpr Law question_law_table[] = {
    {"L16_WithinADistanceIsWhatTheOracleFinds", "L16",
     "A detector without views that is asked for the pairs within a distance finds the oracle's "
     "pairs, each at its time.",
     "pairs within a distance", check_distance, one_case_in_16},
    {"L17_LimitsAreFreeAndGoFar", "L17",
     "A limit allows a way that is free and at least nine tenths of the possible way, unless "
     "rounding prevents nine tenths; it allows a free step whole; it does not change the state.",
     "contacts in the step, and on the allowed way", check_limits, one_case_in_64},
    {"Change_StopsChangeNothing", "change",
     "A step that is stopped is undecided and cannot be committed; if it is evaluated whole "
     "afterwards, it gives the same bytes and the same state as a step that was never stopped.",
     "nothing", check_stops, one_case_in_16},
};

}  // namespace

std::span<const Law> question_laws() { return question_law_table; }

}  // namespace assay::properties
