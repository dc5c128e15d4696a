#include "detector/mesh/problem.h"

namespace assay::detector {

const char* name_of(InputError error) {
  switch (error) {
    case InputError::no_triangles:
      return "no_triangles";
    case InputError::index_out_of_range:
      return "index_out_of_range";
    case InputError::repeated_index:
      return "repeated_index";
    case InputError::same_vertices_twice:
      return "same_vertices_twice";
    case InputError::wrong_frame_size:
      return "wrong_frame_size";
    case InputError::non_finite_coordinate:
      return "non_finite_coordinate";
    case InputError::wrong_primitive_count:
      return "wrong_primitive_count";
    case InputError::nothing_to_commit:
      return "nothing_to_commit";
    case InputError::foreign_state:
      return "foreign_state";
    case InputError::damaged_state:
      return "damaged_state";
    case InputError::other_state_version:
      return "other_state_version";
    case InputError::mesh_too_large:
      return "mesh_too_large";
    case InputError::stopped:
      return "stopped";
  }
  return "unknown_error";
}

}  // namespace assay::detector
