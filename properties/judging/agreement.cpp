#include "properties/judging/agreement.h"

#include <algorithm>
#include <functional>

#include "detector/detector.h"
#include "properties/judging/first_contact_graph.h"
#include "properties/words.h"

namespace assay::properties {

using detector::Answer;
using detector::PairContact;
using detector::TimeEnclosure;
using detector::TrianglePair;

const char* name_of(Outcome outcome) {
  return word_of({"holds", "defect", "undecided", "error"}, outcome);
}

const char* name_of(detector::FeatureKind kind) {
  return word_of({"vertex-face", "edge-edge", "piercing", "same-vertices"}, kind);
}

namespace {

// How a detector's times are read: `unique` is the enclosure of exact arithmetic, `interval` any
// interval that holds the time.
enum class Times { unique, interval };

// t* of the oracle is its lo when lo == hi, else strictly between two adjacent doubles: an interval
// of doubles holds it when it holds both ends.
bool begins_after(const TimeEnclosure& ours, const TimeEnclosure& theirs, Times times) {
  return times == Times::unique ? theirs < ours : ours.lo > theirs.lo;
}
bool ends_before(const TimeEnclosure& ours, const TimeEnclosure& theirs, Times times) {
  return times == Times::unique ? ours < theirs : ours.hi < theirs.hi;
}

// The oracle's side that counts under a contract.
struct Truth {
  std::vector<PairContact> pairs;
  bool complete = false;
  TimeEnclosure first;  // when complete and there are pairs
};

class Comparison {
 public:
  Comparison(const detector::StepResult& result, const oracle::StepJudgement& judgement,
             const Claims& claims, const Contract& contract, Times times)
      : result_(result),
        judgement_(judgement),
        claims_(claims),
        contract_(contract),
        times_(times) {}

  StepDiff run(const std::function<bool(TrianglePair)>& left_out) {
    if (result_.answer == Answer::error) {
      broken(Claim::total, true);
      diff_.outcome = diff_.broken.empty() ? Outcome::error : Outcome::defect;
      return std::move(diff_);
    }
    diff_.partial = !detector_complete() || !judgement_.complete;
    for (const auto& contact : judgement_.pairs) {
      (left_out(contact.pair) ? diff_.left_out : truth_.pairs).push_back(contact);
    }
    truth_.complete = judgement_.complete;
    const auto earlier = [](const PairContact& a, const PairContact& b) { return a.time < b.time; };
    const auto first = std::min_element(truth_.pairs.begin(), truth_.pairs.end(), earlier);
    if (first != truth_.pairs.end()) truth_.first = first->time;

    compare_pairs(left_out);
    compare_answers();
    excuse();
    weigh();
    return std::move(diff_);
  }

 private:
  bool detector_complete() const { return result_.answer != Answer::undecided; }

  void compare_pairs(const std::function<bool(TrianglePair)>& left_out) {
    auto ours = result_.pairs.begin();
    auto theirs = judgement_.pairs.begin();
    while (ours != result_.pairs.end() || theirs != judgement_.pairs.end()) {
      if (theirs == judgement_.pairs.end() ||
          (ours != result_.pairs.end() && ours->pair < theirs->pair)) {
        // An oracle that was stopped has not refuted what it has not reached.
        if (judgement_.complete) diff_.spurious.push_back(*ours);
        ++ours;
      } else if (ours == result_.pairs.end() || theirs->pair < ours->pair) {
        if (detector_complete() && !left_out(theirs->pair)) diff_.missing.push_back(*theirs);
        ++theirs;
      } else {
        // A stopped run may know only later contacts of a pair than its first.
        const WrongTime wrong{ours->pair, ours->time, theirs->time};
        if (begins_after(ours->time, theirs->time, times_) && detector_complete()) {
          diff_.late.push_back(wrong);
        } else if (ends_before(ours->time, theirs->time, times_) && judgement_.complete) {
          diff_.early.push_back(wrong);
        }
        ++ours;
        ++theirs;
      }
    }
    // Without all-pairs only the least time is claimed, of the pairs reported and of the step.
    if (!claims_.all_pairs) diff_.late.clear();
  }

