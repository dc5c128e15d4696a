// A type names its fields once, beside it:
//
//   ASSAY_FIELDS(MeshCounts, triangles, vertices, steps)
//
// names all members in the order of their declaration. One that is left out does not compile. A
// type that shows less, or more, has a function `fields(archive, x)` that calls
// archive("name", x.name, "other", x.other).
//
// Archives turn that into messages (worker/wire.h) and into JSON objects, and back (json_fields.h).
#pragma once

#include <algorithm>
#include <string_view>

namespace assay::properties {

// What archives have in common: they take the fields one by one.
template <class Archive>
class NamedFields {
 public:
  template <class T, class... Rest>
  void operator()(const char* name, T& item, Rest&... rest) {
    static_cast<Archive&>(*this).field(name, item);
    if constexpr (sizeof...(rest) > 0) (*this)(rest...);
  }

  // The names stand in one text, parted by ", ".
  template <class... T>
  void list(std::string_view names, T&... items) {
    const auto next = [&] {
      const auto name = names.substr(0, names.find(','));
      names = names.substr(std::min(names.size(), name.size() + 2));
      return name;
    };
    (static_cast<Archive&>(*this).field(next(), items), ...);
  }
};

}  // namespace assay::properties

#define ASSAY_FIELDS(Type, ...)              \
  template <class Archive>                   \
  void fields(Archive& archive, Type& x) {   \
    auto& [__VA_ARGS__] = x;                 \
    archive.list(#__VA_ARGS__, __VA_ARGS__); \
  }
