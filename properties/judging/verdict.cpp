#include "properties/judging/verdict.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/faults/fault.h"
#include "properties/judging/cause.h"
#include "properties/judging/exam.h"
#include "properties/numbering.h"
#include "properties/worker/plugin/query_case.h"

namespace assay::properties {

BodyNames::BodyNames(const CountedPairs* counted_pairs, const TrianglesView& triangles) {
  if (!counted_pairs || counted_pairs->body.empty()) return;
  const auto& body = counted_pairs->body;
  std::vector<std::int32_t> sizes(at(*std::ranges::max_element(body)) + 1, 0);
  by_triangle_.reserve(static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const auto of = body[at(triangles(t, 0))];
    by_triangle_.push_back({of, sizes[at(of)]++});
  }
}

std::string BodyNames::text(const TrianglePair& pair) const {
  if (empty()) return "";
  return fmt::format(" (triangle {} of body {} and triangle {} of body {})", of(pair.a).triangle,
                     of(pair.a).body, of(pair.b).triangle, of(pair.b).body);
}

namespace {

// Adds the stage that lost the pair, which tells one failure of this kind from another.
void find_stage(Failure& failure, const Case& c, const CaseStep& step, const StepDiff& diff,
                Options options) {
  const bool is_lost = std::ranges::any_of(
      diff.missing, [&](const auto& miss) { return miss.pair == failure.pair; });
  options.counted = counted_of(c);
  if (is_lost)
    failure.stage =
        stage_that_lost(c.triangles, start_of(c, step), end_of(c, step), *failure.pair, options);
}

// Does the same for a plug-in. The stages of a plug-in are unknown, so this adds the special
// properties of the contact.
void find_cause(Failure& failure, const Case& c, const CaseStep& step, const StepJudgement& truth,
                const Contract& contract) {
  if (!failure.pair) return;
  const auto &x_t0 = start_of(c, step), &x_t1 = end_of(c, step);
  const auto pairs = truth_of(c, truth, contract).pairs;
  const auto contact =
      std::ranges::find_if(pairs, [&](const auto& exact) { return exact.pair == *failure.pair; });
  const bool of_distance = contract.separation > 0;
  const SteppedMesh motion{x_t0, x_t1};
  const auto query = query_of(c);
  failure.cause = contact != pairs.end()
                      ? cause_of(c.triangles, motion, *contact, of_distance, query.has_value())
                      : cause_of(c.triangles, motion, *failure.pair, of_distance,
                                 query ? std::optional(features_of(*query)) : std::nullopt);
}

// Rewrites the explanation of a failed query in terms of features, because the two triangles of a
// query only hold the features that were asked.
void name_features(Failure& failure, const FourPoints& query) {
  if (failure.feature.empty()) failure.feature = query_word(query);
  constexpr std::string_view pair = "triangles 0 and 1 ";
  if (failure.explanation.starts_with(pair))
    failure.explanation.replace(0, pair.size(), "the two features ");
}

}  // namespace

Failure failure_of(const Verdict& verdict, const Case& c, std::span<const StepJudgement> truth,
                   const CaseRun& run, const Configuration& configuration,
                   const DetectorUnderTest& detector) {
  Failure failure;
  const auto diff = std::ranges::find(verdict.steps, Outcome::defect, &StepDiff::outcome);
  if (diff == verdict.steps.end()) {
    failure.claim = verdict.breaches.front();
    failure.kind = failure.claim == Claim::deterministic ? "two runs differ" : name_of(run.end);
    failure.explanation = verdict.explanation.empty() ? failure.kind : verdict.explanation;
  } else {
    const auto s = static_cast<std::size_t>(diff - verdict.steps.begin());
    const auto step = steps_of(c)[s];
    failure = failure_of(*diff, run.steps[s], detector.contract);
    if (failure.kind == "error") {
      const auto error = error_of(run, s);
      failure.explanation = error.empty() ? verdict.explanation : error;
    }
    if (detector.built_in) {
      if (configuration.fault.empty()) find_stage(failure, c, step, *diff, configuration.options);
    } else if (failure.claim == Claim::commit_free) {
      failure.cause = cause_of(c.triangles, {start_of(c, step), run.limits[s]->positions},
                               *diff->limit->hit, detector.contract.separation > 0);
    } else {
      find_cause(failure, c, step, truth[s], detector.contract);
    }
    failure.step = s;
  }
  if (const Fault* fault = find_fault(configuration.fault)) failure.stage = fault->stage;
  failure.configuration = configuration.name;
  if (failure.pair)
    failure.explanation += BodyNames(counted_of(c), c.triangles).text(*failure.pair);
  if (const auto query = query_of(c)) name_features(failure, *query);
  return failure;
}

std::string Failure::signature() const {
  std::string text = fmt::format("{}: {}", name_of(claim), kind);
  if (!stage.empty()) text += " at " + stage;
  for (const auto& part : {feature, cause}) {
    if (!part.empty()) text += ", " + part;
  }
  return text;
}

namespace {

std::string enclosure_text(const TimeEnclosure& t) {
  return t.lo == t.hi ? fmt::format("{}", t.lo) : fmt::format("[{}, {}]", t.lo, t.hi);
}

// Gives "collision at 0.5" or "free", for example.
std::string answer_text(Answer answer, const TimeEnclosure& first) {
  return answer == Answer::collision ? fmt::format("collision at {}", enclosure_text(first))
                                     : name_of(answer);
}

// Returns the contract's question about two triangles: "meet", or "come within 0.5"; with the slack
// "within 0.5 + 0.125".
std::string asked_text(const Contract& contract, double slack = 0) {
  if (contract.separation == 0 && slack == 0) return "meet";
  return fmt::format("come within {}{}", contract.separation,
                     slack > 0 ? fmt::format(" + {}", slack) : "");
}

// Returns the share in words. If t* lies between two adjacent doubles, an interval may miss it by
// less than an ulp.
std::string share_text(double share) {
  return share > 0 ? fmt::format("{:.3g}", share) : "less than an ulp";
}

// Makes the failure of a step from the evidence of its broken claim.
class FailureOfStep {
 public:
  FailureOfStep(const StepDiff& diff, const StepResult& result, const Contract& contract)
      : diff_(diff), contract_(contract), row_(row_of(diff.breaches.front())) {
    failure_.claim = row_.value;
    const Symptom symptom = row_.symptom_of(diff);
    failure_.kind = symptom.kind;
    if (diff.overload) failure_.explanation = refusal_text(*diff.overload);
    if (row_.about == About::runs) return;
    std::visit([&](const auto& by) { tell(by); }, symptom.by);
    if (row_.value == Claim::commit_free)
      failure_.explanation = "on the way that is allowed, " + failure_.explanation;
    if (row_.about == About::times && diff.first)  // else the oracle was stopped
      failure_.explanation +=
          fmt::format(", {} by {}", symptom.kind,
                      share_text(diff.late_first ? diff.first->off.late : diff.first->off.early));
    failure_.explanation +=
        row_.about == About::limits ? how_far()
        : row_.about == About::broad_phase
            ? fmt::format(", and are none of {} candidates", diff.candidates->given_pairs)
            : fmt::format("; answered {}, exact {}", answer_text(result.answer, result.first),
                          diff.first_contact
                              ? answer_text(Answer::collision, diff.first_contact->time)
                              : name_of(Answer::free));
  }

