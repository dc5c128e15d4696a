// Kinematic scenes: deforming meshes of any size and number of frames. No physics.
//
// Scenes are deterministic: the same name and options give the same doubles on every platform,
// because sines and cosines are the room's own (see shapes.h) and all else is + - * / and sqrt.
// Closed scenes are cycles with outward normals, and frame 0 of every scene is free of contact.
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
  bool closed;                                      // of its own shape: every edge is matched
  bool takes_mesh;                                  // may be applied to a user's mesh
  Sequence (*frames)(const SceneOptions& options);  // REQUIRES options that the scene takes
  // With at least this many frames, the statements about contacts hold; with fewer, steps cut
  // corners of the motion.
  int least_frames = 5;
};

// Returns all scenes, in the order in which they are listed.
std::span<const SceneInfo> scenes();

// Frames are equally spaced in the scene's own time. Two frames are one step; one is the rest
// shape.
struct SceneOptions {
  int size = 0;    // triangles wanted: the nearest reachable number is used; 0: the default
  int frames = 0;  // 1 or more; 0: the default
  std::optional<Mesh> mesh;  // deform this one in place of the scene's own shape; size is ignored
};

// Refuses an unknown name (the message lists the names), options that the scene does not take, and
// too large a size.
Expected<Sequence> make_scene(std::string_view name, const SceneOptions& options);

}  // namespace assay::corpus
