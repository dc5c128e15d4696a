// All triangulated spheres with few vertices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace assay::properties {

using SphereMesh = std::vector<std::array<std::int32_t, 3>>;  // oriented alike; a cycle

// Every triangulation of the sphere with the vertices 0 .. n-1, for 4 <= n <= 7: there are 1, 10,
// 195 and 5712 (vertices labelled, no two triangles with the same corners, mirror images not
// listed apart). They are found by edge flips, under which they are connected (Wagner 1936), and
// are made once.
const std::vector<SphereMesh>& sphere_meshes(int vertices);

SphereMesh mirrored(SphereMesh mesh);

// The mesh with the edge of corners i and i+1 of triangle t flipped, so that it joins the two
// opposite vertices. Empty if that edge is not shared by exactly two triangles, or if the new edge
// exists already.
SphereMesh flipped(const SphereMesh& mesh, std::size_t t, std::size_t i);

}  // namespace assay::properties
