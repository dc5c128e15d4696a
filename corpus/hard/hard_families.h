// Families of hard cases: small meshes and one step each, made from a strength and a variant, with
// the exact answer known by construction.
//
// The strength turns one knob, and a greater strength is harder. At strength s the knob stands at
// 2^(exponent_at_0 + slope * s); what that measures depends on the family: a gap in units of the
// grid, an offset over the size, a scale, a number. One unit of the grid is an ulp of a coordinate
// of 2^52 units; coordinates are below 2^53 (grid_mesh.h). If things in a family can touch, one
// strength after the strongest ends the scale: exact touching, a gap of 0.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "corpus/cases/case_file.h"
#include "corpus/hard/grid_mesh.h"

namespace assay::corpus {

struct HardFamily {
  std::string_view name;
  std::string_view about;  // one line
  std::string_view knob;   // what stands at 2^exponent(s)
  std::string_view unit;   // of the knob; may be empty
  int exponent_at_0;
  int slope;
  int strongest;  // strengths with a knob are 0 .. strongest
  int kinds;      // variants v and v + kinds are of one kind and differ in numbers only
  int touching;   // number of kinds of exact touching; 0: nothing can touch
  // Makes a case, without its id. Kinds from `kinds` on are those of exact touching.
  Case (*make)(Variation& vary, int exponent, int kind);

  int exponent(int strength) const { return exponent_at_0 + slope * strength; }
  bool touches(int strength) const { return strength > strongest; }
  int last_strength() const { return touching > 0 ? strongest + 1 : strongest; }
  int kinds_at(int strength) const { return touches(strength) ? touching : kinds; }
};

std::span<const HardFamily> hard_families();

// A case with id (such as "grazing-s12-v3"), about, one step and its expected answer; first time
// and view signs are stated if the construction tells them. REQUIRES 0 <= strength <=
// last_strength(), variant >= 0. Cases are small: at most 4,100 triangles, mostly 8.
Case hard_case(const HardFamily& family, int strength, int variant);

// The hard families that each file makes; hard_families.cpp puts them together.

std::vector<HardFamily> feature_families();  // near-coplanar, near-parallel, slivers, ...
std::vector<HardFamily> time_families();     // the ends of the step, multiple roots, lengths
std::vector<HardFamily> view_families();     // view tests near zero
std::vector<HardFamily> number_families();   // offsets, scales, denormals
std::vector<HardFamily> crowd_families();    // duplicates, coplanar sheets, many at once

}  // namespace assay::corpus
