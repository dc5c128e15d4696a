// Judges the answers of a detector to an exported case by the claims that are asked. Needs C++17,
// and nothing of Assay. An export writes the case itself as arrays, into a file beside this one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace exported_case {

// Two triangles and the interval of the first time at which they meet. The pairs that meet at t*,
// the first contact time of the step, are the edges of a graph with triangles as nodes. `part` is
// the number of the pair's connected component in this graph, or -1 if the pair meets later.
struct Pair {
  int a, b;
  double lo, hi;
  int part;
};

// A step from frame `from` to frame `to`. If `commit` is true, the detector's state advances to the
// end of the step. The first contact time t* is `lo` if lo == hi; otherwise `lo` and `hi` are
// adjacent doubles, and t* is strictly between them.
struct Step {
  int from, to;
  bool commit, collision;
  double lo, hi;
  const char *lo_as_fraction, *hi_as_fraction;
  std::vector<Pair> pairs;  // the pairs that meet
  // Pairs that the detector may report, though not before their first time: contacts that the
  // contract leaves out, or all pairs that come within the contract's margin.
  std::vector<Pair> allowed;
};

// What a detector may claim: the claims of properties/claims/claims.h in their order, each named by
// its word.
enum class Claim {
  free_sound,
  not_late,
  first_time,
  first_pairs,
  all_pairs,
  no_spurious,
  deterministic,
  total,
  candidates,
  commit_free,
  path_free,
  progress,
  whole_when_safe,
  times_unique
};
struct Asked {
  Claim claim;
  const char* name;
};

struct Case {
  int query;  // 0: a mesh; 1: a query of a vertex and a face; 2: a query of two edges
  const int* triangles;
  int triangle_count, vertex_count;
  const double* frames;  // positions of all vertices, one frame after the other
  std::vector<Step> steps;
  std::vector<Asked> asked;  // the claims to check for each answer
  double time_tolerance;
  double promised;           // the progress that a limiter claims
  double unit;               // the unit in the last place of 1, in the detector's number type
  bool takes_displacements;  // in place of end positions

  std::size_t coordinates() const { return 3 * static_cast<std::size_t>(vertex_count); }
  const double* frame(int number) const {
    return frames + static_cast<std::size_t>(number) * coordinates();
  }
};

// A detector's answer to a step.
struct Found {
  bool filled_in = false;
  bool collision = false;
  double lo = 0, hi = 1;         // the interval of the first contact time; [0, 1]: not stated
  std::vector<Pair> pairs;       // the pairs that meet, each with the interval of its first time
  std::vector<Pair> candidates;  // what a broad phase lists; its times do not matter
  double share = -1;             // the share of the step that a limiter allows; -1: not stated
  std::vector<double> stop;      // where a limiter stops the caller; empty: no limiter answered
  bool is_answered = true;       // false: undecided, or only a broad phase
  std::string error;             // why there is no answer; empty if there is an answer
};

inline const Pair* find(const std::vector<Pair>& list, const Pair& pair) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Pair& one) {
    return one.a == pair.a && one.b == pair.b;
  });
  return found == list.end() ? nullptr : &*found;
}

// Returns whether the limiter allows the step to its very end.
inline bool is_whole(const Case& c, const Step& step, const Found& found) {
  return std::equal(found.stop.begin(), found.stop.end(), c.frame(step.to),
                    [&](double at, double end) {
                      return at == end || (c.takes_displacements && at == static_cast<float>(end));
                    });
}

// Returns whether this share of the step is more than rounding: whether it moves some coordinate by
// at least 2^10 units in the last place of the coordinate.
inline bool has_room(const Case& c, const Step& step, double share) {
  const double *x_t0 = c.frame(step.from), *x_t1 = c.frame(step.to);
  for (std::size_t i = 0; i < c.coordinates(); ++i)
    if (std::fabs(share * (x_t1[i] - x_t0[i])) >= 0x1p10 * c.unit * std::fabs(x_t0[i])) return true;
  return false;
}

