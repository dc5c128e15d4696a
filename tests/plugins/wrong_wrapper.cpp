// The built-in detector behind a wrapper that is wrong in one of twelve ways, which
// ASSAY_TEST_WRONG names. All but the last way exist in Python, too
// (tests/reports/python/wrong_detectors.py): a campaign that finds a wrong wrapper in C++ has to
// find the same wrapper in Python.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>
#include <sstream>
#include <string>

#include "detector/detector.h"
#include "detector/plugin/assay_detector.hpp"

namespace {

using namespace assay::plugin;
namespace detector = assay::detector;

enum Way {
  drop_a_pair,
  late_by_an_ulp,
  late_pairs,
  forget_commit,
  free_when_few,
  drop_neighbours,
  round_to_float,
  free_at_start,
  add_a_pair,
  half_a_step,
  drawn_when_loaded,  // right, but never twice the same
  drop_edge_edge
};

// ASSAY_TEST_WRONG: "5", or "5,7" for two at once.
bool is(Way way) {
  const char* numbers = std::getenv("ASSAY_TEST_WRONG");
  std::istringstream list(numbers ? numbers : "0");
  for (std::string number; std::getline(list, number, ',');) {
    if (std::atoi(number.c_str()) == way) return true;
  }
  return false;
}

// Another number in each process.
double drawn() {
  static std::random_device source;
  static const double number = std::uniform_real_distribution<>(.1, .9)(source);
  return number;
}

double later(double time) { return std::min(1.0, std::nextafter(time, 2.0)); }

class Wrong {
 public:
  static Description describe() {
    Description d;
    d.name = "wrong wrapper";
    d.claims = ASSAY_CLAIM_FREE_SOUND | ASSAY_CLAIM_NOT_LATE | ASSAY_CLAIM_FIRST_TIME |
               ASSAY_CLAIM_FIRST_PAIRS | ASSAY_CLAIM_ALL_PAIRS | ASSAY_CLAIM_NO_SPURIOUS |
               ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL;
    return d;
  }

  explicit Wrong(const Mesh& mesh)
      : triangles_(eigen(mesh.triangles)), start_(eigen(mesh.positions)), end_(start_) {
    auto made = detector::Detector::create(triangles_, start_, {});
    if (!made) throw Refused(made.error().message);
    detector_ = std::make_unique<detector::Detector>(std::move(made.value()));
  }

  Result evaluate(Positions given_t0, Positions given_t1) {
    detector::Positions x_t0 = eigen(given_t0), x_t1 = eigen(given_t1);
    end_ = x_t1;
    if (is(forget_commit)) x_t0 = start_;
    if (is(round_to_float)) {
      x_t0 = x_t0.cast<float>().cast<double>();
      x_t1 = x_t1.cast<float>().cast<double>();
    }
    if (is(half_a_step)) x_t1 = (x_t0 + x_t1) / 2;
    return spoiled(detector_->evaluate(x_t0, x_t1));
  }

  void commit() {
    detector_->commit();
    if (!is(forget_commit)) start_ = end_;
  }

 private:
  bool are_neighbours(const detector::TrianglePair& pair) const {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (triangles_(pair.a, i) == triangles_(pair.b, j)) return true;
    return false;
  }

  Result spoiled(const detector::StepResult& answered) const {
    if (answered.answer == detector::Answer::error) return Result::error("refused");
    if (answered.answer != detector::Answer::collision) return Result::free();
    if (is(free_when_few) && answered.pairs.size() < 3) return Result::free();
    if (is(free_at_start) && answered.first.lo == 0) return Result::free();
    Result result = Result::collision(answered.first.lo, answered.first.hi);
    if (is(drawn_when_loaded)) result.first[0] *= drawn();
    if (is(late_by_an_ulp)) result.first = {{later(answered.first.lo), later(answered.first.hi)}};
    std::set<Pair> known;
    for (const auto& [pair, time, feature] : answered.pairs) {
      known.insert({{pair.a, pair.b}});
      if (is(drop_neighbours) && are_neighbours(pair)) continue;
      if (is(drop_edge_edge) && feature.kind == detector::FeatureKind::edge_edge) continue;
      const bool is_late = is(late_pairs);
      result.add(pair.a, pair.b, is_late ? later(time.lo) : time.lo,
                 is_late ? later(time.hi) : time.hi);
    }
    if (is(drop_a_pair)) result.pairs.erase(result.pairs.begin()), result.pair_times.clear();
    if (is(add_a_pair) && triangles_.rows() > 1 && !known.contains({{0, 1}}))
      result.add(0, 1, answered.first.lo, answered.first.hi);
    return result;
  }

  detector::Triangles triangles_;
  detector::Positions start_, end_;
  std::unique_ptr<detector::Detector> detector_;
};

}  // namespace

ASSAY_EXPORT_DETECTOR(Wrong);
