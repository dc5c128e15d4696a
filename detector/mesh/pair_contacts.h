// The triangle pairs in contact in a step, each with its first contact.
//
// They come from feature pairs: a triangle pair comes up to 21 times, and what lies upon each other
// makes M^2 / 2 pairs. So what came lately is sorted in among the rest as soon as it is a quarter
// of it, and a pair is kept once: 60 bytes a pair, 48 of them the result; 108 while the list grows.
// O(log n) for each that comes, all in all.
#pragma once

#include <vector>

#include "detector/mesh/step_types.h"

namespace assay::detector {

class PairContacts {
 public:
  void add(const PairContact& contact) {
    if (all_.size() == all_.capacity()) make_room();
    all_.push_back(contact);
  }

  // Pairs that have come since this was last asked, each once.
  std::vector<TrianglePair> take_new_pairs();
  // Ascending by pair; of the contacts of a pair the first in time, at one time the one of the
  // least feature kind, then of the least vertices. Nothing is left behind.
  std::vector<PairContact> take();

  // What is held, in bytes.
  std::size_t bytes() const {
    return all_.capacity() * sizeof(PairContact) + new_.capacity() * sizeof(TrianglePair);
  }

 private:
  void make_room();
  void settle();

  std::vector<PairContact> all_;
  std::size_t settled_ = 0;  // so many are ascending, each pair once
  std::vector<TrianglePair> new_;
};

}  // namespace assay::detector
