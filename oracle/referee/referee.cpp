#include "oracle/referee/referee.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "oracle/processor_state.h"
#include "oracle/referee/existence.h"

namespace assay::oracle {

namespace {

template <class Query>
class Referee {
 public:
  Referee(const Query& query, const RefereeOptions& options)
      : query_(query), options_(options), hull_(double_hull(query)) {}

  detector::Decision run() {
    const int deepest = std::clamp(options_.depth, 0, most_depth);
    std::vector<std::int64_t> pieces = {0};  // piece k of depth d is [k/2^d, (k+1)/2^d]
    std::uint64_t looked_at = 0;
    // Goes breadth first, so that a contact is found while few pieces are left, whatever its time.
    for (int depth = 0; depth <= deepest; ++depth) {
      std::vector<std::int64_t> left;
      for (const std::int64_t k : pieces) {
        if (++looked_at > options_.max_boxes) return detector::Decision::open;
        if (!separated(k, depth)) left.push_back(k);
      }
      if (left.empty()) return detector::Decision::no;
      if (contact_in_some(left, depth)) return detector::Decision::yes;
      pieces.clear();
      for (const std::int64_t k : left) {
        pieces.push_back(2 * k);
        if (begins_in_time(2 * k + 1, depth + 1)) pieces.push_back(2 * k + 1);
      }
    }
    return detector::Decision::open;
  }

 private:
  static constexpr int most_depth = 61;
  static constexpr int most_depth_of_doubles = 53;  // the ends, and 1 minus them, are doubles
  static constexpr std::size_t witnesses_a_level = 4;

  // Made when doubles do not suffice.
  const IntegerHull& exact() {
    if (!exact_) exact_ = integer_hull(query_);
    return *exact_;
  }

  static double time(std::int64_t k, int depth) {
    return std::ldexp(static_cast<double>(k), -depth);
  }

  // False: the piece is sure to begin at `until` or later, so it is not asked about.
  bool begins_in_time(std::int64_t k, int depth) const {
    return depth > most_depth_of_doubles || time(k, depth) < options_.until;
  }

  bool separated(std::int64_t k, int depth) {
    if (depth <= most_depth_of_doubles) {
      const SeparationProof quick = separated_in_double(hull_, time(k, depth), time(k + 1, depth));
      if (quick != SeparationProof::near) return quick == SeparationProof::separated;
    }
    return separated_in_integers(exact(), k, depth);
  }

  bool contact_in_some(const std::vector<std::int64_t>& left, int depth) {
    if (depth == 0 && options_.until >= 1 && contact_at({1, 1})) return true;
    const std::size_t tries = std::min(left.size(), witnesses_a_level);
    for (std::size_t i = 0; i < tries; ++i) {
      const std::int64_t k = left[i * left.size() / tries];
      if (contact_at(simplest_fraction(k, depth))) return true;
      if (crossing(guess_crossing(hull_, time(k, depth), time(k + 1, depth)))) return true;
    }
    return false;
  }

  bool contact_at(const Fraction& time) {
    if (std::find(tried_.begin(), tried_.end(), time) != tried_.end()) return false;
    tried_.push_back(time);
    if (mpq_class(time.p, time.q) > mpq_class(options_.until)) return false;
    return contains_origin(exact().at(time.p, time.q));
  }

  bool crossing(const std::optional<Crossing>& guess) {
    if (!guess) return false;
    // Many pieces lead to the same place, which is to be tried once.
    constexpr double same_place = 0x1p-40;
    for (const Crossing& c : refused_) {
      if (c.base == guess->base && std::fabs(c.t - guess->t) < same_place &&
          std::fabs(c.u - guess->u) < same_place && std::fabs(c.v - guess->v) < same_place) {
        return false;
      }
    }
    refused_.push_back(*guess);
    return crossing_in_a_box(exact(), *guess, options_.until);
  }

  const Query& query_;
  const RefereeOptions options_;
  const DoubleHull hull_;
  std::optional<IntegerHull> exact_;
  std::vector<Fraction> tried_;
  std::vector<Crossing> refused_;
};

}  // namespace

detector::Decision referee(const detector::VertexFace& query, const RefereeOptions& options) {
  require_exact_processor_state();
  return Referee(query, options).run();
}

detector::Decision referee(const detector::EdgeEdge& query, const RefereeOptions& options) {
  require_exact_processor_state();
  return Referee(query, options).run();
}

detector::Decision referee(const detector::FourPoints& query, const RefereeOptions& options) {
  const auto& p = query.points;
  return query.first_group == 1 ? referee(detector::VertexFace{p[0], {p[1], p[2], p[3]}}, options)
                                : referee(detector::EdgeEdge{{p[0], p[1]}, {p[2], p[3]}}, options);
}

}  // namespace assay::oracle
