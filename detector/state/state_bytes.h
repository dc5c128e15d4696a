// A saved state as bytes, to be kept in a file or to cross a border.
//
// The form, version 1, the same on every machine: 8 bytes "assaySAV", a version, the number of all
// bytes, the fields of StateFields in the order of state_bytes.cpp, and a checksum of all before it
// (FNV-1a of 64 bits, byte by byte). Numbers are little-endian, of 64 bits; doubles are their bits,
// flags and kinds single bytes; a list is its length and its members. The checksum sees damage; it
// is no protection against forgery.
#pragma once

#include <span>

#include "detector/mesh/problem.h"
#include "detector/state/state_fields.h"

namespace assay::detector {

inline constexpr std::uint64_t state_version = 1;

// How many bytes the state takes: 24 a vertex, 1 a triangle, 16 a pair in contact, and what its
// components and holes take. O(M).
std::size_t state_size(const StateFields& state);

// Writes them; `bytes` has the size that state_size gives. Allocates nothing. O(M).
void write_state(const StateFields& state, std::span<std::uint8_t> bytes);

// The same state again. damaged_state, other_state_version; of which mesh it is, restore() checks.
// Takes no more memory than a few times the bytes that are there, whatever they say. O(M).
Expected<StateFields> read_state(std::span<const std::uint8_t> bytes);

}  // namespace assay::detector
