// Turns a peer that tells the first contact time into a limiter, which tells how far a step can be
// taken. Each such peer is built twice: as NAME with ASSAY_PEER_LIMIT 0, and as NAME_limit with
// ASSAY_PEER_LIMIT 1.
#pragma once

#include <type_traits>

#include "corpus/peers/feature_pairs.h"

namespace assay::peers {

// `Peer` is a detector that also has `static constexpr double part_of_time`, the part of the first
// contact time up to which a caller goes, and `static constexpr std::uint32_t limit_claims`. The
// caller stops at x_t0 + share (x_t1 - x_t0), as in "Getting started" of the IPC Toolkit.
template <class Peer>
class LimiterOf {
 public:
  explicit LimiterOf(const plugin::Mesh& mesh) : peer_(mesh) {}

  static plugin::Description describe() {
    plugin::Description d = Peer::describe();
    d.claims = Peer::limit_claims | ASSAY_CLAIM_DETERMINISTIC | ASSAY_CLAIM_TOTAL;
    d.limit_gives = ASSAY_LIMIT_START_PLUS;
    d.margin = 0;  // only reports of pairs use a margin
    return d;
  }

  template <class P = Peer, class = decltype(P::use_threads(0))>
  static void use_threads(std::uint32_t count) {
    Peer::use_threads(count);
  }

  plugin::Limit limit(plugin::Positions x_t0, plugin::Positions x_t1) {
    const plugin::Result result = peer_.evaluate(x_t0, x_t1);
    const bool is_whole = result.answer == ASSAY_FREE;
    return plugin::Limit::of_share(is_whole ? 1 : Peer::part_of_time * result.first[0]);
  }

 private:
  Peer peer_;
};

// The peer of `Tests` whose times are lower bounds of contact times, so a caller can go up to the
// time itself.
template <class Tests>
struct LowerBoundOf : PeerOf<Tests> {
  static constexpr double part_of_time = 1;
  static constexpr std::uint32_t limit_claims = ASSAY_CLAIM_PATH_FREE;
  using PeerOf<Tests>::PeerOf;
};

template <class Peer>
using AsBuilt = std::conditional_t<ASSAY_PEER_LIMIT, LimiterOf<Peer>, Peer>;

}  // namespace assay::peers
