// Turns numbers, flags, values of enums and lists into bytes and back. Writer and Reader
// take the same calls, so one description of a form serves both, and what is written is what is
// read.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "detector/mesh/enum_names.h"

namespace assay::detector {

inline constexpr std::size_t word = 8;  // bytes of a number, little-endian

// Writes numbers one behind the other. With a null pointer it only counts their bytes.
class Writer {
 public:
  static constexpr bool reads = false;
  explicit Writer(std::uint8_t* out) : out_(out) {}
  std::size_t size() const { return size_; }

  void byte(std::uint8_t value) {
    if (out_) out_[size_] = value;
    ++size_;
  }
  void number(std::uint64_t value) {
    for (std::size_t i = 0; i < word; ++i) byte(static_cast<std::uint8_t>(value >> (8 * i)));
  }

 private:
  std::uint8_t* out_;
  std::size_t size_ = 0;
};

// Reads them back. Beyond the end of the bytes it gives 0, and is_good() is false from then on.
class Reader {
 public:
  static constexpr bool reads = true;
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  bool is_good() const { return is_good_; }
  bool is_at_end() const { return is_good_ && bytes_.empty(); }
  std::size_t left() const { return bytes_.size(); }
  void refuse() { is_good_ = false; }

  std::uint8_t byte() {
    if (bytes_.empty()) is_good_ = false;
    if (!is_good_) return 0;
    const std::uint8_t value = bytes_[0];
    bytes_ = bytes_.subspan(1);
    return value;
  }
  std::uint64_t number() {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < word; ++i) value |= std::uint64_t{byte()} << (8 * i);
    return value;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  bool is_good_ = true;
};

inline void field(Writer& out, std::uint64_t value) { out.number(value); }
inline void field(Reader& in, std::uint64_t& value) { value = in.number(); }
inline void field(Writer& out, std::int32_t value) {
  out.number(static_cast<std::uint32_t>(value));
}
inline void field(Reader& in, std::int32_t& value) {
  const std::uint64_t read = in.number();
  if (read > std::uint32_t(-1)) in.refuse();
  value = static_cast<std::int32_t>(static_cast<std::uint32_t>(read));
}
inline void field(Writer& out, double value) { out.number(std::bit_cast<std::uint64_t>(value)); }
inline void field(Reader& in, double& value) { value = std::bit_cast<double>(in.number()); }
inline void field(Writer& out, std::uint8_t value) { out.byte(value); }
inline void field(Reader& in, std::uint8_t& value) { value = in.byte(); }
inline void field(Writer& out, bool value) { out.byte(value); }
inline void field(Reader& in, bool& value) {
  const auto read = in.byte();
  if (read > 1) in.refuse();
  value = read != 0;
}

// A value of an enum that lists its values.
template <Listed Enum>
void field(Writer& out, Enum value) {
  out.byte(static_cast<std::uint8_t>(value));
}
template <Listed Enum>
void field(Reader& in, Enum& value) {
  const auto read = from_number<Enum>(in.byte());
  if (!read) in.refuse();
  value = read.value_or(first_value<Enum>);
}

// The length of a list whose members take at least `least` bytes each. A reader refuses a length
// for which too few bytes are left, so that damaged bytes cannot make it allocate much memory.
template <class List>
void length(Writer& out, const List& list, std::size_t) {
  out.number(list.size());
}
template <class List>
void length(Reader& in, List& list, std::size_t least) {
  const auto count = in.number();
  if (count > in.left() / least) return in.refuse();
  list.resize(static_cast<std::size_t>(count));
}

}  // namespace assay::detector
