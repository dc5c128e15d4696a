// Changes a case. One list says what each change does to the mesh, to its steps and to all
// positions, and which answers stay the same. The caller passes the random numbers, so that a seed
// always gives the same cases.
//
//   const auto form = changes::mirror.of(c);  // the id of the case seeds the random numbers
//   const auto up = scaled(c, 7);             // by 2^7; nothing if a coordinate loses a bit
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "properties/numbering.h"

namespace assay::properties {

class Random;

// A case in another form.
struct Form {
  Case c;
  // For each triangle of the form: the number of the same triangle in the case, or of the triangle
  // from which it was split.
  Numbers parent;
  // For each step of the case: the number of the same step in the form. Empty if the answers cannot
  // be compared, because coordinates were rounded or steps were divided.
  std::vector<std::size_t> step;
  bool same_times = true;    // contacts keep their times to the last bit
  bool swaps_signs = false;  // V+ becomes V-; answers that rest on L5 differ
};

struct CaseChange {
  // The case's id and this word seed the random numbers.
  std::string_view seed;
  // Returns nothing if the change does not apply, or if it would round a coordinate.
  std::optional<Form> (*draw)(const Case&, Random&);
  // Whether the coordinates of the case are rounded before the change (on_a_grid).
  bool on_grid = false;
  // The steps of the case stay unchanged, and other steps run between them. A detector that claims
  // to be deterministic must give the same answers to the steps of the case.
  bool same_calls = false;
  bool keeps_lengths = true;

  std::optional<Form> of(const Case& c) const;
};

// All changes. A change keeps the answers, pairs and times of a case, unless its Form says
// otherwise. The triangles may get other numbers.
namespace changes {
extern const CaseChange vertex_numbers;
extern const CaseChange triangle_order;  // also begins each triangle at another corner
extern const CaseChange backwards;       // reverses the numbers; needs two or more holes
extern const CaseChange power_of_two;    // all lengths are scaled
extern const CaseChange translation;
extern const CaseChange mirror;  // also reverses all triangles, so that outside stays outside
extern const CaseChange axes;    // permutes the axes; an odd permutation reverses all triangles
extern const CaseChange inside_out;
extern const CaseChange halves;       // each committed step is divided at t=1/2
extern const CaseChange played_back;  // each step from its end to its start, the last step first
extern const CaseChange other_steps_first;  // all steps are played in another order before the case
extern const CaseChange other_evaluations;  // each step comes after its reverse and a step at rest
extern const CaseChange split_edges;        // an edge is split in all of its triangles (L18)
}  // namespace changes

// Reduces the case to its mesh, frames and steps, and returns its form under this change; nothing
// if the change does not apply.
std::optional<Form> form_of(const CaseChange& change, const Case& c);

Form unchanged(const Case& c);

// Parts from which changes are made. They change the view primitive and the ghosts of a case
// together with the mesh.

// Returns the addresses of all coordinates along one axis, or along all axes (axis -1), point by
// point: first those of the frames, then of the view primitive, then of the apexes.
template <class Case>  // const or not
auto numbers_along(Case& c, int axis = -1) {
  std::vector<decltype(c.frames.front().data())> numbers;
  const auto add = [&](auto* point) {
    for (int k = 0; k < 3; ++k) {
      if (axis < 0 || axis == k) numbers.push_back(point + k);
    }
  };
  const auto add_all = [&](auto& points) {
    for (auto& point : points) add(point.data());
  };
  for (auto& frame : c.frames) {
    for (Eigen::Index v = 0; v < frame.rows(); ++v) add(frame.data() + 3 * v);
  }
  if (c.view) {
    add_all(c.view->q0);
    add_all(c.view->q1);
  }
  if (c.ghosts) {
    for (auto& apexes : c.ghosts->apexes) add_all(apexes);
  }
  return numbers;
}

// Returns the addresses of all coordinates of a query: point by point, at its start and at its end.
inline std::vector<double*> numbers_of(FourPoints& query) {
  std::vector<double*> numbers;
  for (auto& point : query.points) {
    for (auto* end : {&point.t0, &point.t1}) {
      for (double& x : *end) numbers.push_back(&x);
    }
  }
  return numbers;
}

// Returns the greatest magnitude of the coordinates of numbers_along.
double largest_along(const Case& c, int axis = -1);
bool is_finite(const Case& c);

// Rounds every coordinate to a multiple of one power of two: 2^-30 times the least power of two
// above all coordinates (or the least denormal, if that is greater). Translations and middle places
// are then exact.
Case on_a_grid(Case c);

// Returns whether a + b is a double, and if so sets `sum` to it.
bool adds_exactly(double a, double b, double& sum);
// Returns whether x * 2^exponent is a double that keeps all bits of x, and if so sets x to it.
bool scales_exactly(double& x, int exponent);

// Return the case scaled by 2^exponent, or translated; nothing if a coordinate would be rounded.
std::optional<Case> scaled(Case c, int exponent);
std::optional<Case> translated(Case c, const Point& by);
// Mirrors the case along an axis, and turns its triangles over.
Case mirrored(Case c, int axis);

// Gives a vertex this path in the step from one frame to another.
void set_path(Case& c, const CaseStep& step, std::int32_t vertex, const MovingPoint& path);
// Gives vertex v the number new_number[v]. The relation of the case keeps the old numbers.
void renumber_vertices(Case& c, const Numbers& new_number);
// Gives triangle t the number new_number[t].
void reorder_triangles(Form& form, const Numbers& new_number);
// Draw another first corner for each triangle, then renumber vertices and triangles. The second
// function also draws the new numbers.
Form renumbered(Random& random, const Case& c, const Numbers& vertices, const Numbers& triangles);
Case renumbered(Random& random, const Case& c);

// Adds a mesh to the case. `places` returns the positions of its vertices in a frame.
void add_mesh(Case& c, const Triangles& triangles,
              const std::function<Positions(std::size_t frame)>& places);
// Repeats the mesh, so that `copies` equal meshes lie side by side, too far apart to meet.
void put_side_by_side(Case& c, int copies);

// Keeps only these frames, each once and in this order, and makes `script` the script of the case.
// The steps of `script` name frames by their old numbers. The script is left out if each step goes
// from one frame to the next.
void take_frames(Case& c, const Numbers& frames, std::vector<CaseStep> script);

}  // namespace assay::properties
