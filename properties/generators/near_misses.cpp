#include "properties/generators/near_misses.h"

#include <cmath>

#include "properties/generators/menus.h"

namespace assay::properties {
namespace {

double tiny(Random& random) {
  const double mantissa = random.signed_unit();
  return std::ldexp(mantissa, -random.between(20, 45));
}

// A place on the face but for a tiny offset: at a vertex, on an edge, or inside.
Point beside(Random& random, const Points& x, const Face& f, int kind) {
  const Point &a = at(x, f[0]), &b = at(x, f[1]), &c = at(x, f[2]);
  const Point offset = {tiny(random), tiny(random), tiny(random)};
  const double s = random.unit();
  if (kind == 0) return a + offset;
  if (kind == 1) return between(a, b, s) + offset;
  return between(between(a, b, s), c, random.unit()) + offset;
}

void put_beside(Random& random, Draft& draft) {
  const Face own = any_of(random, draft.faces), target = any_of(random, draft.faces);
  const std::int32_t v = own[at(random.below(3))];
  // If the target holds v, it becomes a sliver: v goes to the opposite edge.
  const bool sliver = target[0] == v || target[1] == v || target[2] == v;
  Face f = target;
  while (sliver && f[2] != v) f = {f[1], f[2], f[0]};
  const int kind = sliver ? 1 : random.below(3);
  const bool always = random.one_in(4);
  // Mostly a later frame is chosen, so that the start stays clean.
  const auto only = draft.frames.size() - 1 - (random.one_in(4) ? 1 : 0);
  for (std::size_t k = 0; k < draft.frames.size(); ++k) {
    Points& x = draft.frames[k];
    if (always || k == only) at(x, v) = beside(random, x, f, kind);
  }
  draft.tag(sliver ? "menu:sliver" : "menu:near-coincidence");
}

}  // namespace

void miss_nearly(Random& random, Draft& draft) {
  const int kind = random.below(3);
  if (kind <= 1) place_ulp_neighbours(random, draft);
  if (kind >= 1) put_beside(random, draft);
}

}  // namespace assay::properties
