#include "properties/laws/metamorphic/halves.h"

#include <fmt/format.h>

#include <algorithm>

#include "properties/laws/metamorphic/change_law.h"
#include "properties/laws/step_law.h"

namespace assay::properties {
namespace {

using detector::MovingPoint;
using detector::PairContact;
using detector::Point;
using detector::StepResult;
using detector::TimeEnclosure;

struct Halved {
  PinnedRun run;
  std::vector<std::size_t> first_half;  // by step of the whole run: its place in the halved one
  bool exact = true;
};

double middle(double a, double b, bool& exact) {
  const double m = 0.5 * a + 0.5 * b;
  exact &= m - a == b - m;
  return m;
}

Point middle(const MovingPoint& path, bool& exact) {
  Point m;
  for (std::size_t k = 0; k < 3; ++k) m[k] = middle(path.t0[k], path.t1[k], exact);
  return m;
}

detector::Positions middle(const detector::Positions& a, const detector::Positions& b,
                           bool& exact) {
  detector::Positions m(a.rows(), 3);
  for (Eigen::Index v = 0; v < a.rows(); ++v) {
    for (int k = 0; k < 3; ++k) m(v, k) = middle(a(v, k), b(v, k), exact);
  }
  return m;
}

// The path in one half: from the start to the middle, or from there to the end.
MovingPoint half_path(const MovingPoint& path, int half, bool& exact) {
  const Point m = middle(path, exact);
  return half == 0 ? MovingPoint{path.t0, m} : MovingPoint{m, path.t1};
}

// Halves every step that is committed. Another step cannot be halved, because its first half would
// have to be committed.
Halved halved(const PinnedRun& whole) {
  Halved halves{whole, {}, true};
  PinnedRun& run = halves.run;
  run.script.clear();
  run.primitives.clear();
  run.apexes.clear();
  for (std::size_t s = 0; s < whole.script.size(); ++s) {
    const auto& step = whole.script[s];
    halves.first_half.push_back(run.script.size());
    if (!step.commit) {
      run.script.push_back(step);
      run.primitives.push_back(whole.primitives[s]);
      run.apexes.push_back(whole.apexes[s]);
      continue;
    }
    const auto place = static_cast<std::int32_t>(run.frames.size());
    run.frames.push_back(
        middle(whole.frames[at(step.from)], whole.frames[at(step.to)], halves.exact));
    run.script.push_back({step.from, place, true});
    run.script.push_back({place, step.to, true});
    for (int half = 0; half < 2; ++half) {
      auto primitives = whole.primitives[s];
      for (auto& primitive : primitives) {
        primitive.q0 = half_path(primitive.q0, half, halves.exact);
        primitive.q1 = half_path(primitive.q1, half, halves.exact);
      }
      run.primitives.push_back(std::move(primitives));
      auto apexes = whole.apexes[s];
      for (auto& apex : apexes) apex = half_path(apex, half, halves.exact);
      run.apexes.push_back(std::move(apexes));
    }
  }
  return halves;
}

// Whether time t of the whole step is time u of that half. Both 2t and, for t >= 1/2, 2t - 1 are
// exact. A time that no double equals has a closer enclosure in the second half, which lies inside
// of the one that is computed here.
bool corresponds(const TimeEnclosure& t, const TimeEnclosure& u, int half) {
  const TimeEnclosure wanted = {2 * t.lo - half, 2 * t.hi - half};
  if (t.lo == t.hi) return u == wanted;
  return wanted.lo <= u.lo && u.lo < u.hi && u.hi <= wanted.hi;
}

const PairContact* find(const StepResult& result, const detector::TrianglePair& pair) {
  const auto found = std::lower_bound(
      result.pairs.begin(), result.pairs.end(), pair,
      [](const PairContact& c, const detector::TrianglePair& p) { return c.pair < p; });
  return found != result.pairs.end() && found->pair == pair ? &*found : nullptr;
}

constexpr double half_time = 0.5;

std::string compare_first(const StepResult& whole, const StepResult& first,
                          const StepResult& second) {
  const bool collides = whole.answer == detector::Answer::collision;
  const int half = first.answer == detector::Answer::collision ? 0 : 1;
  const StepResult& early = half == 0 ? first : second;
  if (collides != (early.answer == detector::Answer::collision)) {
    return collides ? "the halves are free" : "the whole is free";
  }
  if (collides && !corresponds(whole.first, early.first, half)) return "another first time";
  return {};
}

std::string compare_pairs(const StepResult& whole, const StepResult& first,
                          const StepResult& second) {
  for (const auto& contact : whole.pairs) {
    const int half = contact.time.hi <= half_time ? 0 : 1;
    const auto* in_first = find(first, contact.pair);
    const auto* found = half == 0 ? in_first : find(second, contact.pair);
    if (!found || (half == 1 && in_first) || !corresponds(contact.time, found->time, half)) {
      return fmt::format("({}, {}) is missing in its half, or has another time", contact.pair.a,
                         contact.pair.b);
    }
  }
  for (const auto* half : {&first, &second}) {
    for (const auto& contact : half->pairs) {
      if (!find(whole, contact.pair)) {
        return fmt::format("({}, {}) is of a half alone", contact.pair.a, contact.pair.b);
      }
    }
  }
  return {};
}

}  // namespace

std::optional<PinnedRun> halved_run(const PinnedRun& whole) {
  Halved halves = halved(whole);
  if (!halves.exact) return std::nullopt;
  return std::move(halves.run);
}

void check_halves(CaseFacts& facts, LawTally& tally) {
  auto run = pinned_run(facts);
  if (!run) return;
  const PinnedRun whole = on_a_grid(std::move(*run));
  const Halved halves = halved(whole);
  if (!halves.exact) return;
  auto options = facts.options();
  // The middle positions may be rounded, so nobody can vouch for a clean start there. The start is
  // verified instead.
  if (options.start == detector::Start::clean) options.start = detector::Start::verified;
  auto player = PinnedPlayer::make(whole, options, facts.stages_of());
  auto half_player = PinnedPlayer::make(halves.run, options, facts.stages_of());
  if (!player || !half_player) return;
  const auto results = player->play(), of_halves = half_player->play();
  for (std::size_t s = 0; s < facts.steps(); ++s) {
    if (!whole.script[s].commit) continue;
    const auto& first = of_halves[halves.first_half[s]];
    const auto& second = of_halves[halves.first_half[s] + 1];
    std::string wrong = compare_first(results[s], first, second);
    if (wrong.empty() && facts.options().pairs == detector::Pairs::all) {
      wrong = compare_pairs(results[s], first, second);
    }
    note(facts, s, wrong, tally);
  }
}

}  // namespace assay::properties
