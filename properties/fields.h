// A type names its fields once, beside it:
//
//   ASSAY_FIELDS(MeshCounts, triangles, vertices, steps)
//
// names all members. One that is left out does not compile, and neither does a name that is no
// member. A type that shows less, or more, has a function `fields(archive, x)` that calls
// archive("name", x.name, "other", x.other).
//
// Archives turn that into messages (worker/wire.h) and into JSON objects, and back (json_fields.h).
#pragma once

#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/stringize.hpp>
#include <boost/preprocessor/variadic/to_seq.hpp>

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
};

}  // namespace assay::properties

#define ASSAY_FIELD_OF_X(r, data, name) archive(BOOST_PP_STRINGIZE(name), x.name);
#define ASSAY_FIELDS(Type, ...)                                                          \
  template <class Archive>                                                               \
  void fields(Archive& archive, Type& x) {                                               \
    [[maybe_unused]] const auto& [__VA_ARGS__] = x; /* compiles only with all members */ \
    BOOST_PP_SEQ_FOR_EACH(ASSAY_FIELD_OF_X, , BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__))     \
  }
