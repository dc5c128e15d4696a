#include "corpus/scenes/scenes.h"

#include <fmt/format.h>

#include <array>
#include <new>
#include <string>
#include <utility>

#include "corpus/scenes/shapes.h"

namespace assay::corpus {
namespace {

constexpr int most_triangles = 20'000'000;
constexpr int most_frames = 100'000;

using Frames = Sequence (*)(const SceneOptions& options);

Sequence deform(Mesh mesh, const Extent& extent, Field field, int frames) {
  Sequence sequence{std::move(mesh.triangles), {}};
  for (int f = 0; f < frames; ++f) {
    const double s = frames > 1 ? static_cast<double>(f) / (frames - 1) : 0;
    detector::Positions x = mesh.positions;
    for (std::int32_t v = 0; v < x.rows(); ++v) {
      const detector::Point moved = field(detector::point_of(mesh.positions, v), s, extent);
      x.row(v) << moved[0], moved[1], moved[2];
    }
    sequence.frames.push_back(std::move(x));
  }
  return sequence;
}

// The user's mesh, or the scene's own shape.
template <class Shape>
Sequence deform_any(const SceneOptions& options, Field field, Shape shape) {
  Mesh mesh = options.mesh ? *options.mesh : shape(options.size);
  const Extent extent = extent_of(mesh.positions);
  return deform(std::move(mesh), extent, field, options.frames);
}

Sequence breathing_sphere(const SceneOptions& options) {
  if (options.mesh) return deform_any(options, breathe, sphere_shape);
  // Takes the sphere's own centre, not that of the box around its vertices.
  return deform(sphere_shape(options.size), Extent{}, breathe, options.frames);
}

Sequence two_spheres(const SceneOptions& options) {
  constexpr double distance = 2.7;
  const Mesh sphere = sphere_shape(options.size / 2);
  const auto half = static_cast<std::int32_t>(sphere.positions.rows());
  Mesh both = side_by_side(sphere, sphere, distance);
  Sequence sequence{both.triangles, {}};
  for (int f = 0; f < options.frames; ++f) {
    const double s = options.frames > 1 ? static_cast<double>(f) / (options.frames - 1) : 0;
    const double breath = 0.25 * sin_turn(0.75 * s);
    detector::Positions x = both.positions;
    for (std::int32_t v = 0; v < x.rows(); ++v) {
      const double centre = v < half ? 0 : distance;
      const double factor = v < half ? 1 + breath : 1 - breath;
      x.row(v) << centre + factor * (x(v, 0) - centre), factor * x(v, 1), factor * x(v, 2);
    }
    sequence.frames.push_back(std::move(x));
  }
  return sequence;
}

Sequence arm_in_box(const SceneOptions& options) {
  const BoxWithArm box(options.size);
  Sequence sequence{box.mesh.triangles, {}};
  constexpr double way = BoxWithArm::tip_outside - BoxWithArm::deepest_tip;
  for (int f = 0; f < options.frames; ++f) {
    const double s = options.frames > 1 ? static_cast<double>(f) / (options.frames - 1) : 0;
    sequence.frames.push_back(box.with_tip(BoxWithArm::tip_outside - way * sin_turn(s / 2)));
  }
  return sequence;
}

Sequence bend_scene(const SceneOptions& options) {
  return deform_any(options, bend, [](int size) { return tube_shape(size, true); });
}

Sequence twist_scene(const SceneOptions& options) {
  return deform_any(options, twist, [](int size) { return tube_shape(size, true); });
}

Sequence crumpling_sphere(const SceneOptions& options) {
  return deform_any(options, crumple, sphere_shape);
}

Sequence dented_sphere(const SceneOptions& options) {
  return deform(sphere_shape(options.size), Extent{}, dent, options.frames);
}

Sequence open_tube(const SceneOptions& options) {
  return deform(tube_shape(options.size, false), Extent{}, narrow, options.frames);
}

Sequence pinching_torus(const SceneOptions& options) {
  return deform(torus_shape(options.size), Extent{}, pinch, options.frames);
}

Sequence folding_sheet(const SceneOptions& options) {
  return deform(sheet_shape(options.size), Extent{}, fold, options.frames);
}

Sequence ball_in_tube(const SceneOptions& options) {
  constexpr double radius = 0.2;
  const Mesh tube = tube_shape(options.size / 2, false);
  Mesh ball = sphere_shape(options.size / 2);
  ball.positions *= radius;
  const Mesh both = side_by_side(tube, ball, 0);
  Sequence sequence{both.triangles, {}};
  for (int f = 0; f < options.frames; ++f) {
    const double s = options.frames > 1 ? static_cast<double>(f) / (options.frames - 1) : 0;
    detector::Positions x = both.positions;
    x.bottomRows(ball.positions.rows()).col(2).array() += ball_height(s);
    sequence.frames.push_back(std::move(x));
  }
  return sequence;
}

Sequence inverted_sleeve(const SceneOptions& options) {
  return deform(tube_shape(options.size, false), Extent{}, turn_inside_out, options.frames);
}

Sequence crossing_fans(const SceneOptions& options) {
  return deform(tube_shape(options.size, false), Extent{}, bite_tail, options.frames);
}

Sequence winding_spiral(const SceneOptions& options) {
  return deform(ribbon_shape(options.size), Extent{}, wind, options.frames);
}

// A scene that has a mesh for each time.
template <Mesh (*shape)(int size, double s)>
Sequence play(const SceneOptions& options) {
  Sequence sequence;
  for (int f = 0; f < options.frames; ++f) {
    Mesh mesh =
        shape(options.size, options.frames > 1 ? static_cast<double>(f) / (options.frames - 1) : 0);
    if (f == 0) sequence.triangles = std::move(mesh.triangles);
    sequence.frames.push_back(std::move(mesh.positions));
  }
  return sequence;
}

constexpr std::array<SceneInfo, 18> infos = {{
    {"breathing-sphere", "a sphere that swells and shrinks unevenly; positive from its centre",
     1280, 11, true, true},
    {"two-spheres", "two separate spheres, one swells while the other shrinks; no contact", 1280,
     11, true, false},
    {"dented-sphere", "a dent is pushed through a sphere until it meets the other side", 1280, 11,
     true, false},
    {"bend", "a closed tube is bent into a ring until its ends meet", 1640, 21, true, true},
    {"twist", "a closed tube is twisted by one turn; no contact of its own shape", 1640, 21, true,
     true},
    {"open-tube", "a tube open at both ends gets a waist; no contact", 1600, 11, false, false},
    {"pinching-torus", "the hole of a torus is pressed shut at one place", 1600, 11, true, false},
    {"folding-sheet", "a sheet rolls over until its free edge comes down on it", 800, 21, false,
     false},
    {"crumpling-sphere", "a sphere is folded over itself at many places", 1280, 11, true, true},
    {"arm-in-box", "an arm of an open box enters through its hole and leaves again; no contact",
     1204, 11, false, false},
    {"ball-in-tube", "a ball goes through a tube open at both ends, and back; no contact", 1280, 41,
     false, false},
    {"inverted-sleeve", "a sleeve is turned inside out, over itself, and back; no contact", 1600,
     81, false, false, 41},
    {"crossing-fans", "a tube's narrow end goes into its wide end and out again; no contact", 1600,
     41, false, false},
    {"winding-spiral", "a ribbon winds up to a narrow spiral and unwinds again; no contact", 784,
     81, false, false, 41},
    {"layered-cloth", "layers of cloth slide and bulge into each other; 50 from 1,600 triangles on",
     1600, 11, false, false},
    {"pile-of-bodies", "bodies of 80 triangles are pressed together, turning", 1600, 11, true,
     false},
    {"tightening-knot", "a closed tube in a trefoil knot is drawn tight until it meets itself",
     1536, 11, true, false},
    {"combed-hair", "hanging strips are combed to one side and the other, through each other", 1584,
     11, false, false},
}};
// In the order of `infos`.
constexpr std::array<Frames, 18> makers = {
    breathing_sphere,      two_spheres,      dented_sphere,       bend_scene,
    twist_scene,           open_tube,        pinching_torus,      folding_sheet,
    crumpling_sphere,      arm_in_box,       ball_in_tube,        inverted_sleeve,
    crossing_fans,         winding_spiral,   play<layered_cloth>, play<pile_of_bodies>,
    play<tightening_knot>, play<combed_hair>};

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
      {},
      fmt::format("no scene is named {}{}", name,
                  meant.empty() ? fmt::format("; there are {}", fmt::join(names, ", ")) : meant));
}

