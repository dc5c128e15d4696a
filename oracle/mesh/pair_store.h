// Pairs of triangles, each with the first of its times that were found.
#pragma once

#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// Keeps one contact for each pair of triangles: the least by time, then feature kind, then feature
// vertices. That is a total order, so what is kept does not depend on the order of add().
class PairStore {
 public:
  // REQUIRES a != b. Their order does not matter.
  void add(std::int32_t a, std::int32_t b, const detector::TimeEnclosure& time,
           const detector::Feature& feature);
  // Moves all contacts of another store into this one.
  void merge(PairStore& other);
  // The kept contacts, ascending by pair; the store is empty afterwards.
  std::vector<detector::PairContact> take();

 private:
  void keep_least();

  std::vector<detector::PairContact> contacts_;
  std::size_t tidy_at_ = 1 << 16;  // when so many are held, only the least of each pair stay
};

}  // namespace assay::oracle
