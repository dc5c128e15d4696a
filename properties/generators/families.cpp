#include "properties/generators/families.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "oracle/mesh/step.h"
#include "properties/generators/draft.h"
#include "properties/generators/parts.h"
#include "properties/random.h"

namespace assay::properties {

// How a case of a family is put together: shape, motion, aims, menus, primitive, in this order.

struct Recipe {
  bool is_closed = true, is_broken = false;
  bool exact = false;              // small integers and dyadics, exact aims and collapses
  bool nearly_degenerate = false;  // ulp neighbours, slivers, aims just missed
  bool far = false;                // far from the origin, scales, denormals, large steps
  bool everyday = false;           // numbers as programs make them; aimed: a piece falls on another
  // Percentages of the cases that are positive by construction, and of those with an aimed
  // contact.
  int positive = 0, aimed = 0;
};

namespace {

int any_size(Random& random, const Recipe& recipe) {
  const int share = random.below(100);
  if (recipe.everyday) {
    const int least = recipe.is_closed ? 4 : 2;
    if (share < 60) return random.between(least, 2 * least);
    return share < 90 ? random.between(2 * least, 12) : random.between(12, 40);
  }
  const int large = recipe.exact || recipe.far ? 2 : 5;
  if (share < 50) return random.between(4, 12);
  if (share < 100 - 4 * large) return random.between(12, 40);
  if (share < 100 - large) return random.between(40, 100);
  return random.between(100, 200);
}

int any_steps(Random& random, int size) {
  const int share = random.below(100);
  if (share < 60) return 1;
  if (share < 80) return 2;
  if (share < 92 || size > 40) return 3;
  return random.between(4, 8);
}

const char* size_class(std::size_t triangles) {
  if (triangles <= 12) return "size:2-12";
  if (triangles <= 40) return "size:13-40";
  if (triangles <= 100) return "size:41-100";
  return "size:101-200";
}

// Makes the frames by one to three motions, more often small than large. In some cases the mesh
// returns on the way it came.
void move_freely(Random& random, Draft& draft, int steps, const Recipe& recipe) {
  const auto places =
      some_motions(random, random.between(1, 3), recipe.exact, draft.faces.size() <= 60);
  const int least = 3;
  const double mantissa = 1 + random.unit();
  const double usual = std::ldexp(mantissa, -random.between(1, least));
  const bool returns = steps > 1 && random.one_in(3);
  const int forward = returns ? (steps + 1) / 2 : steps;
  for (int s = 0; s < forward; ++s) {
    Points x = draft.frames.back();
    if (s == 0 && !draft.closing.empty() && !random.one_in(4)) {
      for (std::size_t v = 0; v < draft.closing.size(); ++v) x[v] = x[v] + draft.closing[v];
      if (random.one_in(3)) roughen(random, x, 0x1p-8);
      draft.frames.push_back(std::move(x));
      draft.tag("motion:closing");
      continue;
    }
    const Motion& motion = *one_of(random, places);
    const double amount = random.one_in(5) ? 1.0 : usual / std::sqrt(static_cast<double>(forward));
    motion.move(random, draft, x, amount);
    if (motion.level && !recipe.exact) roughen(random, x, amount);
    if (recipe.far && random.one_in(3)) {
      const Point by = any_vector(random);
      for (auto& p : x) p = p + 64 * by;
      draft.tag("motion:large-step");
    }
    draft.frames.push_back(std::move(x));
    draft.tag(std::string("motion:") + motion.name);
  }
  for (int s = forward; s < steps; ++s) {
    draft.frames.push_back(
        draft.frames[static_cast<std::size_t>(std::max(0, 2 * forward - s - 1))]);
    draft.tag("motion:and-back");
  }
}

void shuffle_faces(Random& random, Draft& draft) {
  draft.faces = shuffled(random, std::move(draft.faces));
  begin_anywhere(random, draft.faces);
  draft.tag("order:shuffled");
}

Draft any_shape(Random& random, const Recipe& recipe, bool positive, int size) {
  if (positive) return recipe.is_closed ? star_shape(random, size) : open_star_shape(random, size);
  if (recipe.is_broken) return broken_shape(random, size);
  return recipe.is_closed ? closed_shape(random, size) : open_shape(random, size);
}

// Rounds coordinates to few bits. A coarse grid makes coincidences, a fine one only keeps aims
// exact.
void few_bits(Random& random, Draft& draft) {
  if (random.one_in(3)) {
    round_to_grid(draft, random.between(2, 5), 0);
    draft.tag("menu:small-integers");
  } else {
    round_to_grid(draft, 1, random.between(3, 10));
    draft.tag("menu:dyadics");
  }
}

void use_far_menus(Random& random, Draft& draft) {
  switch (random.below(8)) {
    case 0:
    case 1:
      return move_far(random, draft);
    case 2:
    case 3:
    case 4:
      return mix_scales(random, draft);
    case 5:
      return make_denormal(random, draft);
    case 6:
      mix_scales(random, draft);
      return make_denormal(random, draft);
    default:
      return;
  }
}

RandomCase make_by(const Recipe& recipe, Random& random, std::string id) {
  const int mode = random.below(100);
  const bool positive = mode < recipe.positive;
  const bool aimed = !positive && mode < recipe.positive + recipe.aimed;
  const int size = any_size(random, recipe);
  // A case that is made to be positive needs no long sequence.
  const int steps = std::min(any_steps(random, size), positive ? 2 : 8);
  const bool falls = recipe.everyday && aimed;
  Draft draft = falls ? falling_piece(random, recipe.is_closed, size)
                      : any_shape(random, recipe, positive, size);
  if (!positive && random.one_in(12)) {
    for (auto& f : draft.faces) std::swap(f[1], f[2]);
    draft.tag("orientation:inward");
  }
  if (positive) {
    move_positively(random, draft, steps);
  } else if (!falls) {
    move_freely(random, draft, steps, recipe);
  }
  if (recipe.exact && !positive) few_bits(random, draft);
  if (recipe.exact && positive) round_to_grid(draft, 1, 14);
  if (aimed && !falls) aim(random, draft, recipe.exact);
  if (!positive && draft.q0.empty()) choose_view(random, draft);
  if (recipe.nearly_degenerate) miss_nearly(random, draft);
  if (recipe.far) use_far_menus(random, draft);
  if (recipe.everyday) use_everyday_numbers(random, draft);
  if (random.one_in(2)) shuffle_faces(random, draft);
  draft.tag(recipe.is_broken ? "broken" : recipe.is_closed ? "closed" : "unclosed");
  draft.tag(positive ? "mode:positive" : aimed ? "mode:aimed" : "mode:free");
  draft.tag(size_class(draft.faces.size()));
  draft.tag("steps:" + std::to_string(draft.frames.size() - 1));
  // The response asks for judgements of the oracle, so it is left out on meshes where these are
  // slow.
  const std::size_t most_faces = recipe.far ? 16 : 40;
  const bool responds =
      draft.frames.size() > 2 && draft.faces.size() <= most_faces && random.one_in(3);
  if (responds) draft.tag("response");
  RandomCase random_case = finished(std::move(draft), std::move(id));
  if (responds) random_case.c = with_response(random_case.c);
  return random_case;
}

template <const Recipe& recipe>
RandomCase make(Random& random, std::string id) {
  return make_by(recipe, random, std::move(id));
}

constexpr Recipe closed_generic = {.positive = 20, .aimed = 35};
constexpr Recipe closed_near = {.nearly_degenerate = true, .positive = 20, .aimed = 35};
constexpr Recipe closed_exact = {.exact = true, .positive = 30, .aimed = 40};
constexpr Recipe closed_far = {.far = true, .positive = 30, .aimed = 20};
constexpr Recipe unclosed_generic = {.is_closed = false, .positive = 20, .aimed = 40};
constexpr Recipe unclosed_exact = {.is_closed = false, .exact = true, .positive = 25, .aimed = 40};
constexpr Recipe unclosed_near = {
    .is_closed = false, .nearly_degenerate = true, .positive = 30, .aimed = 30};
constexpr Recipe closed_everyday = {.everyday = true, .positive = 12, .aimed = 78};
constexpr Recipe unclosed_everyday = {
    .is_closed = false, .everyday = true, .positive = 12, .aimed = 78};
constexpr Recipe broken_meshes = {.is_closed = false, .is_broken = true, .aimed = 30};

constexpr Recipe counted_generic = {.positive = 10, .aimed = 50};
constexpr Recipe counted_exact = {.is_closed = false, .exact = true, .positive = 10, .aimed = 50};

RandomCase make_counted(Random& random, std::string id) {
  const Recipe& recipe = random.one_in(2) ? counted_generic : counted_exact;
  RandomCase random_case = make_by(recipe, random, std::move(id));
  add_relation(random, random_case);
  return random_case;
}

constexpr Family counted_table[] = {
    {"counted", "bodies, rings, distances at rest; closed generic meshes or exact ones with holes",
     false, true, make_counted}};

RandomCase make_any(Random& random, std::string id) {
  const auto all = families();
  return one_of(random, all).make(random, std::move(id));
}

constexpr Family question_table[] = {
    {"limits", "cases of any family; the question is how far each step can go", false, true,
     make_any},
    {"within", "cases of any family; the question is which pairs come within 2^-6", false, true,
     make_any}};

constexpr Family family_table[] = {
    {"closed-generic", "closed meshes, smooth and local motions, doubles of many bits", true, false,
     make<closed_generic>},
    {"closed-near-degenerate", "slivers, near coincidences, contacts missed or met by an ulp", true,
     false, make<closed_near>},
    {"closed-degenerate", "small integers and dyadics, exact contacts, coplanar or collapsed faces",
     true, true, make<closed_exact>},
    {"closed-far-large-step", "far from the origin, mixed scales, denormals, large steps", true,
     false, make<closed_far>},
    {"unclosed-generic", "1 to 4 holes, sheets, open tubes, spirals, rings that close", false,
     false, make<unclosed_generic>},
    {"unclosed-degenerate", "closed-degenerate, but with holes", false, true, make<unclosed_exact>},
    {"unclosed-near-degenerate", "closed-near-degenerate, but with holes", false, false,
     make<unclosed_near>},
    {"closed-everyday", "everyday sizes, decimals, floats and turns; one piece lands on another",
     true, false, make<closed_everyday>},
    {"unclosed-everyday", "closed-everyday, but with holes and single triangles", false, false,
     make<unclosed_everyday>},
    {"broken", "flipped and zero-area triangles, open seams, 3 to 6 triangles at an edge", false,
     true, make<broken_meshes>},
};

}  // namespace

std::span<const Family> families() { return family_table; }
std::span<const Family> counted_families() { return counted_table; }
std::span<const Family> question_families() { return question_table; }

bool is_question_family(std::string_view name) {
  return std::ranges::find(question_table, name, &Family::name) != std::end(question_table);
}

RandomCase make_case(const Family& family, std::string_view id) {
  Random random(id);
  return family.make(random, std::string(id));
}

namespace {

class Responder {
 public:
  explicit Responder(const Case& c) : original_(c), case_(c) {
    case_.frames.assign(1, c.frames.front());
    case_.expected = {};
    case_.ghosts.reset();
    if (case_.view) {
      for (auto* end : {&case_.view->q0, &case_.view->q1}) {
        if (!end->empty()) end->erase(end->begin() + 1, end->end());
      }
    }
  }