Expected<Sequence> make(std::size_t i, SceneOptions options) {
  const SceneInfo& info = infos[i];
  if (options.size == 0) options.size = info.default_size;
  if (options.frames == 0) options.frames = info.default_frames;
  if (options.size < 0 || options.size > most_triangles) {
    return wrong_option(info.name,
                        fmt::format("1 to {} triangles, not {}", most_triangles, options.size));
  }
  if (options.frames < 0 || options.frames > most_frames) {
    return wrong_option(info.name,
                        fmt::format("1 to {} frames, not {}", most_frames, options.frames));
  }
  if (options.mesh && !info.takes_mesh) return wrong_option(info.name, "it takes no mesh");
  if (options.mesh && !is_valid(*options.mesh)) {
    return wrong_option(info.name,
                        "the mesh has no triangle, an index out of range or a "
                        "coordinate that is not finite");
  }
  Sequence sequence = makers[i](options);
  for (const detector::Positions& frame : sequence.frames) {
    if (!frame.allFinite()) return wrong_option(info.name, "the mesh is too large to be deformed");
  }
  return sequence;
}

}  // namespace

std::span<const SceneInfo> scenes() { return infos; }

Expected<Sequence> make_scene(std::string_view name, const SceneOptions& options) try {
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (infos[i].name != name) continue;
    // All frames are held at once; a closed mesh has half as many vertices as triangles.
    const double vertices = options.mesh ? static_cast<double>(options.mesh->positions.rows())
                                         : 0.5 * std::max(options.size, infos[i].default_size);
    const double frames = options.frames > 0 ? options.frames : infos[i].default_frames;
    constexpr double bytes_a_vertex = 24, most_bytes = 8e9;
    if (vertices * frames * bytes_a_vertex > most_bytes) {
      return wrong_option(name, fmt::format("{:.0f} vertices in {:.0f} frames are more than 8 GB",
                                            vertices, frames));
    }
    return make(i, options);
  }
  return unknown_scene(name);
} catch (const std::bad_alloc&) {
  return problem_in({}, fmt::format("scene {}: larger than the memory at hand", name));
}

}  // namespace assay::corpus
