#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "detector/mesh/enum_names.h"
#include "detector/state/step_state.h"

namespace assay::detector {
namespace {

// Turns numbers, flags, values of enums and lists into bytes and back. Writer and Reader take the
// same calls, so one description of a form serves both, and they cannot differ.

constexpr std::size_t word = 8;  // bytes of a number, little-endian

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

// Writes or reads a value of an enum that lists its values.
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

// Writes or reads the length of a list whose members take at least `least` bytes each. A reader
// refuses a length for which too few bytes are left, so that damaged bytes cannot make it allocate
// much memory.
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

constexpr std::array<std::uint8_t, 8> magic = {'a', 's', 's', 'a', 'y', 'S', 'A', 'V'};
constexpr std::size_t least_size = magic.size() + 3 * word;  // version, number of bytes, checksum

std::uint64_t checksum_of(std::span<const std::uint8_t> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const auto byte : bytes) hash = (hash ^ byte) * 0x100000001b3u;
  return hash;
}

template <class Archive, class List>
void plain_list(Archive& archive, List& list) {
  length(archive, list, sizeof(list[0]));
  for (auto& member : list) field(archive, member);
}

template <class Archive, class Positions>
void rows(Archive& archive, Positions& x) {
  auto count = static_cast<std::uint64_t>(x.rows());
  field(archive, count);
  if constexpr (Archive::reads) {
    if (count > archive.left() / (3 * word)) return archive.refuse();
    x.resize(static_cast<Eigen::Index>(count), 3);
  }
  for (Eigen::Index i = 0; i < x.size(); ++i) field(archive, x.data()[i]);
}

// Writes or reads a flag that says whether there is a value. A reader makes room for the value.
template <class T>
bool there_is(Writer& out, const T& value) {
  out.byte(value ? 1 : 0);
  return bool(value);
}
template <class T>
bool there_is(Reader& in, std::optional<T>& value) {
  bool is_there = false;
  field(in, is_there);
  if (is_there) value.emplace();
  return is_there;
}

template <class Archive, class Anchors>
void anchor_list(Archive& archive, Anchors& anchors) {
  constexpr std::size_t least = 1 + 4 * word;
  length(archive, anchors, least);
  for (auto& anchor : anchors) {
    field(archive, anchor.kind);
    for (auto& end : anchor.ends) {
      length(archive, end.vertices, word);
      for (auto& vertex : end.vertices) field(archive, vertex);
      plain_list(archive, end.weights);
    }
  }
}

void chosen_anchors(Writer& out, const PolicyState& policy) {
  if (there_is(out, policy.anchors)) anchor_list(out, *policy.anchors);
}
void chosen_anchors(Reader& in, PolicyState& policy) {
  std::optional<std::vector<ViewAnchor>> anchors;
  if (!there_is(in, anchors)) return;
  anchor_list(in, *anchors);
  policy.anchors = std::make_shared<const std::vector<ViewAnchor>>(std::move(*anchors));
}

template <class Archive, class Policy>
void policy_fields(Archive& archive, Policy& policy) {
  chosen_anchors(archive, policy);
  field(archive, policy.anchors_are_due);
  field(archive, policy.anchor_age);
  field(archive, policy.least_anchor_age);
  field(archive, policy.best_share);
  field(archive, policy.replaced_at);
  field(archive, policy.pause);
  field(archive, policy.next_pause);
  field(archive, policy.candidates);
  field(archive, policy.overhead);
  field(archive, policy.credit);
  field(archive, policy.tried);
  field(archive, policy.has_views);
}

template <class Archive, class Committed>
void committed_fields(Archive& archive, Committed& state) {
  rows(archive, state.positions);
  plain_list(archive, state.clean);
  length(archive, state.contacts, 2 * word);
  for (auto& pair : state.contacts) {
    field(archive, pair.a);
    field(archive, pair.b);
  }
  field(archive, state.contacts_are_complete);
  length(archive, state.inside, 1);
  for (auto& primitive : state.inside) {
    if (!there_is(archive, primitive)) continue;
    for (auto& end : *primitive) {
      for (auto& coordinate : end) field(archive, coordinate);
    }
  }
  policy_fields(archive, state.policy);
}

template <class Archive, class State>
void state_fields(Archive& archive, State& state) {
  field(archive, state.mesh);
  field(archive, state.culling);
  if (there_is(archive, state.committed)) committed_fields(archive, *state.committed);
  length(archive, state.apex_rules, word);
  for (auto& rule : state.apex_rules) field(archive, rule.height);
  anchor_list(archive, state.anchors);
  field(archive, state.view_work);
}

Problem damaged(const char* message) { return {InputError::damaged_state, message}; }

}  // namespace

std::size_t state_size(const StateFields& state) {
  Writer counter(nullptr);
  state_fields(counter, state);
  return least_size + counter.size();
}

void write_state(const StateFields& state, std::span<std::uint8_t> bytes) {
  Writer out(bytes.data());
  for (const auto byte : magic) out.byte(byte);
  out.number(state_version);
  out.number(bytes.size());
  state_fields(out, state);
  out.number(checksum_of(bytes.first(out.size())));
}

Expected<StateFields> read_state(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < least_size || !std::equal(magic.begin(), magic.end(), bytes.begin()))
    return damaged("these bytes are no saved state");
  Reader in(bytes.subspan(magic.size()));
  if (in.number() != state_version)
    return Problem{InputError::other_state_version,
                   "the state was saved in a form that this build does not read"};
  if (in.number() != bytes.size()) return damaged("the saved state was cut or added to");
  Reader end(bytes.last(word));
  if (end.number() != checksum_of(bytes.first(bytes.size() - word)))
    return damaged("the saved state was changed: its checksum does not hold");
  Reader fields(bytes.subspan(least_size - word, bytes.size() - least_size));
  StateFields state;
  state_fields(fields, state);
  if (!fields.is_at_end()) return damaged("the saved state does not hold the fields of one");
  return state;
}

}  // namespace assay::detector
