// Triangle pairs in contact, each with its least time.
#pragma once

#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::oracle {

// Keeps one contact a pair: the least by time, then feature kind, then feature vertices. That is a
// total order, so what is kept does not depend on the order of add().
class PairStore {
 public:
  // a and b in any order, not equal.
  void add(std::int32_t a, std::int32_t b, const detector::TimeEnclosure& time,
           const detector::Feature& feature);
  // Moves all of another store here.
  void merge(PairStore& other);
  // The pairs, ascending; the store is empty afterwards.
  std::vector<detector::PairContact> take();

 private:
  void keep_least();

  std::vector<detector::PairContact> contacts_;
  std::size_t tidy_at_ = 1 << 16;
};

}  // namespace assay::oracle
