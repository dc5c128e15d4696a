#include "properties/generators/families.h"

#include <string>

#include "properties/generators/recipe.h"

namespace assay::properties {
namespace {

template <const Recipe& recipe>
GeneratedCase make(Random& random, std::string id) {
  return make_by(recipe, random, std::move(id));
}

constexpr Recipe closed_generic = {.positive = 20, .aimed = 35};
constexpr Recipe closed_near = {.nearly_degenerate = true, .positive = 20, .aimed = 35};
constexpr Recipe closed_exact = {.exact = true, .positive = 30, .aimed = 40};
constexpr Recipe closed_far = {.far = true, .positive = 30, .aimed = 20};
constexpr Recipe unclosed_generic = {.closed = false, .positive = 20, .aimed = 40};
constexpr Recipe unclosed_exact = {.closed = false, .exact = true, .positive = 25, .aimed = 40};
constexpr Recipe unclosed_near = {
    .closed = false, .nearly_degenerate = true, .positive = 30, .aimed = 30};
constexpr Recipe broken = {.closed = false, .broken = true, .aimed = 30};

constexpr Family family_table[] = {
    {"closed-generic", "closed meshes, smooth and local motions, doubles of many bits", true, false,
     make<closed_generic>},
    {"closed-near-degenerate", "slivers, near coincidences, contacts missed or met by an ulp", true,
     false, make<closed_near>},
    {"closed-degenerate", "small integers and dyadics, exact contacts, coplanar and collapsed",
     true, true, make<closed_exact>},
    {"closed-far-large-step", "far from the origin, mixed scales, denormals, large steps", true,
     false, make<closed_far>},
    {"unclosed-generic", "1 to 4 holes, sheets, open tubes, spirals", false, false,
     make<unclosed_generic>},
    {"unclosed-degenerate", "as closed-degenerate, with holes", false, true, make<unclosed_exact>},
    {"unclosed-near-degenerate", "as closed-near-degenerate, with holes", false, false,
     make<unclosed_near>},
    {"broken", "no cycles, flipped, zero-area, open seams, 3 to 6 triangles at an edge", false,
     true, make<broken>},
};

}  // namespace

std::span<const Family> families() { return family_table; }

GeneratedCase make_case(const Family& family, std::string_view id) {
  Random random(id);
  return family.make(random, std::string(id));
}

}  // namespace assay::properties
