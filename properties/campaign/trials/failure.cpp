#include "properties/campaign/trials/failure.h"

#include <fmt/format.h>

#include "properties/judging/case_options.h"

namespace assay::properties {

std::string Failure::signature() const {
  std::string text = fmt::format("{}: {}", name_of(claim), kind);
  if (!stage.empty()) text += " at " + stage;
  for (const auto& part : {feature, cause}) {
    if (!part.empty()) text += ", " + part;
  }
  return text;
}

namespace {

std::string time_text(const detector::TimeEnclosure& t) {
  return t.lo == t.hi ? fmt::format("{}", t.lo) : fmt::format("[{}, {}]", t.lo, t.hi);
}

// Gives "collision at 0.5" or "free", for example.
std::string answer_text(detector::Answer answer, const detector::TimeEnclosure& first) {
  return answer == detector::Answer::collision ? fmt::format("collision at {}", time_text(first))
                                               : name_of(answer);
}

std::string contact_text(const detector::PairContact& contact) {
  return fmt::format("triangles {} and {} meet at {} ({})", contact.pair.a, contact.pair.b,
                     time_text(contact.time), name_of(contact.feature.kind));
}

// t* may lie between two adjacent doubles, of which the lower one alone does not hold it.
std::string share_text(double share) {
  return share > 0 ? fmt::format("{:.3g}", share) : "less than an ulp";
}

// Makes a failure of a step: it finds the kind that fits the broken claim, and the pair.
class FailureOfStep {
 public:
  explicit FailureOfStep(const StepDiff& diff) : diff_(diff) {
    failure_.claim = diff.broken.front();
    switch (failure_.claim) {
      case Claim::free_sound:
        at("answered free", *diff.first_contact);
        break;
      case Claim::not_late:
      case Claim::first_time:
        off_first_time();
        break;
      case Claim::first_pairs:
      case Claim::all_pairs:
        lost_pair();
        break;
      case Claim::no_spurious:
        too_much();
        break;
      case Claim::candidates:
        at("missing candidate", diff.missing_candidates.front());
        failure_.explanation +=
            fmt::format(", and are none of {} candidates", diff.candidates->given);
        break;
      default:
        failure_.kind = "error";
    }
  }

  Failure take() { return std::move(failure_); }

 private:
  void at(const char* kind, const detector::PairContact& contact) {
    failure_.kind = kind;
    failure_.pair = contact.pair;
    failure_.feature = name_of(contact.feature.kind);
    failure_.explanation = contact_text(contact);
  }

  void of_pair(const char* kind, const WrongTime& wrong) {
    failure_.kind = kind;
    failure_.pair = wrong.pair;
    failure_.explanation =
        fmt::format("triangles {} and {} at {}, and not at {}", wrong.pair.a, wrong.pair.b,
                    time_text(wrong.detector), time_text(wrong.oracle));
  }

  void off_first_time() {
    at(diff_.late_first ? "late" : "early", *diff_.first_contact);
    if (!diff_.first) return;  // the oracle was stopped
    const double off = diff_.late_first ? diff_.first->off.late : diff_.first->off.early;
    failure_.explanation += fmt::format(", {} by {}", failure_.kind, share_text(off));
  }

  void lost_pair() {
    if (!diff_.missing.empty()) {
      at("missing pair", diff_.missing.front());
    } else {
      of_pair("late pair", diff_.late.front());
    }
  }

  void too_much() {
    if (!diff_.answered_collision && diff_.spurious.empty()) {
      of_pair("early pair", diff_.early.front());
      return;
    }
    failure_.kind = diff_.answered_collision ? "answered collision" : "spurious pair";
    if (diff_.spurious.empty()) {
      failure_.explanation = "no two triangles meet";
      return;
    }
    const auto& pair = diff_.spurious.front().pair;
    failure_.pair = pair;
    failure_.explanation = fmt::format("triangles {} and {} do not meet", pair.a, pair.b);
  }

  const StepDiff& diff_;
  Failure failure_;
};

}  // namespace

Failure failure_of(const StepDiff& diff, const detector::StepResult& result) {
  Failure failure = FailureOfStep(diff).take();
  if (failure.kind == "error" || failure.claim == Claim::candidates) return failure;
  const auto exact = diff.first_contact
                         ? answer_text(detector::Answer::collision, diff.first_contact->time)
                         : answer_text(detector::Answer::free, {});
  failure.explanation +=
      fmt::format("; answered {}, exact {}", answer_text(result.answer, result.first), exact);
  return failure;
}

}  // namespace assay::properties
