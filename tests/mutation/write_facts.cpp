// mutation_facts OUT [SMALL FAMILY QUERIES]: writes what the oracle knows of the curated cases, of
// SMALL small steps, of FAMILY cases of each family, and of QUERIES elementary queries. Ends with 1
// if the unchanged detector contradicts these facts.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "properties/campaign/trials/trials.h"
#include "properties/generators/draft.h"
#include "properties/generators/families.h"
#include "properties/laws/facts/case_facts.h"
#include "properties/queries/query_families.h"
#include "properties/worlds/small_steps.h"
#include "tests/mutation/settings.h"

namespace assay::mutation {
namespace {

using properties::CaseFacts;

// Parts of the contact graph at the first time: the lowest triangle that each can reach.
void set_parts(StepFact& step) {
  std::map<std::int32_t, std::int32_t> part;
  const auto of = [&](std::int32_t t) { return part.try_emplace(t, t).first->second; };
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& p : step.pairs) {
      if (p.time != *step.first || of(p.pair.a) == of(p.pair.b)) continue;
      part[p.pair.a] = part[p.pair.b] = std::min(of(p.pair.a), of(p.pair.b));
      changed = true;
    }
  }
  for (auto& p : step.pairs) p.part = p.time == *step.first ? of(p.pair.a) : -1;
}

ViewFact view_fact(CaseFacts& facts, std::size_t s) {
  ViewFact view;
  if (!facts.has_views(s) || !properties::has_account(facts, s)) return view;
  view.known = true;
  view.primitives = facts.result(s).primitives;
  view.apexes = facts.result(s).apexes;
  view.signs = facts.signs(s);
  view.doubts = facts.touched(s);
  const auto dirty = properties::account_of_dirty(facts, s);
  for (std::size_t t = 0; t < dirty.size(); ++t) view.doubts[t] |= dirty[t] ? 2 : 0;
  return view;
}

std::optional<CaseFact> case_fact(const corpus::Case& c) {
  CaseFact fact{c.id, c.triangles, c.frames, false, {}};
  auto made = detector::Detector::create(c.triangles, c.frames.front(), {});
  if (!made) return fact;
  std::vector<oracle::StepJudgement> judgements;
  const auto script = corpus::steps_of(c);
  for (std::size_t s = 0; s < script.size(); ++s) {
    StepFact step{
        script[s].from, script[s].to, script[s].commit, corpus::view_of_step(c, s), {}, {}, {}};
    const auto& x_t0 = c.frames[static_cast<std::size_t>(step.from)];
    const auto& x_t1 = c.frames[static_cast<std::size_t>(step.to)];
    judgements.push_back(oracle::judge_step({x_t0, x_t1}, c.triangles, {1, {}}));
    const auto& judgement = judgements.back();
    if (!judgement.complete) return {};
    for (const auto& contact : judgement.pairs) step.pairs.push_back({contact.pair, contact.time});
    if (!step.pairs.empty()) {
      step.first = judgement.first;
      set_parts(step);
    }
    fact.steps.push_back(std::move(step));
  }
  fact.starts_clean = properties::starts_clean(c);
  for (const Setting& setting : settings()) {
    for (auto& step : fact.steps) step.views.emplace_back();
    if (!setting.view_facts) continue;
    auto own = detector::Detector::create(c.triangles, c.frames.front(), setting.options);
    const auto results = run(fact, setting, own.value());
    CaseFacts facts(c, setting.options, results, judgements, own.value().surface());
    for (std::size_t s = 0; s < results.size(); ++s)
      fact.steps[s].views.back() = view_fact(facts, s);
  }
  return fact;
}

corpus::Case case_of(const properties::SmallStep& step, std::uint64_t index) {
  corpus::Case c;
  c.id = "small-step-" + std::to_string(index);
  c.triangles = step.triangles;
  c.frames = {step.x_t0, step.x_t1};
  const auto& view = index % 2 ? step.line : step.point;
  c.view.emplace();
  c.view->q0 = {view.q0.t0, view.q0.t1};
  c.view->q1 = {view.q1.t0, view.q1.t1};
  return c;
}

int write(int argc, char** argv) {
  const auto count = [&](int i, std::uint64_t otherwise) {
    return argc > i ? std::strtoull(argv[i], nullptr, 10) : otherwise;
  };
  constexpr std::uint64_t seed = 7;
  Facts facts;
  const auto add = [&](const corpus::Case& c) {
    if (auto fact = case_fact(c)) facts.cases.push_back(std::move(*fact));
  };
  const auto folder = std::filesystem::path(ASSAY_SOURCE_DIR) / "corpus/curated";
  const auto files = corpus::case_files(folder);
  for (const auto& file : files.value()) {
    const auto c = corpus::read_case(file);
    if (c && c.value().triangles.rows() <= 1000) add(c.value());
  }
  for (std::uint64_t i = 0; i < count(2, 400); ++i) {
    add(case_of(properties::make_small_step(seed, i), i));
  }
  for (const auto& family : properties::families()) {
    for (std::uint64_t i = 0; i < count(3, 24); ++i) {
      const std::string id = "mutation:" + std::to_string(seed) + ":" + std::string(family.name) +
                             ":" + std::to_string(i);
      add(properties::make_case(family, id).c);
    }
  }
  for (std::uint64_t i = 0; i < count(4, 8000); ++i) {
    for (const auto& family : properties::self_test_queries()) {
      if (i % static_cast<std::uint64_t>(family.one_in) != 0) continue;
      const auto query = family.query(seed, i).query;
      const auto answer = oracle::contact_of(query, detector::Want::first_time);
      facts.queries.push_back({query, answer.contact, answer.first});
    }
  }
  write_facts(argv[1], facts);
  std::size_t steps = 0, colliding = 0;
  for (const auto& c : facts.cases) {
    for (const auto& step : c.steps) ++steps, colliding += step.first.has_value();
  }
  std::printf("%zu cases, %zu steps of which %zu collide, %zu queries: %s\n", facts.cases.size(),
              steps, colliding, facts.queries.size(), argv[1]);
  return 0;
}

}  // namespace
}  // namespace assay::mutation

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: mutation_facts OUT [SMALL FAMILY QUERIES]\n");
    return 2;
  }
  return assay::mutation::write(argc, argv);
}
