#include "properties/reducer/passes/passes.h"

namespace assay::properties {

// Passes that reduce much at little cost come first.
std::span<const Pass> shortening_passes() {
  static constexpr Pass passes[] = {
      {"drop later steps", drop_later_steps},
      {"drop steps", drop_steps},
      {"merge steps", merge_steps},
      {"drop unused vertices", drop_unused_vertices},
      {"drop ghosts", drop_ghosts},
      {"drop components", drop_components},
      {"spheres of the pair", try_spheres_of_pair},
      {"keep rings", keep_rings},
      {"cone outside", cone_outside},
      {"cut and close", cut_and_close},
      {"merge balls", merge_balls},
      {"collapse to parents", collapse_to_parents},
      {"drop faces", drop_faces},
      {"collapse edges", collapse_edges},
      {"remove and close", remove_and_close},
      {"merge twice", merge_twice},
      {"small spheres", try_small_spheres},
  };
  return passes;
}

std::span<const Pass> simplifying_passes() {
  static constexpr Pass passes[] = {
      {"freeze vertices", freeze_vertices},
      {"view", simplify_view},
      {"relation", simplify_relation},
      {"round all", round_all},
      {"translate", translate},
  };
  return passes;
}

std::span<const Pass> number_passes() {
  static constexpr Pass passes[] = {
      {"round vertices", round_vertices},
      {"simplify numbers", simplify_numbers},
      {"simplify together", simplify_together},
  };
  return passes;
}

std::span<const Pass> escaping_passes() {
  static constexpr Pass passes[] = {{"escape", escape}};
  return passes;
}

}  // namespace assay::properties
