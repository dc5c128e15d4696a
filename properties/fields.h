// A type names its fields once, in a function `fields(archive, x)` beside it that calls
// archive("name", x.name, "other", x.other). Archives turn that into messages (worker/wire.h) and
// into JSON objects, and back (json_fields.h).
#pragma once

namespace assay::properties {

// What archives have in common: they take the fields pair by pair.
template <class Archive>
class NamedFields {
 public:
  template <class T, class... Rest>
  void operator()(const char* name, T& item, Rest&... rest) {
    static_cast<Archive&>(*this).field(name, item);
    if constexpr (sizeof...(rest) > 0) (*this)(rest...);
  }
};

}  // namespace assay::properties
