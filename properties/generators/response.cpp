#include "properties/generators/response.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "oracle/mesh/step.h"

namespace assay::properties {
namespace {

using detector::Point;
using detector::Positions;

bool is_free(const Positions& x_t0, const Positions& x_t1, const corpus::Case& c) {
  return oracle::judge_step({x_t0, x_t1}, c.triangles, {1, {}}).answer == detector::Answer::free;
}

Point shortened(const Point& a, const Point& b, double s) {
  Point p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + s * (b[k] - a[k]);
  return p;
}

class Responder {
 public:
  explicit Responder(const corpus::Case& c) : given_(c), made_(c) {
    made_.frames.assign(1, c.frames.front());
    made_.expected = {};
    made_.ghosts.reset();
    if (made_.view) {
      for (auto* end : {&made_.view->q0, &made_.view->q1}) {
        if (!end->empty()) end->erase(end->begin() + 1, end->end());
      }
    }
  }

  corpus::Case run() {
    for (std::size_t k = 0; k + 1 < given_.frames.size(); ++k) step(k);
    return std::move(made_);
  }

 private:
  // Adds the frame that comes after `now_`: the displacement of step k, times s, is applied.
  std::int32_t add_frame(std::size_t k, double s) {
    const Positions& x = made_.frames[static_cast<std::size_t>(now_)];
    Positions next = x + s * (given_.frames[k + 1] - given_.frames[k]);
    // A step that starts where the given one does, and is not shortened, also has to end there
    // exactly.
    if (s == 1 && x == given_.frames[k]) next = given_.frames[k + 1];
    made_.frames.push_back(std::move(next));
    if (made_.view) {
      add_place(given_.view->q0, made_.view->q0, k, s);
      if (!given_.view->q1.empty()) add_place(given_.view->q1, made_.view->q1, k, s);
    }
    return static_cast<std::int32_t>(made_.frames.size()) - 1;
  }

  // The view primitive of a step that is not shortened ends where the given one does, because it
  // need not go with the mesh.
  void add_place(const std::vector<Point>& given, std::vector<Point>& made, std::size_t k,
                 double s) {
    const Point from = made[static_cast<std::size_t>(now_)];
    const Point to = s == 1 ? given[k + 1] : shortened(from, given[k + 1], s);
    made.push_back(to);
  }

  void step(std::size_t k) {
    const std::int32_t whole = add_frame(k, 1);
    const auto judgement =
        oracle::judge_step({frame(now_), frame(whole)}, made_.triangles, {1, {}});
    if (judgement.answer == detector::Answer::free) {
      made_.script.push_back({now_, whole, true});
      now_ = whole;
      return;
    }
    made_.script.push_back({now_, whole, false});
    constexpr double shares[] = {1, 0.75, 0.25};
    const double s = below_half(judgement.first.lo) * shares[k % 3];
    // If the mesh is in contact from the start, no part of the step is free, and the step is
    // reverted.
    if (s == 0) return;
    const std::int32_t part = add_frame(k, s);
    // This is judged again, because rounded positions can touch although the exact ones do not.
    const bool free = is_free(frame(now_), frame(part), made_);
    made_.script.push_back({now_, part, free});
    if (free) now_ = part;
  }

  // The greatest power of two that is at most t / 2. It is 0 if t is 0.
  static double below_half(double t) { return t == 0 ? 0 : std::ldexp(1, std::ilogb(t) - 1); }

  const Positions& frame(std::int32_t f) const { return made_.frames[static_cast<std::size_t>(f)]; }

  const corpus::Case& given_;
  corpus::Case made_;
  std::int32_t now_ = 0;  // the frame that the mesh is in
};

}  // namespace

corpus::Case with_response(const corpus::Case& c) {
  assert(c.script.empty());
  return Responder(c).run();
}

}  // namespace assay::properties
