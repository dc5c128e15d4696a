// Families of random deforming meshes: one for each stratum of a campaign.
//
// Every case is valid input: coordinates finite, no index repeated in a triangle, no two triangles
// with the same three vertices. Options are left empty and no facts are stated.
//
// Sizes in triangles, in every family: half of the cases 4..12, 30 % 12..40, 15 % 40..100, 5 %
// 100..200 (shapes come as near as they can; a second piece or a repair adds a few). Steps: 60 % of
// the cases have 1, 20 % 2, 12 % 3, 8 % 4..8; large meshes have at most 3.
#pragma once

#include <span>
#include <string_view>

#include "properties/generators/generated_case.h"
#include "properties/random.h"

namespace assay::properties {

struct Family {
  std::string_view name;  // of the stratum
  std::string_view about;
  bool closed = false;      // every case is a cycle
  bool degenerate = false;  // exact coincidences are frequent: the oracle needs its dear rungs
  GeneratedCase (*make)(Random&, std::string id);
};

// The strata's families in a fixed order.
std::span<const Family> families();

// The case of an id "campaign:seed:stratum:index". The id's hash is the only source of randomness:
// any case can be made alone, with the same bytes on every machine. 5 to 300 us.
GeneratedCase make_case(const Family& family, std::string_view id);

}  // namespace assay::properties
