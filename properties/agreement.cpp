#include "properties/agreement.h"

#include <algorithm>
#include <map>
#include <set>

#include "detector/detector.h"

namespace assay::properties {

using detector::Answer;
using detector::PairContact;
using detector::TrianglePair;

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::holds:
      return "holds";
    case Outcome::defect:
      return "defect";
    case Outcome::undecided:
      return "undecided";
    case Outcome::error:
      return "error";
  }
  return "error";
}

const char* name_of(Answer answer) {
  switch (answer) {
    case Answer::free:
      return "free";
    case Answer::collision:
      return "collision";
    case Answer::undecided:
      return "undecided";
    case Answer::error:
      return "error";
  }
  return "error";
}

const char* name_of(detector::FeatureKind kind) {
  switch (kind) {
    case detector::FeatureKind::vertex_face:
      return "vertex-face";
    case detector::FeatureKind::edge_edge:
      return "edge-edge";
    case detector::FeatureKind::piercing:
      return "piercing";
    case detector::FeatureKind::same_vertices:
      return "same-vertices";
  }
  return "unknown";
}

namespace {

// Parts of the contact graph at the first time: triangles joined by pairs in contact then.
class FirstContactGraph {
 public:
  FirstContactGraph(const std::vector<PairContact>& pairs, const detector::TimeEnclosure& first) {
    for (const auto& contact : pairs) {
      if (contact.time == first) parent_[root(contact.pair.a)] = root(contact.pair.b);
    }
  }
  std::int32_t root(std::int32_t triangle) {
    const auto [entry, is_new] = parent_.try_emplace(triangle, triangle);
    if (entry->second == triangle) return triangle;
    const auto found = root(entry->second);
    parent_[triangle] = found;
    return found;
  }

 private:
  std::map<std::int32_t, std::int32_t> parent_;
};

void excuse_later_pairs(const oracle::StepJudgement& judgement, StepDiff& diff) {
  FirstContactGraph graph(judgement.pairs, judgement.first);
  std::set<TrianglePair> missing;
  for (const auto& contact : diff.missing) missing.insert(contact.pair);
  std::set<std::int32_t> reported_parts;
  for (const auto& contact : judgement.pairs) {
    if (contact.time == judgement.first && !missing.count(contact.pair)) {
      reported_parts.insert(graph.root(contact.pair.a));
    }
  }
  const auto excused = std::stable_partition(
      diff.missing.begin(), diff.missing.end(), [&](const PairContact& contact) {
        return contact.time == judgement.first && !reported_parts.count(graph.root(contact.pair.a));
      });
  diff.excused.assign(excused, diff.missing.end());
  diff.missing.erase(excused, diff.missing.end());
}

}  // namespace

StepDiff compare(const detector::StepResult& result, const oracle::StepJudgement& judgement,
                 detector::Pairs claimed) {
  StepDiff diff;
  if (result.answer == Answer::error) {
    diff.outcome = Outcome::error;
    return diff;
  }
  const bool detector_complete = result.answer != Answer::undecided;
  diff.partial = !detector_complete || !judgement.complete;

  auto ours = result.pairs.begin();
  auto theirs = judgement.pairs.begin();
  while (ours != result.pairs.end() || theirs != judgement.pairs.end()) {
    if (theirs == judgement.pairs.end() ||
        (ours != result.pairs.end() && ours->pair < theirs->pair)) {
      // An oracle that was stopped has not refuted what it has not reached.
      if (judgement.complete) diff.spurious.push_back(*ours);
      ++ours;
    } else if (ours == result.pairs.end() || theirs->pair < ours->pair) {
      if (detector_complete) diff.missing.push_back(*theirs);
      ++theirs;
    } else {
      // A stopped run may know only later contacts of a pair than its first.
      if (theirs->time < ours->time && detector_complete) {
        diff.late.push_back({ours->pair, ours->time, theirs->time});
      } else if (ours->time < theirs->time && judgement.complete) {
        diff.early.push_back({ours->pair, ours->time, theirs->time});
      }
      ++ours;
      ++theirs;
    }
  }
  if (claimed == detector::Pairs::first) {
    // Only the least time is claimed, of the pairs reported and of the step.
    diff.late.clear();
    if (judgement.complete && judgement.answer == Answer::collision) {
      excuse_later_pairs(judgement, diff);
    } else if (result.answer == Answer::collision) {
      // Of a stopped oracle only what is earlier than the detector's first time is a miss for sure.
      const auto later = std::stable_partition(
          diff.missing.begin(), diff.missing.end(),
          [&](const PairContact& contact) { return contact.time < result.first; });
      diff.excused.assign(later, diff.missing.end());
      diff.missing.erase(later, diff.missing.end());
    }
  }
  if (!diff.partial) {
    diff.wrong_answer = result.answer != judgement.answer;
    diff.wrong_first_time =
        !diff.wrong_answer && result.answer == Answer::collision && result.first != judgement.first;
  } else {
    diff.wrong_answer = result.answer == Answer::free && !judgement.pairs.empty();
  }
  const bool defect = diff.wrong_answer || diff.wrong_first_time || !diff.missing.empty() ||
                      !diff.spurious.empty() || !diff.late.empty() || !diff.early.empty();
  diff.outcome = defect ? Outcome::defect : diff.partial ? Outcome::undecided : Outcome::holds;
  return diff;
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