  Case run() {
    for (std::size_t k = 0; k + 1 < original_.frames.size(); ++k) step(k);
    return std::move(case_);
  }

 private:
  // Adds the frame that comes after `now_`: the displacement of step k, times s, is applied.
  std::int32_t add_frame(std::size_t k, double s) {
    const Positions& x = case_.frames[static_cast<std::size_t>(now_)];
    Positions next = x + s * (original_.frames[k + 1] - original_.frames[k]);
    // If a step starts where the given step does, and is not shortened, it has to end exactly where
    // that step ends.
    if (s == 1 && x == original_.frames[k]) next = original_.frames[k + 1];
    case_.frames.push_back(std::move(next));
    if (case_.view) {
      add_place(original_.view->q0, case_.view->q0, k, s);
      if (!original_.view->q1.empty()) add_place(original_.view->q1, case_.view->q1, k, s);
    }
    return static_cast<std::int32_t>(case_.frames.size()) - 1;
  }

  // Adds the place of the view. If a step is not shortened, its view primitive ends where that of
  // the given step ends, because a primitive need not go with the mesh.
  void add_place(const std::vector<Point>& points, std::vector<Point>& new_points, std::size_t k,
                 double s) {
    const Point from = new_points[static_cast<std::size_t>(now_)];
    const Point to = s == 1 ? points[k + 1] : between(from, points[k + 1], s);
    new_points.push_back(to);
  }