  void compare_answers() {
    const bool collision = result_.answer == Answer::collision;
    missed_ = result_.answer == Answer::free && !truth_.pairs.empty();
    false_alarm_ = collision && judgement_.complete && judgement_.pairs.empty();
    diff_.wrong_answer = missed_ || false_alarm_;
    if (collision && !truth_.pairs.empty()) {
      // Of a stopped oracle the first time is an upper bound.
      late_ = begins_after(result_.first, truth_.first, times_);
      diff_.wrong_first_time =
          truth_.complete && (late_ || ends_before(result_.first, truth_.first, times_));
    }
    if (missed_ || late_) return;
    for (const auto& contact : diff_.left_out) {
      diff_.left_out_missed |= result_.answer == Answer::free ||
                               (collision && begins_after(result_.first, contact.time, times_));
    }
  }

  // What is left in unexcused_ of the missing pairs breaks first-pairs.
  void excuse() {
    unexcused_ = diff_.missing;
    std::vector<PairContact> excused;
    if (truth_.complete && !truth_.pairs.empty()) {
      excuse_beside_the_first(truth_.pairs, truth_.first, unexcused_, excused);
    } else if (result_.answer == Answer::collision) {
      // Of a stopped oracle only what is earlier than the detector's first time is a miss for sure.
      const auto later = std::stable_partition(
          unexcused_.begin(), unexcused_.end(), [&](const PairContact& contact) {
            return begins_after(result_.first, contact.time, times_);
          });
      excused.assign(later, unexcused_.end());
      unexcused_.erase(later, unexcused_.end());
    }
    if (claims_.all_pairs) return;
    diff_.missing = unexcused_;
    diff_.excused = std::move(excused);
  }

  void broken(Claim claim, bool refuted) {
    if (refuted && claims_.has(claim)) diff_.broken.push_back(claim);
  }

  void weigh() {
    broken(Claim::free_sound, missed_);
    broken(Claim::not_late, late_);
    broken(Claim::first_time, diff_.wrong_first_time);
    broken(Claim::first_pairs, !unexcused_.empty());
    broken(Claim::all_pairs, !diff_.missing.empty() || !diff_.late.empty());
    const bool spurious = false_alarm_ || !diff_.spurious.empty() || !diff_.early.empty();
    broken(Claim::no_spurious, spurious && contract_.margin == 0);
    diff_.outcome = !diff_.broken.empty() ? Outcome::defect
                    : diff_.partial       ? Outcome::undecided
                                          : Outcome::holds;
  }

  const detector::StepResult& result_;
  const oracle::StepJudgement& judgement_;
  const Claims& claims_;
  const Contract& contract_;
  Times times_;
  Truth truth_;
  bool missed_ = false, false_alarm_ = false, late_ = false;
  std::vector<PairContact> unexcused_;
  StepDiff diff_;
};

}  // namespace

StepDiff compare(const detector::StepResult& result, const oracle::StepJudgement& judgement,
                 const Claims& claims, const Contract& contract,
                 const detector::TrianglesView& triangles) {
  return Comparison(result, judgement, claims, contract, Times::interval)
      .run([&](TrianglePair pair) { return leaves_out(contract, triangles, pair); });
}

StepDiff compare(const detector::StepResult& result, const oracle::StepJudgement& judgement,
                 const detector::Options& options) {
  Claims claims = claims_of(options);
  // Bad input is refused by name, which is an answer that nobody asked for, and no defect.
  claims.total = false;
  const auto times =
      options.arithmetic == detector::Arithmetic::exact ? Times::unique : Times::interval;
  return Comparison(result, judgement, claims, {}, times).run([](TrianglePair) { return false; });
}

StepDiff compare(const detector::StepResult& result, const oracle::StepJudgement& judgement,
                 detector::Pairs claimed) {
  return compare(result, judgement, detector::Options{.pairs = claimed});
}

std::string stage_that_lost(const detector::TrianglesView& triangles,
                            const detector::PositionsView& x_t0,
                            const detector::PositionsView& x_t1, TrianglePair pair) {
  const auto finds = [&](detector::Culling culling) {
    auto made = detector::Detector::create(
        triangles, x_t0, {culling, detector::Start::unknown, detector::Pairs::all});
    if (!made) return false;
    const auto result = made.value().evaluate(x_t0, x_t1);
    return std::any_of(result.pairs.begin(), result.pairs.end(),
                       [&](const PairContact& contact) { return contact.pair == pair; });
  };
  constexpr Eigen::Index most_triangles_without_tree = 2000;
  if (finds(detector::Culling::bvh)) return "view sets";
  if (triangles.rows() > most_triangles_without_tree) return "pair search or elementary test";
  return finds(detector::Culling::none) ? "pair search" : "elementary test";
}

}  // namespace assay::properties
