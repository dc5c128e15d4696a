#include "corpus/scenes/scenes.h"

#include <fmt/format.h>

#include <new>
#include <utility>

#include "corpus/scenes/shapes.h"

namespace assay::corpus {
namespace {

constexpr int most_triangles = 20'000'000;
constexpr int most_frames = 100'000;

// Returns the frames of a mesh that is at `place(s)` at the share s of its way.
template <class Place>
Sequence frames_of(detector::Triangles triangles, int frames, const Place& place) {
  Sequence sequence{std::move(triangles), {}};
  for (int f = 0; f < frames; ++f)
    sequence.frames.push_back(place(frames > 1 ? static_cast<double>(f) / (frames - 1) : 0));
  return sequence;
}

Sequence deform(const Mesh& mesh, const Extent& extent, Field field, int frames) {
  return frames_of(mesh.triangles, frames, [&](double s) {
    detector::Positions x = mesh.positions;
    for (std::int32_t v = 0; v < x.rows(); ++v) {
      const detector::Point moved = field(detector::point_of(mesh.positions, v), s, extent);
      x.row(v) << moved[0], moved[1], moved[2];
    }
    return x;
  });
}

// Returns a shape of the scene's own.
template <Mesh (*shape)(int size), Field field>
Sequence deformed(const SceneOptions& options) {
  return deform(shape(options.size), Extent{}, field, options.frames);
}

// Returns the user's mesh, or the scene's own shape.
template <Mesh (*shape)(int size), Field field>
Sequence deformed_any(const SceneOptions& options) {
  const Mesh mesh = options.mesh ? *options.mesh : shape(options.size);
  return deform(mesh, extent_of(mesh.positions), field, options.frames);
}

Mesh open_tube(int size) { return tube_shape(size, false); }
Mesh closed_tube(int size) { return tube_shape(size, true); }

Sequence breathing_sphere(const SceneOptions& options) {
  // The scene's own shape breathes about the sphere's centre itself, not about that of the box
  // around its vertices.
  return options.mesh ? deformed_any<sphere_shape, breathe>(options)
                      : deformed<sphere_shape, breathe>(options);
}

Sequence two_spheres(const SceneOptions& options) {
  constexpr double distance = 2.7;
  const Mesh sphere = sphere_shape(options.size / 2);
  const auto half = static_cast<std::int32_t>(sphere.positions.rows());
  const Mesh both = side_by_side(sphere, sphere, distance);
  return frames_of(both.triangles, options.frames, [&](double s) {
    const double breath = 0.25 * sin_turn(0.75 * s);
    detector::Positions x = both.positions;
    for (std::int32_t v = 0; v < x.rows(); ++v) {
      const double centre = v < half ? 0 : distance;
      const double factor = v < half ? 1 + breath : 1 - breath;
      x.row(v) << centre + factor * (x(v, 0) - centre), factor * x(v, 1), factor * x(v, 2);
    }
    return x;
  });
}

Sequence arm_in_box(const SceneOptions& options) {
  const BoxWithArm box(options.size);
  constexpr double way = BoxWithArm::tip_outside - BoxWithArm::deepest_tip;
  return frames_of(box.mesh.triangles, options.frames, [&](double s) {
    return box.with_tip(BoxWithArm::tip_outside - way * sin_turn(s / 2));
  });
}

Sequence ball_in_tube(const SceneOptions& options) {
  constexpr double radius = 0.2;
  Mesh ball = sphere_shape(options.size / 2);
  ball.positions *= radius;
  const Mesh both = side_by_side(open_tube(options.size / 2), ball, 0);
  return frames_of(both.triangles, options.frames, [&](double s) {
    detector::Positions x = both.positions;
    x.bottomRows(ball.positions.rows()).col(2).array() += ball_height(s);
    return x;
  });
}

// Returns a scene that has a mesh for each time.
template <Mesh (*shape)(int size, double s)>
Sequence play(const SceneOptions& options) {
  return frames_of(shape(options.size, 0).triangles, options.frames,
                   [&](double s) { return shape(options.size, s).positions; });
}

constexpr SceneInfo infos[] = {
    {"breathing-sphere", "a sphere breathes unevenly; all triangles stay positive from its centre",
     1280, 11, true, true, breathing_sphere},
    {"two-spheres", "one of two separate spheres swells while the other shrinks; no contact", 1280,
     11, true, false, two_spheres},
    {"dented-sphere", "a dent is pushed through a sphere until it meets the other side", 1280, 11,
     true, false, deformed<sphere_shape, dent>},
    {"bend", "a closed tube is bent into a ring until its ends meet", 1640, 21, true, true,
     deformed_any<closed_tube, bend>},
    {"twist", "a closed tube is twisted by one turn; no contact without --mesh", 1640, 21, true,
     true, deformed_any<closed_tube, twist>},
    {"open-tube", "a tube open at both ends gets a waist; no contact", 1600, 11, false, false,
     deformed<open_tube, narrow>},
    {"pinching-torus", "the hole of a torus is pressed shut at one place", 1600, 11, true, false,
     deformed<torus_shape, pinch>},
    {"folding-sheet", "a sheet rolls over until its free edge comes down on it", 800, 21, false,
     false, deformed<sheet_shape, fold>},
    {"crumpling-sphere", "a sphere is folded over itself at many places", 1280, 11, true, true,
     deformed_any<sphere_shape, crumple>},
    {"arm-in-box", "an open box's arm enters the box through a hole and leaves it; no contact",
     1204, 11, false, false, arm_in_box},
    {"ball-in-tube", "a ball goes through a tube open at both ends, and back; no contact", 1280, 41,
     false, false, ball_in_tube},
    {"inverted-sleeve", "a sleeve is turned inside out, over itself, and back; no contact", 1600,
     81, false, false, deformed<open_tube, turn_inside_out>, 41},
    {"crossing-fans", "a tube's narrow end goes into its wide end and out again; no contact", 1600,
     41, false, false, deformed<open_tube, bite_tail>},
    {"winding-spiral", "a ribbon winds up to a narrow spiral and unwinds again; no contact", 784,
     81, false, false, deformed<ribbon_shape, wind>, 41},
    {"layered-cloth", "layers of cloth slide into each other; 50 layers from 1,600 triangles on",
     1600, 11, false, false, play<layered_cloth>},
    {"pile-of-bodies", "bodies of 80 triangles are pressed together, turning", 1600, 11, true,
     false, play<pile_of_bodies>},
    {"tightening-knot", "a closed tube in a trefoil knot is drawn tight until it meets itself",
     1536, 11, true, false, play<tightening_knot>},
    {"combed-hair", "hanging strips are combed to one side, some farther, through the others", 1584,
     11, false, false, play<combed_hair>},
};

Problem wrong_option(std::string_view scene, std::string_view detail) {
  return problem_in({}, fmt::format("scene {}: {}", scene, detail));
}

bool is_valid(const Mesh& mesh) {
  return mesh.positions.rows() > 0 && mesh.triangles.rows() > 0 && mesh.positions.allFinite() &&
         mesh.triangles.minCoeff() >= 0 && mesh.triangles.maxCoeff() < mesh.positions.rows();
}

Problem unknown_scene(std::string_view name) {
  const auto names = names_among(infos);
  const auto meant = did_you_mean(names, name);
  return problem_in(
      {}, fmt::format("no scene is named {}{}", name,
                      meant.empty() ? fmt::format("; scenes: {}", fmt::join(names, ", ")) : meant));
}

Expected<Sequence> make(const SceneInfo& info, SceneOptions options) {
  if (options.size == 0) options.size = info.default_size;
  if (options.frames == 0) options.frames = info.default_frames;
  if (options.size < 0 || options.size > most_triangles) {
    return wrong_option(
        info.name, fmt::format("it has 1 to {} triangles, not {}", most_triangles, options.size));
  }
  if (options.frames < 0 || options.frames > most_frames) {
    return wrong_option(info.name,
                        fmt::format("it has 1 to {} frames, not {}", most_frames, options.frames));
  }
  if (options.mesh && !info.takes_mesh) return wrong_option(info.name, "it takes no other mesh");
  if (options.mesh && !is_valid(*options.mesh)) {
    return wrong_option(info.name,
                        "the mesh has no triangle, an index out of range or a "
                        "coordinate that is not finite");
  }
  Sequence sequence = info.frames(options);
  for (const detector::Positions& frame : sequence.frames) {
    if (!frame.allFinite()) return wrong_option(info.name, "the mesh is too large to be deformed");
  }
  return sequence;
}

}  // namespace

std::span<const SceneInfo> scenes() { return infos; }

Expected<Sequence> make_scene(std::string_view name, const SceneOptions& options) try {
  for (const SceneInfo& info : infos) {
    if (info.name != name) continue;
    // All frames are held at once; a closed mesh has half as many vertices as triangles.
    const double vertices = options.mesh ? static_cast<double>(options.mesh->positions.rows())
                                         : 0.5 * std::max(options.size, info.default_size);
    const double frames = options.frames > 0 ? options.frames : info.default_frames;
    constexpr double bytes_a_vertex = 24, most_bytes = 8e9;
    if (vertices * frames * bytes_a_vertex > most_bytes) {
      return wrong_option(name, fmt::format("{:.0f} vertices in {:.0f} frames need more than 8 GB",
                                            vertices, frames));
    }
    return make(info, options);
  }
  return unknown_scene(name);
} catch (const std::bad_alloc&) {
  return problem_in({}, fmt::format("scene {}: larger than the memory at hand", name));
}

}  // namespace assay::corpus
