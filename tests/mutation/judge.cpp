// mutant_judge FACTS: compares the detector that is linked here with the facts of the oracle. Ends
// with 1 and one line at the first contradiction. It does not use CGAL.
#include <algorithm>
#include <cstdio>
#include <set>

#include "detector/contact/elementary.h"
#include "tests/mutation/settings.h"

namespace assay::mutation {
namespace {

using detector::Answer, detector::Arithmetic, detector::StepResult, detector::Want;

const char* wrong_query(const QueryFact& fact) {
  const auto timed = detector::test_contact(fact.query, Want::first_time);
  if (timed.contact != fact.contact) return "a query's contact";
  if (timed.contact && timed.time != fact.first) return "a query's time";
  if (detector::test_contact(fact.query, Want::yes_no).contact != fact.contact) return "yes or no";
  for (const auto want : {Want::first_time, Want::yes_no}) {
    const auto bounded = detector::test_contact(fact.query, want, Arithmetic::bounded);
    if (!fact.contact) continue;
    if (!bounded.contact) return "a contact missed by bounded arithmetic";
    if (want == Want::yes_no) continue;
    if (bounded.time.lo > fact.first.lo || bounded.time.hi < fact.first.hi) {
      return "a time outside of its bounds";
    }
  }
  return nullptr;
}

const detector::PairContact* found(const StepResult& result, const detector::TrianglePair& pair) {
  for (const auto& contact : result.pairs) {
    if (contact.pair == pair) return &contact;
  }
  return nullptr;
}

// Contacts in exact arithmetic: the oracle's own times; all pairs, or of each part of the contact
// graph at the first time at least one.
const char* wrong_pairs(const StepResult& result, const StepFact& fact, detector::Pairs claimed) {
  if (fact.first && result.first != *fact.first) return "first time";
  std::set<std::int32_t> parts, parts_found;
  std::size_t right = 0;
  for (const auto& p : fact.pairs) {
    const auto* contact = found(result, p.pair);
    // Of pairs that are not candidates of their own a first time is not claimed.
    const bool all = claimed == detector::Pairs::all;
    if (contact && (all ? contact->time != p.time : contact->time < p.time))
      return "time of a pair";
    right += contact != nullptr;
    if (!contact && all) return "missing pair";
    if (p.part < 0) continue;
    parts.insert(p.part);
    if (contact && contact->time == p.time) parts_found.insert(p.part);
  }
  if (parts != parts_found) return "no pair of a part of the contact graph";
  if (right != result.pairs.size()) return "spurious pair";
  const auto by_pair = [](const auto& a, const auto& b) { return a.pair < b.pair; };
  return std::is_sorted(result.pairs.begin(), result.pairs.end(), by_pair) ? nullptr : "order";
}

// Never a miss, never late.
const char* wrong_bounds(const StepResult& result, const StepFact& fact) {
  if (!fact.first) return nullptr;
  if (result.first.lo > fact.first->lo) return "late in bounded arithmetic";
  for (const auto& p : fact.pairs) {
    const auto* contact = found(result, p.pair);
    if (!contact) return "missing pair in bounded arithmetic";
    if (contact->time.lo > p.time.lo || contact->time.hi < p.time.hi) return "bounds of a pair";
  }
  return nullptr;
}

bool same_path(const detector::MovingPoint& a, const detector::MovingPoint& b) {
  return a.t0 == b.t0 && a.t1 == b.t1;
}

// Seen from where the facts were: another place is no mistake.
bool same_places(const StepResult& result, const ViewFact& fact) {
  const auto same = [](const detector::ViewPrimitive& a, const detector::ViewPrimitive& b) {
    return same_path(a.q0, b.q0) && same_path(a.q1, b.q1);
  };
  const auto& p = result.primitives;
  const auto& a = result.apexes;
  return std::equal(p.begin(), p.end(), fact.primitives.begin(), fact.primitives.end(), same) &&
         std::equal(a.begin(), a.end(), fact.apexes.begin(), fact.apexes.end(), same_path);
}

const char* wrong_sets(const StepResult& r, const ViewFact& fact) {
  if (r.signs != fact.signs) return "signs";
  if (r.doubts != fact.doubts) return "violated or dirty";
  std::size_t sizes[6] = {};  // V+, V-, V0, Vv, violated, dirty
  for (std::size_t t = 0; t < fact.doubts.size(); ++t) {
    const auto sign = fact.signs[t];
    ++sizes[fact.doubts[t] != 0                    ? 3
            : sign == detector::ViewSign::positive ? 0
            : sign == detector::ViewSign::negative ? 1
                                                   : 2];
    sizes[4] += (fact.doubts[t] & detector::doubt::violated) != 0;
    sizes[5] += (fact.doubts[t] & detector::doubt::dirty) != 0;
  }
  const std::size_t reported[6] = {r.view_positive, r.view_negative, r.view_zero,
                                   r.against_all,   r.violated,      r.dirty};
  return std::equal(sizes, sizes + 6, reported) ? nullptr : "sizes of the view sets";
}

const char* wrong_step(const StepResult& result, const StepFact& fact, const Setting& setting) {
  const bool bounded = setting.options.arithmetic == Arithmetic::bounded;
  const bool collision = result.answer == Answer::collision;
  if (!collision && result.answer != Answer::free) return "no answer";
  if (collision != fact.first.has_value() && !(bounded && collision)) return "answer";
  return bounded ? wrong_bounds(result, fact) : wrong_pairs(result, fact, setting.options.pairs);
}

bool holds(const CaseFact& c, std::size_t number) {
  const Setting& setting = settings()[number];
  const auto wrong = [&](std::size_t step, const char* problem) {
    std::printf("%s, step %zu, %s: %s\n", c.id.c_str(), step + 1, setting.name.data(), problem);
    return false;
  };
  auto made = detector::Detector::create(c.triangles, c.frames.front(), setting.options);
  if (c.steps.empty()) return !made || wrong(0, "not refused");
  if (!made) return wrong(0, "refused");
  const auto results = run(c, setting, made.value());
  bool with_views = setting.view_facts;
  for (std::size_t s = 0; s < results.size(); ++s) {
    const StepFact& fact = c.steps[s];
    if (const char* problem = wrong_step(results[s], fact, setting)) return wrong(s, problem);
    const ViewFact& view = fact.views[number];
    // What is dirty rests on all steps before.
    with_views = with_views && view.known && same_places(results[s], view);
    if (!with_views) continue;
    if (const char* problem = wrong_sets(results[s], view)) return wrong(s, problem);
  }
  return true;
}

int judge(const char* path) {
  const Facts facts = read_facts(path);
  for (const auto& query : facts.queries) {
    if (const char* problem = wrong_query(query)) return std::printf("%s\n", problem), 1;
  }
  for (const auto& c : facts.cases) {
    for (std::size_t i = 0; i < settings().size(); ++i) {
      if (applies(settings()[i], c) && !holds(c, i)) return 1;
    }
  }
  std::printf("all as the oracle says\n");
  return 0;
}

}  // namespace
}  // namespace assay::mutation

int main(int argc, char** argv) {
  if (argc == 2) return assay::mutation::judge(argv[1]);
  std::fprintf(stderr, "usage: mutant_judge FACTS\n");
  return 2;
}
