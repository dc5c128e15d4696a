// Small worlds of elementary queries, enumerated completely: all queries whose points lie on a tiny
// grid at t=0 and t=1, one of each class under the symmetries that change neither the answer nor
// the time. These are the order of the vertices in a group, the order of the two edges, axes
// exchanged, and axes mirrored.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "properties/queries/query_methods.h"

namespace assay::properties {

enum class WorldMotion : std::uint8_t { every_point_moves, one_point_moves };

class SmallWorld {
 public:
  // A grid of side^dimensions points with coordinates 0..side-1 (-1..1 if side is 3); coordinates
  // on the other axes are 0.
  SmallWorld(int side, int dimensions, WorldMotion motion);

  // The number of places of the enumeration. Most hold no query, because an equal one stands at
  // another place.
  std::uint64_t places() const;
  // The query at a place, or nothing. Takes 10 ns to 2 us.
  std::optional<Query> at(std::uint64_t place) const;

  using Path = std::array<int, 2>;  // grid points at t=0 and t=1
  using Paths = std::array<Path, 4>;

 private:
  struct Arranged {
    Paths paths;
    int first_group;
    bool mover_first;  // the order within the mover's group is fixed by the mover
  };

  std::optional<Arranged> arranged_at(std::uint64_t place) const;
  bool is_least_of_its_class(const Arranged& query) const;
  Query query_of(const Arranged& query) const;

  int side_, dimensions_;
  WorldMotion motion_;
  int grid_points_;
  std::vector<std::vector<int>> symmetries_;  // grid point to grid point
};

}  // namespace assay::properties
