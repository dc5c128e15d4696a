// A CBOR map (RFC 8949) of what a record of a step log holds: numbers, texts, arrays of numbers
// (RFC 8746), and maps of these. It copies no array until it is asked for one.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace assay::corpus {

class CborMap {
 public:
  // An array of numbers as it stands in the text, which is not copied.
  struct Numbers {
    std::string_view bytes;
    std::uint64_t tag = 0;  // of RFC 8746
    std::size_t width() const;
    std::size_t size() const { return bytes.size() / width(); }
  };

  // Nothing if the text is no map of such values, goes on after it, or names a key twice. Maps are
  // nested two deep at most. The text must outlive the map.
  static std::optional<CborMap> parse(std::string_view text);

  bool has(std::string_view key) const { return values_.find(key) != values_.end(); }
  // Nothing if there is no such key, or its value is of another kind. An integer is a number too.
  std::optional<std::int64_t> integer(std::string_view key) const;
  std::optional<double> number(std::string_view key) const;
  std::optional<std::string> text(std::string_view key) const;
  const CborMap* map(std::string_view key) const;
  // An array of float32 or float64, or of int32.
  std::optional<std::vector<double>> doubles(std::string_view key) const;
  std::optional<std::vector<std::int32_t>> integers(std::string_view key) const;

 private:
  friend class CborReader;
  using Value = std::variant<std::int64_t, double, std::string_view, Numbers, CborMap>;
  template <class T>
  const T* find(std::string_view key) const;

  std::map<std::string, Value, std::less<>> values_;
};

}  // namespace assay::corpus
