// No continuous detection: exact static tests of triangles at ASSAY_PEER_SAMPLES times of the step,
// evenly spaced; the last time is the end of the step. Programs that only have a static test work
// like this.
//
// Version: the version of the CGAL library that it is compiled with. Function: CGAL::do_intersect
// of two Triangle_3 of a kernel with exact predicates (oracle/referee/static_check.cpp). It tests
// triangles that share no vertex and whose boxes meet at the time of the sample; positions at that
// time are rounded to doubles. Settings: the number of samples. Contract: no contact at the start;
// no neighbours, because the function says nothing about triangles that share a vertex; coordinates
// of usual sizes. A triangle without area is not tested, because the function demands an area.
// Claims: only deterministic and total, because nobody promises that samples find every contact.
// The reported time is the interval from the sample before a contact to the sample with the
// contact.
#include "corpus/peers/triangle_pairs.h"

extern "C" int assay_triangles_meet_now(const double* a, const double* b);

namespace assay::peers {
namespace {

constexpr int samples = ASSAY_PEER_SAMPLES;

struct SampledTest {
  static Time first_time(const TrianglePath& s, const TrianglePath& t) {
    if (s.shares_a_vertex_with(t)) return std::nullopt;
    for (int i = 1; i <= samples; ++i) {
      const Corners p(s, i), q(t, i);
      if (p.box().meets(q.box()) && assay_triangles_meet_now(p.at, q.at))
        return plugin::Interval{{time(i - 1), time(i)}};
    }
    return std::nullopt;
  }

 private:
  static double time(int sample) { return static_cast<double>(sample) / samples; }

  struct Corners {
    double at[9];
    Corners(const TrianglePath& path, int sample) {
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
          const double begin = path.at[0][i][k], end = path.at[1][i][k];
          at[3 * i + k] = sample == samples ? end : begin + time(sample) * (end - begin);
        }
      }
    }
    Box box() const {
      Box box = Box::around(at);
      box.take(at + 3);
      box.take(at + 6);
      return box;
    }
  };
};

#define ASSAY_TEXT(number) ASSAY_WORDS(number)
#define ASSAY_WORDS(number) #number

struct Sampled : TrianglePairs<SampledTest> {
  using TrianglePairs::TrianglePairs;
  static plugin::Description describe() {
    plugin::Description d;
    d.name = "static tests at " ASSAY_TEXT(ASSAY_PEER_SAMPLES) " times";
    d.version = "CGAL " ASSAY_PEER_VERSION;
    d.claims = ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL;
    d.adjacency = ASSAY_ADJACENCY_NO_SHARED_VERTEX;
    d.start = ASSAY_START_FREE;
    d.least_nonzero = 1e-6;
    d.largest = 1e6;
    return d;
  }
};

}  // namespace
}  // namespace assay::peers

ASSAY_EXPORT_DETECTOR(assay::peers::Sampled);
