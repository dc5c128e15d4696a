// A saved state as bytes, to be kept in a file or handed to another program.
//
// The form, version 2, is the same on every machine: 8 bytes "assaySAV", a version, the number of
// all bytes, the fields of StateFields in the order of state_bytes.cpp, and a checksum of all
// before it (FNV-1a of 64 bits, byte by byte). Numbers are little-endian, of 64 bits. Doubles are
// written as their bits, flags and kinds as single bytes, a list as its length and then its
// members. The checksum shows damage, but does not protect against forgery.
#pragma once

#include <span>

#include "detector/mesh/problem.h"
#include "detector/state/step_state.h"

namespace assay::detector {

inline constexpr std::uint64_t state_version = 2;

// How many bytes the state takes: 24 for each vertex, 1 for each triangle, 16 for each pair in
// contact, and some for its components and holes. O(M).
std::size_t state_size(const StateFields& state);

// Writes these bytes. REQUIRES that `bytes` has state_size(state) bytes. Allocates nothing. O(M).
void write_state(const StateFields& state, std::span<std::uint8_t> bytes);

// The state that was written. Errors: damaged_state, other_state_version. Whether the state is of
// the right mesh is checked by Detector::restore. Reading takes no more memory than a few times
// the bytes that are there, whatever lengths they claim. O(M).
Expected<StateFields> read_state(std::span<const std::uint8_t> bytes);

}  // namespace assay::detector
