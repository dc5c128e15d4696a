// L18: a mesh some of whose edges are split, in all triangles that have them, has the contacts of
// the mesh, as long as no triangle that is split loses its area.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "properties/laws/metamorphic/forms.h"
#include "properties/laws/step_law.h"
#include "properties/random.h"

namespace assay::properties {
namespace {

using Corners = std::array<std::int32_t, 3>;

// Whether the area vector N(t) vanishes at no time of the step: along some axis its three Bernstein
// coefficients have one strict sign. Each is a sum of four products of two differences at most; the
// differences, products and sums have less than 8 roundings, so 2^-40 of the sizes covers them.
bool surely_keeps_area(const Corners& v, const detector::Positions& x_t0,
                       const detector::Positions& x_t1) {
  using Vector = Eigen::RowVector3d;
  const Vector a0 = x_t0.row(v[1]) - x_t0.row(v[0]), b0 = x_t0.row(v[2]) - x_t0.row(v[0]);
  const Vector a1 = x_t1.row(v[1]) - x_t1.row(v[0]), b1 = x_t1.row(v[2]) - x_t1.row(v[0]);
  const Vector coefficients[] = {a0.cross(b0), a0.cross(b1) + a1.cross(b0), a1.cross(b1)};
  const double size = std::max(a0.cwiseAbs().maxCoeff(), a1.cwiseAbs().maxCoeff()) *
                      std::max(b0.cwiseAbs().maxCoeff(), b1.cwiseAbs().maxCoeff());
  if (!std::isfinite(size) || size < 0x1p-900) return false;
  for (Eigen::Index k = 0; k < 3; ++k) {
    int above = 0, below = 0;
    for (const auto& n : coefficients) {
      above += n[k] > 0x1p-40 * size ? 1 : 0;
      below += n[k] < -0x1p-40 * size ? 1 : 0;
    }
    if (above == 3 || below == 3) return true;
  }
  return false;
}

// a + w (b - a) for a dyadic w in (0,1), if that is a double. Nothing if a or b is so small that
// fma could lose what is to be seen.
std::optional<double> exactly_between(double a, double b, double w) {
  const double of_a = (1 - w) * a, of_b = w * b, sum = of_a + of_b;
  const auto is_small = [](double x) { return x != 0 && std::abs(x) < 0x1p-900; };
  if (is_small(a) || is_small(b)) return std::nullopt;
  const bool is_scaled = std::fma(1 - w, a, -of_a) == 0 && std::fma(w, b, -of_b) == 0;
  const double part = sum - of_a, lost = (of_a - (sum - part)) + (of_b - part);
  if (!is_scaled || !std::isfinite(sum) || lost != 0) return std::nullopt;
  return sum;
}

// Splits the edge of a triangle that is opposite to corner k. False if that cannot be done exactly,
// or if a triangle of the edge may lose its area in some step; then nothing has changed.
bool split(Form& form, Eigen::Index triangle, int k, double w) {
  auto& triangles = form.c.triangles;
  auto& frames = form.c.frames;
  const auto u = triangles(triangle, (k + 1) % 3), v = triangles(triangle, (k + 2) % 3);
  std::vector<Eigen::Index> around;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const auto row = triangles.row(t);
    if ((row.array() == u).any() && (row.array() == v).any()) around.push_back(t);
  }
  for (const auto t : around) {
    const Corners corners = {triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    for (const auto& step : form.c.script) {
      if (!surely_keeps_area(corners, frames[at(step.from)], frames[at(step.to)])) return false;
    }
  }
  std::vector<detector::Point> places;
  for (const auto& frame : frames) {
    auto& place = places.emplace_back();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto between = exactly_between(frame(u, axis), frame(v, axis), w);
      if (!between) return false;
      place[static_cast<std::size_t>(axis)] = *between;
    }
  }
  const auto middle = static_cast<std::int32_t>(frames[0].rows());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    frames[f].conservativeResize(middle + 1, 3);
    frames[f].row(middle) << places[f][0], places[f][1], places[f][2];
  }
  for (const auto t : around) {
    const auto added = triangles.rows();
    triangles.conservativeResize(added + 1, 3);
    triangles.row(added) = triangles.row(t);
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (triangles(t, i) == v) triangles(t, i) = middle;
      if (triangles(added, i) == u) triangles(added, i) = middle;
    }
    form.parent.push_back(form.parent[static_cast<std::size_t>(t)]);
  }
  return true;
}

constexpr Law refinement_law_table[] = {
    {"L18_RefinedMeshHasTheSameContacts", "L18",
     "With edges split in all triangles that have them, at places that are exact, none of which "
     "loses its area, a mesh has the same pairs, up to which part of a triangle meets, and times.",
     "nothing", check_form<refined>, one_case_in_16},
};

}  // namespace

std::span<const Law> refinement_laws() { return refinement_law_table; }

// A contact is closed faces without a common vertex that meet. Let x be where two such faces of two
// triangles meet. x lies in a part of each, on faces of these parts that have no other vertices
// than the split points besides; a split point is common to two parts only if both triangles had
// the edge, and lie on either side of it, which faces without a common vertex do not. Conversely,
// let parts meet in faces without a common vertex. Their triangles meet there too. If these have a
// vertex p in common, and the one part meets the other at a split point m of an edge (p,q), follow
// the edge from m towards q: it leaves the other triangle, which is convex, at q or through a face
// without p, and either is a contact of the two triangles at the same time. So contacts and their
// times stay, up to which part it is. A triangle without area may meet itself in its parts, which
// is why none is split.
std::optional<Form> refined(const corpus::Case& c) {
  Form form{bare(c), in_order(static_cast<std::size_t>(c.triangles.rows())), {}};
  Random random(Random::hash(c.id), Random::hash("refined"));
  const int wanted = random.between(1, 4);
  int done = 0;
  for (int tries = 0; tries < 4 * wanted && done < wanted; ++tries) {
    const auto triangle = random.below(static_cast<int>(form.c.triangles.rows()));
    const int corner = random.below(3);
    constexpr double shares[] = {0.5, 0.5, 0.25, 0.75};
    const double share = shares[random.below(4)];
    done += split(form, triangle, corner, share) ? 1 : 0;
  }
  if (done == 0) return std::nullopt;
  for (std::size_t s = 0; s < form.c.script.size(); ++s) form.step.push_back(s);
  return form;
}

// Steps in halves.

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
