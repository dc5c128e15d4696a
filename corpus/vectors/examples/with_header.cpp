// A detector behind assay_vectors.h: it compares the boxes around the ways of the points. It never
// misses a contact, and raises many alarms.
//   c++ -std=c++17 -O2 with_header.cpp -o with_header
//   ./with_header ..                               asks by itself, and writes results.json
//   python3 ../vectors.py run -- ./with_header     is asked by a program that survives its crashes
#include <algorithm>

#include "../assay_vectors.h"

namespace {

struct Boxes : assay_vectors::Detector {
  // Whether the boxes around the points [begin, middle) and [middle, 4) come within the distance.
  static Answer compare(double distance, std::size_t middle, const Points& t0, const Points& t1) {
    for (std::size_t k = 0; k < 3; ++k) {
      double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
      for (std::size_t i = 0; i < 4; ++i) {
        const int side = i < middle ? 0 : 1;
        lo[side] = std::min({lo[side], t0[i][k], t1[i][k]});
        hi[side] = std::max({hi[side], t0[i][k], t1[i][k]});
      }
      // Compared without a sum that would be rounded, but for the distance.
      if (distance == 0 ? hi[0] < lo[1] || hi[1] < lo[0]
                        : lo[1] - hi[0] > distance || lo[0] - hi[1] > distance) {
        return Answer::free();
      }
    }
    return Answer::collision(0);
  }
  Answer vertex_face(const Points& t0, const Points& t1) override { return compare(0, 1, t0, t1); }
  Answer edge_edge(const Points& t0, const Points& t1) override { return compare(0, 2, t0, t1); }
  Answer vertex_face_within(double d, const Points& t0, const Points& t1) override {
    return compare(d, 1, t0, t1);
  }
  Answer edge_edge_within(double d, const Points& t0, const Points& t1) override {
    return compare(d, 2, t0, t1);
  }
};

}  // namespace

int main(int count, char** words) try {
  Boxes boxes;
  const assay_vectors::Product product = {"boxes", "1", "swept boxes of the features"};
  if (count < 2) return assay_vectors::serve(product, boxes);
  assay_vectors::run(words[1], product, boxes, "results.json");
} catch (const std::exception& problem) {
  std::fprintf(stderr, "with_header: %s\n", problem.what());
  return 2;
}