  void step(std::size_t k) {
    const std::int32_t whole = add_frame(k, 1);
    const auto judgement = judge(whole);
    if (judgement.answer == Answer::free) {
      case_.script.push_back({now_, whole, true});
      now_ = whole;
      return;
    }
    case_.script.push_back({now_, whole, false});
    constexpr double shares[] = {1, 0.75, 0.25};
    const double s = below_half(judgement.first.lo) * shares[k % 3];
    // If the mesh is in contact from the start, no part of the step is free, and the step is
    // reverted.
    if (s == 0) return;
    const std::int32_t part = add_frame(k, s);
    // This is judged again, because rounded positions can touch although the exact ones do not.
    const bool free = judge(part).answer == Answer::free;
    case_.script.push_back({now_, part, free});
    if (free) now_ = part;
  }

  // Returns the greatest power of two that is at most t / 2. It is 0 if t is 0.
  static double below_half(double t) { return t == 0 ? 0 : std::ldexp(1, std::ilogb(t) - 1); }

  // Judges the step from where the mesh is to a frame.
  oracle::StepJudgement judge(std::int32_t to) const {
    return oracle::judge_step({case_.frames[at(now_)], case_.frames[at(to)]}, case_.triangles,
                              {1, {}});
  }

  const Case& original_;
  Case case_;
  std::int32_t now_ = 0;  // the frame that the mesh is in
};

}  // namespace

Case with_response(const Case& c) {
  assert(c.script.empty());
  return Responder(c).run();
}

}  // namespace assay::properties
