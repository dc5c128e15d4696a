// The families of one size each. Shapes take turns by the index of the case, so that a few cases
// show all of them.
#include <cstdlib>
#include <string>

#include "properties/generators/families.h"
#include "properties/generators/sizes/large_shapes.h"

namespace assay::properties {
namespace {

// The sparse ones come first, because a test can afford a few of them.
constexpr LargeShape shapes[] = {
    {"far-corner", contact_in_a_far_corner},
    {"cloth", layered_cloth},
    {"to-one-point", bodies_to_one_point},
    {"one-place", stacks_in_one_place},
    {"soup", soup_of_bodies},
    {"valence", vertex_of_high_valence},
    {"crumpled", crumpled_sheet},
    {"components", many_components},
    {"tubes", bundle_of_tubes},
    {"sphere", breathing_sphere},
};

// The index of the id, and the number of the attempt behind it ("quick:1:size-1e4:3~2"): a
// contract that cannot have a shape is given the next one.
std::size_t turn_of(const std::string& id) {
  char* end = nullptr;
  const auto index = std::strtoull(id.c_str() + id.rfind(':') + 1, &end, 10);
  const auto attempt = *end == '~' ? std::strtoull(end + 1, nullptr, 10) : 0;
  return static_cast<std::size_t>(index + attempt);
}

// One linear map near the identity, so that nothing lies along the axes. It keeps contacts, but
// for what rounding decides.
void map_all(Random& random, Draft& draft) {
  Point rows[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (auto& row : rows) {
    for (double& entry : row) entry += 0.2 * random.signed_unit();
  }
  for (auto& frame : draft.frames) {
    for (auto& x : frame) x = {dot(rows[0], x), dot(rows[1], x), dot(rows[2], x)};
  }
}

constexpr int largest_with_two_steps = 2000;

template <int triangles>
GeneratedCase make(Random& random, std::string id) {
  const LargeShape& shape = shapes[turn_of(id) % std::size(shapes)];
  Draft draft = shape.make(random, triangles);
  // A second step, which starts where the first one was let go, shows what is carried.
  if (triangles <= largest_with_two_steps) {
    Points beyond;
    for (std::size_t v = 0; v < draft.rest().size(); ++v)
      beyond.push_back(between(draft.frames[0][v], draft.frames[1][v], 1.25));
    draft.frames.push_back(std::move(beyond));
  }
  map_all(random, draft);
  draft.tag(is_cycle(draft.faces) ? "closed" : "unclosed");
  draft.tag(std::string("large:") + shape.name);
  return finished(std::move(draft), std::move(id));
}

constexpr Family table[] = {
    {"size-1e3", "1,000 triangles", false, false, make<1000>, 1000},
    {"size-1e4", "10,000 triangles", false, false, make<10'000>, 10'000},
    {"size-1e5", "100,000 triangles", false, false, make<100'000>, 100'000},
    {"size-1e6", "1,000,000 triangles", false, false, make<1'000'000>, 1'000'000},
};

}  // namespace

std::span<const Family> size_families() { return table; }

bool is_size_family(std::string_view name) {
  for (const auto& family : table) {
    if (family.name == name) return true;
  }
  return false;
}

}  // namespace assay::properties
