// The free choices of a hard case: integers that depend on its family, strength and variant alone.
// They are the same on every platform as long as no two draws are arguments or operands of one
// expression, because these have no order (items of a braced list have one).
#pragma once

#include <cstdint>
#include <string_view>

namespace assay::corpus {

// SplitMix64, seeded by FNV-1a of the family's name.
class Variation {
 public:
  Variation(std::string_view family, int strength, int variant) {
    for (const char c : family) {
      state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    }
    // States of neighbouring strengths and variants are far apart.
    constexpr std::uint64_t strength_stride = 0xd1342543de82ef95u,
                            variant_stride = 0x2545f4914f6cdd1d;
    state_ ^= static_cast<std::uint64_t>(strength + 1) * strength_stride;
    state_ ^= static_cast<std::uint64_t>(variant + 1) * variant_stride;
    next();
  }
  // A number in lo .. hi; the bias of the remainder does no harm here.
  std::int64_t between(std::int64_t lo, std::int64_t hi) {
    const auto n = static_cast<std::uint64_t>(hi - lo) + 1;
    return lo + static_cast<std::int64_t>(next() % n);
  }
  std::int64_t sign() { return next() & 1 ? 1 : -1; }

 private:
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace assay::corpus
