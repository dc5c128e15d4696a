// Reads the polygonal part of Wavefront OBJ.
#pragma once

#include <filesystem>
#include <string_view>

#include "corpus/formats/mesh_reader.h"

namespace assay::corpus {

// `v` and `f` (v, v/vt, v//vn, v/vt/vn, negative indices, polygons) make the mesh; texture
// coordinates, normals, groups, materials, lines, points and curves are passed over. A line with
// any other keyword is refused, so that noise is not taken for a mesh.
Expected<Mesh> read_obj(std::string_view text, const std::filesystem::path& file);

}  // namespace assay::corpus
