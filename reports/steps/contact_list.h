// The pairs in contact of a step, named: which triangles, when, by which features, where, and
// whether the two touch or cross.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "detector/mesh/step_types.h"
#include "properties/judging/trial.h"

namespace assay::reports {

// A step and the pairs that are in contact in it. REQUIRES features that are named.
struct StepContacts {
  const detector::SteppedMesh& motion;
  const detector::TrianglesView& triangles;
  const std::vector<detector::PairContact>& pairs;
  const properties::BodyNames& bodies;
  bool is_at_rest = false;

  // The first `most` of them, a line each, and how many more there are: the earliest first, and at
  // rest those that cross before those that touch. If one is in contact from the start, it touches
  // or crosses; one that comes into contact later touches, and may cross at the end of the step.
  // At rest also how many of all cross.
  std::string text(std::size_t most) const;
  // By pair: at rest, whether it crosses or only touches. Of a moving mesh, and of more than 20,000
  // pairs, all are as if they crossed: at 20 us a pair a soup of 100,000 triangles would wait for
  // it longer than for its answer.
  static constexpr std::uint8_t crossing_mark = 1, touching_mark = 2;
  static constexpr std::size_t most_told_apart = 20'000;
  std::vector<std::uint8_t> marks() const;
  // All of them, in their order (`contacts` of reports/schemas/check.schema.json).
  nlohmann::ordered_json json() const;

 private:
  bool cross_at_start(const detector::PairContact& contact) const;
  bool cross_at_end(const detector::PairContact& contact) const;
};

// Which bodies meet, of a mesh at rest: "the mesh meets itself: 12 pairs", "body 0 meets body 1: 3
// pairs, body 2 meets itself: 1 pair".
std::string rest_text(const std::vector<detector::PairContact>& pairs,
                      const properties::BodyNames& bodies);

}  // namespace assay::reports