  Failure take() { return std::move(failure_); }

 private:
  void tell(const PairContact& contact) {
    failure_.pair = contact.pair;
    failure_.feature = name_of(contact.feature.kind);
    failure_.explanation = contact_text(contact, " " + asked_text(contract_));
  }
  void tell(const WithinSlack& within) {
    failure_.explanation =
        contact_text(within.contact, " " + asked_text(contract_, contract_.margin));
  }
  void tell(const WrongTime& wrong) {
    failure_.pair = wrong.pair;
    failure_.explanation =
        fmt::format("triangles {} and {} at {}, and not at {}", wrong.pair.a, wrong.pair.b,
                    enclosure_text(wrong.detector), enclosure_text(wrong.oracle));
  }
  void tell(const TrianglePair& pair) {
    failure_.pair = pair;
    failure_.explanation = fmt::format("triangles {} and {} do not {}", pair.a, pair.b,
                                       asked_text(contract_, contract_.margin));
  }
  void tell(std::monostate) {
    failure_.explanation =
        "no two triangles " +
        asked_text(contract_, row_.about == About::limits ? 0 : contract_.margin);
  }

  std::string refusal_text(const StepLoad& load) const {
    const auto of = [](std::uint64_t number, const char* what, std::uint64_t most) {
      return fmt::format("{} {}{}", number, what,
                         most > 0 ? fmt::format(" (it holds {})", most) : "");
    };
    return fmt::format("refused: {}, {}, {}",
                       of(load.triangles, "triangles", contract_.capacity_triangles),
                       of(load.contacts, "contacts", contract_.capacity_contacts),
                       of(load.candidates, "candidates", contract_.capacity_candidates));
  }

  // Returns how far the limiter goes, and how far it might.
  std::string how_far() const {
    const auto& limit = *diff_.limit;
    std::string text = limit.share >= 0 ? fmt::format("; allowed a share of {}", limit.share)
                                        : fmt::format("; allowed {:.3g} of the way", limit.way);
    if (contract_.progress > 0 && row_.value == Claim::progress)
      text += fmt::format(", promised {} of what is free", contract_.progress);
    return text;
  }

  const StepDiff& diff_;
  const Contract& contract_;
  const ClaimRow& row_;
  Failure failure_;
};

}  // namespace

std::string contact_text(const PairContact& contact, const std::string& what) {
  return fmt::format("triangles {} and {}{} at t = {} ({})", contact.pair.a, contact.pair.b, what,
                     enclosure_text(contact.time), name_of(contact.feature.kind));
}

Failure failure_of(const StepDiff& diff, const StepResult& result, const Contract& contract) {
  return FailureOfStep(diff, result, contract).take();
}

}  // namespace assay::properties
