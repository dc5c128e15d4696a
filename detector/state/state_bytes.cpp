#include "detector/state/state_bytes.h"

#include <algorithm>

#include "detector/mesh/problem.h"
#include "detector/state/byte_archive.h"

namespace assay::detector {
namespace {

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

// Whether there is a value, written or read as a flag before it. A reader makes room for it.
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
}

template <class Archive, class Committed>
void committed_fields(Archive& archive, Committed& state) {
  rows(archive, state.positions);
  plain_list(archive, state.clean);
  length(archive, state.met, 2 * word);
  for (auto& pair : state.met) {
    field(archive, pair.a);
    field(archive, pair.b);
  }
  field(archive, state.met_is_complete);
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