// Returns whether the answer to a step keeps a claim. Does not find out whether the way to
// positions other than the end is free; `assay replay` does.
inline bool holds(Claim claim, const Case& c, const Step& step, const Found& found) {
  if (!found.error.empty()) return claim != Claim::total;
  const auto begins_after = [&](double lo, double exact) { return lo > exact + c.time_tolerance; };
  const auto ends_before = [&](double hi, double exact) { return hi < exact - c.time_tolerance; };
  const auto all_met = [&](const auto& is_kept) {
    return std::all_of(step.pairs.begin(), step.pairs.end(), is_kept);
  };
  const bool both = found.is_answered && step.collision && found.collision;
  const bool is_late = both && begins_after(found.lo, step.lo);
  const bool is_limited = !found.stop.empty() && !(step.collision && step.hi == 0);
  const bool has_share = is_limited && found.share >= 0;
  switch (claim) {
    case Claim::free_sound:
      return !found.is_answered || found.collision || !step.collision;
    case Claim::not_late:
      return !is_late;
    case Claim::first_time:
      return !is_late && !(both && ends_before(found.hi, step.hi));
    case Claim::times_unique:
      return !both || (found.lo == step.lo && found.hi == step.hi);
    case Claim::first_pairs:
      return !found.is_answered || all_met([&](const Pair& met) {
        return met.part < 0 || !all_met([&](const Pair& other) {
                 return other.part != met.part || !find(found.pairs, other);
               });
      });
    case Claim::all_pairs:
      return !found.is_answered || all_met([&](const Pair& met) {
        const Pair* const ours = find(found.pairs, met);
        return ours && !begins_after(ours->lo, met.lo);
      });
    case Claim::no_spurious:
      return (!found.collision || step.collision || !step.allowed.empty()) &&
             std::all_of(found.pairs.begin(), found.pairs.end(), [&](const Pair& ours) {
               const Pair* exact = find(step.allowed, ours);
               if (!exact) exact = find(step.pairs, ours);
               return exact && !ends_before(ours.hi, exact->hi);
             });
    case Claim::candidates:
      return all_met([&](const Pair& met) { return find(found.candidates, met) != nullptr; });
    case Claim::commit_free:
      return !is_limited || !step.collision || !is_whole(c, step, found);
    case Claim::whole_when_safe:
      return !is_limited || step.collision || is_whole(c, step, found);
    case Claim::path_free:
      return !has_share || !step.collision ||
             (step.lo == step.hi ? found.share < step.lo : found.share <= step.lo);
    case Claim::progress: {
      const double wanted = c.promised * (step.collision ? step.lo : 1);
      return !has_share || found.share >= wanted * (1 - 1e-15) || !has_room(c, step, wanted);
    }
    case Claim::deterministic:
    case Claim::total:
      break;
  }
  return true;
}

// Returns the text of an answer, with every bit of its numbers. Equal answers have equal texts.
inline std::string text_of(const Found& found) {
  std::string text = found.error + "\n";
  const auto add = [&text](double number) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%a ", number);
    text += digits;
  };
  for (const double number : {double(found.is_answered), double(found.collision), found.lo,
                              found.hi, found.share, double(found.pairs.size())})
    add(number);
  for (const auto* list : {&found.pairs, &found.candidates}) {
    for (const Pair& pair : *list) {
      for (const double number : {double(pair.a), double(pair.b), pair.lo, pair.hi}) add(number);
    }
  }
  for (const double number : found.stop) add(number);
  return text;
}

// Prints the claims that the answer to step s breaks; `again` is the answer of a second call.
// Returns whether the answer breaks a claim.
inline bool is_wrong(const Case& c, std::size_t s, const Found& found, const Found& again) {
  const Step& step = c.steps[s];
  bool wrong = false;
  for (const auto& [claim, name] : c.asked) {
    if (claim == Claim::deterministic ? text_of(found) == text_of(again)
                                      : holds(claim, c, step, found))
      continue;
    std::printf("step %zu breaks %s\n", s + 1, name);
    wrong = true;
  }
  if (!found.error.empty()) std::printf("  no answer: %s\n", found.error.c_str());
  if (!wrong || !found.error.empty()) return wrong;
  if (!found.stop.empty()) std::printf("  allowed a share of %.17g\n", found.share);
  const auto word = [](bool collision) { return collision ? "collision" : "free"; };
  std::printf("  answered %s", found.is_answered ? word(found.collision) : "nothing");
  if (found.collision) std::printf(" at [%.17g, %.17g]", found.lo, found.hi);
  std::printf(", exact %s", word(step.collision));
  if (step.collision) std::printf(" at %.17g (%s)", step.lo, step.lo_as_fraction);
  std::printf("\n");
  for (const Pair& met : step.pairs)
    std::printf("  triangles %d and %d meet at %.17g\n", met.a, met.b, met.lo);
  for (const Pair& ours : found.pairs)
    std::printf("  triangles %d and %d are reported at [%.17g, %.17g]\n", ours.a, ours.b, ours.lo,
                ours.hi);
  return true;
}

}  // namespace exported_case
