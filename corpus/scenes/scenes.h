// Kinematic scenes: deforming meshes of any size and number of frames. No physics.
//
// Scenes are deterministic: the same name and options give the same doubles on every platform,
// because the scenes use sines and cosines of shapes.h, and otherwise only + - * / and sqrt. Closed
// scenes are cycles with outward normals, and frame 0 of every scene is free of contact.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "corpus/formats/sequences.h"
#include "corpus/problem.h"

namespace assay::corpus {

struct SceneOptions;

struct SceneInfo {
  std::string_view name;
  std::string_view about;  // one line
  int default_size;        // triangles
  int default_frames;
  bool closed;                                      // the scene's own shape has no unmatched edge
  bool takes_mesh;                                  // the scene can deform a user's mesh
  Sequence (*frames)(const SceneOptions& options);  // REQUIRES options that the scene takes
  // With at least this many frames, `about` is right about contacts. With fewer frames, the
  // straight paths of the steps differ too much from the scene's motion.
  int least_frames = 5;
};

// Returns all scenes, in the order in which they are listed.
std::span<const SceneInfo> scenes();

// Frames are equally spaced in the scene's own time. Two frames are one step; a single frame is the
// rest shape.
struct SceneOptions {
  int size = 0;    // wanted triangles: the nearest possible number is used; 0: the default
  int frames = 0;  // 1 or more; 0: the default
  std::optional<Mesh> mesh;  // replaces the scene's own shape; then size is ignored
};

// Refuses an unknown name (the message lists the names), options that the scene does not take, and
// too large a size.
Expected<Sequence> make_scene(std::string_view name, const SceneOptions& options);

}  // namespace assay::corpus
