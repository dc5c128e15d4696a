// The named errors of the detector's interface. They are values: nothing in detector/ throws on
// bad input.
#pragma once

#include <boost/outcome/basic_result.hpp>
#include <boost/outcome/policy/terminate.hpp>
#include <cstdint>
#include <string>

namespace assay::detector {

enum class InputError : std::uint8_t {
  no_triangles = 1,           // an empty mesh has no self-collision to detect
  index_out_of_range = 2,     // a triangle names a vertex that does not exist
  repeated_index = 3,         // a triangle names one vertex twice
  same_vertices_twice = 4,    // two triangles have the same three vertices
  wrong_frame_size = 5,       // positions do not have the mesh's number of vertices
  non_finite_coordinate = 6,  // NaN or infinity
  wrong_primitive_count = 7,  // not none, one, or one view primitive for each component
  nothing_to_commit = 8,      // commit() without a completed evaluate()
  foreign_state = 9,          // restore() with the state of another mesh or culling
  damaged_state = 10,         // the bytes are no saved state, or were cut or changed
  other_state_version = 11,   // the saved state has a form that this build does not read
  mesh_too_large = 12,        // more triangles or vertices than the detector's indices can number
  stopped = 13,               // the stop function asked for an end before there was a detector
};

const char* name_of(InputError error);

struct Problem {
  InputError error;
  std::string message;  // one line, for a user
};

template <class T>
using Expected =
    BOOST_OUTCOME_V2_NAMESPACE::basic_result<T, Problem,
                                             BOOST_OUTCOME_V2_NAMESPACE::policy::terminate>;

}  // namespace assay::detector
