#include "corpus/formats/cbor_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

namespace assay::corpus {
namespace {

// Tags of RFC 8746 for the arrays that a log has.
constexpr std::uint64_t int32_big = 74, int32_little = 78, float32_big = 81, float64_big = 82,
                        float32_little = 85, float64_little = 86;
constexpr std::uint64_t known_tags[] = {int32_big,   int32_little,   float32_big,
                                        float64_big, float32_little, float64_little};

bool is_big(std::uint64_t tag) {
  return tag < int32_little || tag == float32_big || tag == float64_big;
}

// The number whose bytes stand here.
template <class Number>
Number number_at(const char* bytes, bool big) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), bytes, raw.size());
  if (big != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

template <class Number, class Out>
void append(const CborMap::Numbers& from, std::vector<Out>& to) {
  const bool big = is_big(from.tag);
  for (std::size_t i = 0; i < from.bytes.size(); i += sizeof(Number))
    to.push_back(number_at<Number>(from.bytes.data() + i, big));
}

}  // namespace

// Reads values from the front of a text. Nothing is read beyond its end, and no size that it states
// is believed.
class CborReader {
 public:
  explicit CborReader(std::string_view text) : rest_(text) {}
  bool at_end() const { return rest_.empty(); }

  std::optional<CborMap> map(int depth) {
    const auto head = this->head();
    if (!head || head->major != major_map) return std::nullopt;
    return entries(head->argument, depth);
  }

 private:
  // The first three bits of an item.
  enum : std::uint8_t {
    major_unsigned = 0,
    major_negative,
    major_bytes,
    major_text,
    major_array,
    major_map,
    major_tag,
    major_simple
  };
  static constexpr std::uint8_t argument_is_float64 = 27, argument_is_float32 = 26;
  struct Head {
    std::uint8_t major, info;
    std::uint64_t argument;
  };

  std::optional<std::string_view> take(std::uint64_t count) {
    if (count > rest_.size()) return std::nullopt;
    const auto taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::optional<Head> head() {
    const auto first = take(1);
    if (!first) return std::nullopt;
    const auto byte = static_cast<std::uint8_t>(first->front());
    constexpr std::uint8_t info_bits = 31, longest_info = 27, one_byte = 24;
    Head head{static_cast<std::uint8_t>(byte >> 5), static_cast<std::uint8_t>(byte & info_bits), 0};
    if (head.info < one_byte) {
      head.argument = head.info;
      return head;
    }
    if (head.info > longest_info) return std::nullopt;  // of no definite length
    const auto more = take(std::uint64_t{1} << (head.info - one_byte));
    if (!more) return std::nullopt;
    for (const char c : *more) head.argument = head.argument << 8 | static_cast<std::uint8_t>(c);
    return head;
  }

  std::optional<CborMap> entries(std::uint64_t count, int depth) {
    if (depth == 0) return std::nullopt;
    CborMap out;
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto key = head();
      if (!key || key->major != major_text) return std::nullopt;
      const auto name = take(key->argument);
      if (!name) return std::nullopt;
      auto value = this->value(depth);
      if (!value || !out.values_.emplace(*name, std::move(*value)).second) return std::nullopt;
    }
    return out;
  }

  std::optional<CborMap::Value> value(int depth) {
    const auto head = this->head();
    if (!head) return std::nullopt;
    constexpr auto largest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    switch (head->major) {
      case major_unsigned:
        if (head->argument > largest) return std::nullopt;
        return static_cast<std::int64_t>(head->argument);
      case major_negative:
        if (head->argument > largest) return std::nullopt;
        return -1 - static_cast<std::int64_t>(head->argument);
      case major_text:
        if (const auto text = take(head->argument)) return *text;
        return std::nullopt;
      case major_map:
        if (auto map = entries(head->argument, depth - 1)) return std::move(*map);
        return std::nullopt;
      case major_tag:
        return numbers(head->argument);
      case major_simple:
        if (head->info == argument_is_float64) return std::bit_cast<double>(head->argument);
        if (head->info == argument_is_float32)
          return std::bit_cast<float>(static_cast<std::uint32_t>(head->argument));
        return std::nullopt;
      default:
        return std::nullopt;
    }
  }

  std::optional<CborMap::Value> numbers(std::uint64_t tag) {
    if (std::ranges::find(known_tags, tag) == std::end(known_tags)) return std::nullopt;
    const auto head = this->head();
    if (!head || head->major != major_bytes) return std::nullopt;
    const auto bytes = take(head->argument);
    if (!bytes) return std::nullopt;
    const CborMap::Numbers numbers{*bytes, tag};
    if (bytes->size() % numbers.width() != 0) return std::nullopt;
    return numbers;
  }

  std::string_view rest_;
};

std::size_t CborMap::Numbers::width() const {
  return tag == float64_big || tag == float64_little ? sizeof(double) : sizeof(float);
}

std::optional<CborMap> CborMap::parse(std::string_view text) {
  constexpr int deepest = 2;
  CborReader reader(text);
  auto map = reader.map(deepest);
  if (!map || !reader.at_end()) return std::nullopt;
  return map;
}

template <class T>
const T* CborMap::find(std::string_view key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? nullptr : std::get_if<T>(&found->second);
}

std::optional<std::int64_t> CborMap::integer(std::string_view key) const {
  if (const auto* x = find<std::int64_t>(key)) return *x;
  return std::nullopt;
}

std::optional<double> CborMap::number(std::string_view key) const {
  if (const auto* x = find<double>(key)) return *x;
  if (const auto* x = find<std::int64_t>(key)) return static_cast<double>(*x);
  return std::nullopt;
}

std::optional<std::string> CborMap::text(std::string_view key) const {
  if (const auto* x = find<std::string_view>(key)) return std::string(*x);
  return std::nullopt;
}

const CborMap* CborMap::map(std::string_view key) const { return find<CborMap>(key); }

std::optional<std::vector<double>> CborMap::doubles(std::string_view key) const {
  const auto* x = find<Numbers>(key);
  if (!x || x->tag == int32_big || x->tag == int32_little) return std::nullopt;
  std::vector<double> out;
  out.reserve(x->size());
  if (x->width() == sizeof(double)) {
    append<double>(*x, out);
  } else {
    append<float>(*x, out);
  }
  return out;
}

std::optional<std::vector<std::int32_t>> CborMap::integers(std::string_view key) const {
  const auto* x = find<Numbers>(key);
  if (!x || (x->tag != int32_big && x->tag != int32_little)) return std::nullopt;
  std::vector<std::int32_t> out;
  out.reserve(x->size());
  append<std::int32_t>(*x, out);
  return out;
}

}  // namespace assay::corpus
