// Changes of a case, one list of them: what each does to the mesh, its steps and all places, and
// which answers it keeps. Who draws a change hands in the random numbers, so that the cases of a
// seed stay what they are.
//
//   const auto form = changes::mirror.of(c);  // drawn by the id of the case
//   const auto up = scaled(c, 7);             // by this power of two; nothing if a bit is lost
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/numbering.h"

namespace assay::properties {

class Random;

// A case in another form.
struct Form {
  corpus::Case c;
  // By triangle of the form: the triangle of the case that it is, or of which it is a part.
  Numbers parent;
  // By step of the case: the step of the form that it has become. Empty if the answers cannot be
  // set side by side, because coordinates were rounded or steps divided.
  std::vector<std::size_t> step;
  bool same_times = true;    // contacts keep their times to the last bit
  bool swaps_signs = false;  // V+ becomes V-; what rests on L5 then differs
};

struct CaseChange {
  // Its random numbers are those of the case's id and of this word.
  std::string_view seed;
  // Nothing if the change does not apply, or if it would round a coordinate.
  std::optional<Form> (*draw)(const corpus::Case&, Random&);
  // It is made of a case whose coordinates were rounded before (on_a_grid).
  bool on_grid = false;
  // The steps of the case are asked for as they were, between others that must not matter: what a
  // detector that claims to be deterministic answers is then the same.
  bool same_calls = false;
  bool keeps_lengths = true;

  std::optional<Form> of(const corpus::Case& c) const;
};

// The list. Each keeps answers, and pairs up to the numbers of triangles; times too, unless the
// form says otherwise.
namespace changes {
extern const CaseChange vertex_numbers;
extern const CaseChange triangle_order;  // each triangle begins at another corner, too
extern const CaseChange backwards;       // vertices and triangles; of a mesh with two holes or more
extern const CaseChange power_of_two;    // all lengths are scaled
extern const CaseChange translation;
extern const CaseChange mirror;  // turned over, so that outside stays outside
extern const CaseChange axes;    // exchanged, and turned over where that mirrors
extern const CaseChange inside_out;
extern const CaseChange halves;             // of each step that is committed
extern const CaseChange played_back;        // each step from its end to its start, the last first
extern const CaseChange other_steps_first;  // all steps in another order, and then the case
extern const CaseChange other_evaluations;  // before each step the way back, and a step at rest
extern const CaseChange split_edges;        // in all triangles that have them (L18)
}  // namespace changes

// The case with its mesh, frames and steps alone, put into this form.
std::optional<Form> form_of(const CaseChange& change, const corpus::Case& c);

Form unchanged(const corpus::Case& c);

// What changes are made of. A case may have a view primitive and ghosts; these go with the mesh.

// The addresses of all coordinates along one axis, or along all (axis -1): point by point, those of
// the frames, of the view primitive, of the apexes.
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

// All of a query: point by point, where it starts and where it ends.
inline std::vector<double*> numbers_of(detector::FourPoints& query) {
  std::vector<double*> numbers;
  for (auto& point : query.points) {
    for (auto* end : {&point.t0, &point.t1}) {
      for (double& x : *end) numbers.push_back(&x);
    }
  }
  return numbers;
}

// The greatest magnitude of these numbers.
double largest_along(const corpus::Case& c, int axis = -1);
bool is_finite(const corpus::Case& c);

// The case with every coordinate rounded to a multiple of one power of two: 2^-30 of the least
// power of two above them all (or the least denormal, if that is greater). Translations and middle
// places are then exact.
corpus::Case on_a_grid(corpus::Case c);

// Whether a + b is a double; then `sum` is it.
bool adds_exactly(double a, double b, double& sum);
// Whether x * 2^exponent is a double that keeps all bits of x; then x becomes it.
bool scales_exactly(double& x, int exponent);

// By a power of two, and by a vector; nothing if a coordinate would be rounded.
std::optional<corpus::Case> scaled(corpus::Case c, int exponent);
std::optional<corpus::Case> translated(corpus::Case c, const detector::Point& by);
// Mirrored along an axis, and turned over.
corpus::Case mirrored(corpus::Case c, int axis);

// Gives a vertex this path in the step from one frame to another.
void set_path(corpus::Case& c, const corpus::CaseStep& step, std::int32_t vertex,
              const detector::MovingPoint& path);
// Vertex v becomes new_number[v]. A relation stays as it is.
void renumber_vertices(corpus::Case& c, const Numbers& new_number);
// Triangle t becomes new_number[t].
void reorder_triangles(Form& form, const Numbers& new_number);
// Both, after each triangle was begun at another corner, which is drawn; the numbers, too, if none
// are given.
Form renumbered(Random& random, const corpus::Case& c, const Numbers& vertices,
                const Numbers& triangles);
corpus::Case renumbered(Random& random, const corpus::Case& c);

// Adds a mesh with a place for each of its vertices in each frame of the case.
void add_mesh(corpus::Case& c, const detector::Triangles& triangles,
              const std::function<detector::Positions(std::size_t frame)>& places);
// Puts copies of the mesh side by side, so far apart that none meets another.
void put_side_by_side(corpus::Case& c, int copies);

// Keeps these frames alone, each once and in this order, and makes the script of these steps, which
// name frames by their old numbers. The script is left out if it says no more than that consecutive
// frames are the steps.
void take_frames(corpus::Case& c, const Numbers& frames, std::vector<corpus::CaseStep> script);

}  // namespace assay::properties
