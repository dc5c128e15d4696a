// Uses the installed detector on a tetrahedron whose top goes through its base: a collision at
// t=1/2.
#include <cstdio>

#include "detector/detector.h"

using namespace assay::detector;

int main() {
  Triangles triangles(4, 3);
  triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  Positions x_t0(4, 3);
  x_t0 << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 2;
  Positions x_t1 = x_t0;
  x_t1(3, 2) = -2;

  auto detector = Detector::create(triangles, x_t0, {});
  if (!detector) return 1;
  const StepResult result = detector.value().step(x_t0, x_t1);
  std::printf("%s at t = %g, %zu pairs\n",
              result.answer == Answer::collision ? "collision" : "free", result.first.lo,
              result.pairs.size());
  if (result.answer != Answer::collision || result.first.lo != 0.5) return 1;

  // Its state serves another detector of the same mesh.
  const SavedState saved = detector.value().state();
  auto other = Detector::create(triangles, x_t0, {});
  return other && !other.value().restore(saved) && other.value().state() == saved ? 0 : 1;
}
