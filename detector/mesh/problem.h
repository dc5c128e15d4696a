// The named errors of the detector's interface. They are values: nothing in detector/ throws on
// bad input. A caller asks whether there is a detector and, if not, why:
//
//   const Expected<Detector> made = Detector::create(triangles, positions, {});
//   if (!made && made.error().error == InputError::no_triangles) return;  // nothing can collide
//   if (!made) return report(made.error().message);
#pragma once

#include <boost/outcome/basic_result.hpp>
#include <boost/outcome/policy/terminate.hpp>
#include <cstdint>
#include <string>

#include "detector/mesh/enum_names.h"

namespace assay::detector {

// An error never changes its number, because users of assay_builtin_detector.h see the numbers.
// Number 11 was an error that no longer exists.
enum class InputError : std::uint8_t {
  no_triangles = 1,             // an empty mesh has no self-collision to detect
  index_out_of_range = 2,       // a triangle names a vertex that does not exist
  repeated_index = 3,           // a triangle names one vertex twice
  same_vertices_twice = 4,      // two triangles have the same three vertices
  wrong_frame_size = 5,         // positions do not have the mesh's number of vertices
  non_finite_coordinate = 6,    // NaN or infinity
  wrong_primitive_count = 7,    // not 0 view primitives, not 1, and not one for each component
  nothing_to_commit = 8,        // commit() without a completed evaluate()
  foreign_state = 9,            // restore() with the state of another mesh or culling
  damaged_state = 10,           // restore() with a state that contradicts its mesh
  mesh_too_large = 12,          // more triangles or vertices than the detector's indices can number
  stopped = 13,                 // the stop function returned true before the detector was made
  triangle_of_two_bodies = 14,  // a triangle has vertices of two bodies (counted_pairs.h)
  wrong_relation = 15,          // CountedPairs has a value that is impossible
  wrong_separation = 16,        // the separation is not a distance, or other options exclude it
  proves_nothing = 17,          // limit() is called with an arithmetic that promises nothing
  wrong_bound = 18,             // `until` of first_contact is not in [0,1]
};
constexpr auto names_of(InputError) {
  using enum InputError;
  return std::to_array<Named<InputError>>({{no_triangles, "no_triangles"},
                                           {index_out_of_range, "index_out_of_range"},
                                           {repeated_index, "repeated_index"},
                                           {same_vertices_twice, "same_vertices_twice"},
                                           {wrong_frame_size, "wrong_frame_size"},
                                           {non_finite_coordinate, "non_finite_coordinate"},
                                           {wrong_primitive_count, "wrong_primitive_count"},
                                           {nothing_to_commit, "nothing_to_commit"},
                                           {foreign_state, "foreign_state"},
                                           {damaged_state, "damaged_state"},
                                           {mesh_too_large, "mesh_too_large"},
                                           {stopped, "stopped"},
                                           {triangle_of_two_bodies, "triangle_of_two_bodies"},
                                           {wrong_relation, "wrong_relation"},
                                           {wrong_separation, "wrong_separation"},
                                           {proves_nothing, "proves_nothing"},
                                           {wrong_bound, "wrong_bound"}});
}

struct Problem {
  InputError error;
  std::string message;  // one line, for a user
};

template <class T>
using Expected =
    BOOST_OUTCOME_V2_NAMESPACE::basic_result<T, Problem,
                                             BOOST_OUTCOME_V2_NAMESPACE::policy::terminate>;

}  // namespace assay::detector
