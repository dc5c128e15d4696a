#include "properties/laws/metamorphic/forms.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "properties/laws/step_law.h"
#include "properties/random.h"
#include "properties/worker/case_run.h"

namespace assay::properties {
corpus::Case bare(const corpus::Case& c) {
  corpus::Case out;
  out.id = c.id;
  out.about = c.about;
  out.source = c.source;
  out.triangles = c.triangles;
  out.frames = c.frames;
  out.script = corpus::steps_of(c);
  return out;
}

namespace {

using detector::StepResult;
using detector::TimeEnclosure;
using detector::TrianglePair;

// A run that prescribes nothing, so that only mesh and steps are changed.
PinnedRun run_of(const corpus::Case& c) {
  PinnedRun run{c.triangles, c.frames, corpus::steps_of(c), {}, {}, {}, {}};
  run.primitives.resize(run.script.size());
  run.apexes.resize(run.script.size());
  return run;
}

corpus::Case case_of(const PinnedRun& run, const corpus::Case& c) {
  corpus::Case out = bare(c);
  out.triangles = run.triangles;
  out.frames = run.frames;
  out.script = run.script;
  return out;
}

std::vector<std::size_t> places(std::size_t count, std::size_t first = 0, std::size_t stride = 1) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < count; ++i) list.push_back(first + stride * i);
  return list;
}

Numbers triangles_in_order(const corpus::Case& c) {
  return in_order(static_cast<std::size_t>(c.triangles.rows()));
}

}  // namespace

std::optional<Form> form_by_change(const corpus::Case& c, MakeChange make, bool on_grid) {
  const PinnedRun own = run_of(c);
  const PinnedRun base = on_grid ? on_a_grid(own) : own;
  const auto change = make(c.id, base);
  if (!change) return std::nullopt;
  Form form{case_of(change->run, c), triangles_in_order(c), {}};
  for (std::size_t t = 0; t < form.parent.size(); ++t)
    form.parent[at(change->triangle[t])] = static_cast<std::int32_t>(t);
  if (base.frames == own.frames) form.step = places(base.script.size());
  return form;
}

namespace {

// What meets in a step meets in the step back too: the places at time t are those at 1 - t. A
// contact is closed faces that meet, so an edge that pierces a triangle at the start does too.
std::optional<Form> played_back(const corpus::Case& c) {
  Form form{bare(c), triangles_in_order(c), {}, false};
  std::reverse(form.c.frames.begin(), form.c.frames.end());
  std::reverse(form.c.script.begin(), form.c.script.end());
  const auto last = static_cast<std::int32_t>(c.frames.size()) - 1;
  for (auto& [from, to, commit] : form.c.script) {
    std::swap(from, to);
    from = last - from;
    to = last - to;
  }
  form.step = places(form.c.script.size());
  std::reverse(form.step.begin(), form.step.end());
  return form;
}

// Plays all steps in another order, and then the case.
std::optional<Form> after_other_steps(const corpus::Case& c) {
  Form form{bare(c), triangles_in_order(c), {}};
  const auto script = form.c.script;
  Random random(Random::hash(c.id), Random::hash("order of steps"));
  form.c.script = shuffled(random, script);
  form.step = places(script.size(), script.size());
  form.c.script.insert(form.c.script.end(), script.begin(), script.end());
  return form;
}

// Evaluates before each step the way back, and a step in which nothing moves.
std::optional<Form> between_evaluations(const corpus::Case& c) {
  Form form{bare(c), triangles_in_order(c), {}};
  form.c.script.clear();
  for (const auto& step : corpus::steps_of(c)) {
    form.c.script.push_back({step.to, step.from, false});
    form.c.script.push_back({step.from, step.from, false});
    form.step.push_back(form.c.script.size());
    form.c.script.push_back(step);
  }
  return form;
}

std::optional<Form> in_halves(const corpus::Case& c) {
  auto run = halved_run(on_a_grid(run_of(c)));
  if (!run) return std::nullopt;
  return Form{case_of(*run, c), triangles_in_order(c), {}, false};
}

constexpr FormLaw step_forms[] = {
    {"Change_StepHalved", in_halves},
    {"Change_StepReversed", played_back},
    {"Change_StepsBeforeDoNotShow", after_other_steps},
    {"Change_EvaluateChangesNothing", between_evaluations, true},
    {"L18_RefinedMeshHasTheSameContacts", refined},
};

constexpr Law step_form_laws[] = {
    {"Change_StepReversed", "change",
     "A sequence played back, each step from its end to its start, has the pairs of each step, and "
     "is free where it was free.",
     "nothing", check_form<played_back>, one_case_in_16},
    {"Change_StepsBeforeDoNotShow", "change",
     "Played after its own steps in another order, a sequence has the answers, pairs and times "
     "that "
     "it has at first.",
     "nothing", check_form<after_other_steps>, one_case_in_16},
};

// The pairs as pairs of triangles of the case, each with the least of its times. What meets another
// part of its own triangle is no contact of the case.
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

}  // namespace

std::span<const Law> form_of_steps_laws() { return step_form_laws; }

std::vector<FormLaw> form_laws() {
  const auto changes = change_forms();
  std::vector<FormLaw> all(changes.begin(), changes.end());
  all.insert(all.end(), std::begin(step_forms), std::end(step_forms));
  return all;
}

bool is_of_plugins(const Law& law) {
  static const auto forms = form_laws();
  return law.name == threads_law ||
         std::any_of(forms.begin(), forms.end(),
                     [&](const FormLaw& form) { return form.law == law.name; });
}

bool is_given_in_form(const FormLaw& law, std::string_view case_id) {
  // With twelve forms about a fifth of the cases is run once more.
  constexpr int one_case_in = 64;
  return Random(Random::hash(case_id), Random::hash(law.law)).one_in(one_case_in);
}

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
  const bool same = std::equal(
      before.begin(), before.end(), after.begin(), after.end(), [&](const auto& a, const auto& b) {
        return a.first == b.first && (!form.same_times || a.second == b.second);
      });
  return same ? ""
              : fmt::format("{} pairs became {}, or others, or other times", before.size(),
                            after.size());
}

void check_form(CaseFacts& facts, LawTally& tally, MakeForm make) {
  if (!facts.stages_of()) return;
  const auto form = make(facts.source());
  if (!form || form->step.empty()) return;
  auto options = facts.options();
  // Nobody vouches for the starts of the form, which may be others.
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

}  // namespace assay::properties
