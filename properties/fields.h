// A type names its fields once, beside it:
//
//   ASSAY_FIELDS(Canary, fault, found_after)
//
// names all members. A missing member does not compile, and neither does a name that is no member.
// A type whose fields are not exactly its members has a function `fields(archive, x)` that calls
// archive("name", x.name, "other", x.other).
//
// Archives turn fields into messages (worker/messages.h) and into JSON objects, and back. This
// header includes no JSON library, because the worker is built without one. A file that needs JSON
// includes <nlohmann/json.hpp>.
#pragma once

#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/stringize.hpp>
#include <boost/preprocessor/variadic/to_seq.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "properties/words.h"

namespace assay::properties {

// The common base of archives: passes the fields to Archive::field, one after another.
template <class Archive>
class NamedFields {
 public:
  template <class T, class... Rest>
  void operator()(const char* name, T& item, Rest&... rest) {
    static_cast<Archive&>(*this).field(name, item);
    if constexpr (sizeof...(rest) > 0) (*this)(rest...);
  }
};

// The functions below add up fields: numbers, types with +=, and maps key by key.

template <class T>
void add_to(T& sum, const T& addend) {
  sum += addend;
}
template <class Key, class T, class Less>
void add_to(std::map<Key, T, Less>& sum, const std::map<Key, T, Less>& addend) {
  for (const auto& [key, more] : addend) sum[key] += more;
}

template <class Visit>
struct EachField : NamedFields<EachField<Visit>> {
  explicit EachField(Visit with) : visit(std::move(with)) {}
  void field(std::string_view, auto& item) { visit(item); }
  void may(std::string_view, auto& item) { visit(item); }
  Visit visit;
};

template <class T>
T& add_fields(T& sum, const T& addend) {
  std::vector<const void*> addends;  // item n points to an object of the type of the sum's field n
  EachField collect([&](auto& item) { addends.push_back(&item); });
  fields(collect, const_cast<T&>(addend));  // `collect` does not change the addend
  auto next = addends.begin();
  EachField add([&]<class F>(F& item) { add_to(item, *static_cast<const F*>(*next++)); });
  fields(add, sum);
  return sum;
}

// A type with `static constexpr bool adds_up = true` is added field by field.
template <class T>
requires(T::adds_up) T& operator+=(T& sum, const T& addend) { return add_fields(sum, addend); }

// JsonFields turns a type with fields into a JSON object, and back. An enum value becomes its word,
// and an empty optional becomes null.

// Zeros::left_out: a writer leaves out fields that are 0 or empty, in an object and in all objects
// inside of it; a reader accepts an object without these fields.
enum class Zeros : std::uint8_t { stay, left_out };

// A reader throws the exceptions of nlohmann::json if a field is missing or has another type.
template <class Json, Zeros zeros, bool reads>
class JsonFields : public NamedFields<JsonFields<Json, zeros, reads>> {
  using Given = std::conditional_t<reads, const Json, Json>;

 public:
  explicit JsonFields(Given& object) : object_(object) {
    if constexpr (!reads) object_ = Json::object();
  }

  template <class T>
  void field(const std::string& name, T& item) {
    if constexpr (reads) {
      // at() throws if object_ is no JSON object; contains() would treat it as an empty object.
      if (zeros == Zeros::stay || !object_.is_object() || object_.contains(name))
        pass(object_.at(name), item);
    } else {
      if constexpr (zeros == Zeros::left_out) {
        if (item == T{}) return;
      }
      pass(object_[name], item);
    }
  }
  // Passes an object. A writer leaves out an object that equals its default, and writes all fields
  // of any other object. A reader sets a missing object to its default.
  template <class T>
  void may(const char* name, T& item) {
    if constexpr (reads) item = {};
    if (reads ? !object_.contains(name) : item == T{}) return;
    JsonFields<Json, Zeros::stay, reads> whole(reads ? object_.at(name) : object_[name]);
    fields(whole, item);
  }

 private:
  template <class T>
  static void pass(Given& json, T& item) {
    if constexpr (requires(JsonFields & inner) { fields(inner, item); }) {
      JsonFields inner(json);
      fields(inner, item);
    } else if constexpr (Listed<T> && reads) {
      const auto& word = json.template get_ref<const std::string&>();
      const auto value = from_name<T>(word);
      if (!value)
        throw Json::other_error::create(502, "\"" + word + "\" is none of: " + all_names<T>(),
                                        &json);
      item = *value;
    } else if constexpr (Listed<T>) {
      json = name_of(item);
    } else if constexpr (reads) {
      json.get_to(item);
    } else {
      json = item;
    }
  }
  template <class T>
  static void pass(Given& json, std::optional<T>& item) {
    if constexpr (reads) {
      item.reset();
      if (!json.is_null()) item.emplace();
    }
    if (item) pass(json, *item);
  }
  template <class T>
  static void pass(Given& json, std::vector<T>& items) {
    if constexpr (reads) {
      items.clear();
      for (const auto& one : json.template get_ref<const typename Json::array_t&>())
        pass(one, items.emplace_back());
    } else {
      json = Json::array();
      for (auto& item : items) pass(json.emplace_back(), item);
    }
  }
  template <class T, class Less>
  static void pass(Given& json, std::map<std::string, T, Less>& items) {
    if constexpr (reads) {
      items.clear();
      for (const auto& [key, one] : json.template get_ref<const typename Json::object_t&>())
        pass(one, items[key]);
    } else {
      json = Json::object();
      for (auto& [key, item] : items) pass(json[key], item);
    }
  }

  Given& object_;
};

template <class Json, Zeros zeros = Zeros::stay, class T>
Json json_of_fields(const T& x) {
  Json json;
  JsonFields<Json, zeros, false> writer(json);
  // A writer changes nothing. `fields` takes an object that is not const, because readers call
  // `fields` too.
  fields(writer, const_cast<T&>(x));
  return json;
}

template <class Json, Zeros zeros = Zeros::stay, class T>
void read_fields(const Json& json, T& x) {
  JsonFields<Json, zeros, true> reader(json);
  fields(reader, x);
}

}  // namespace assay::properties

#define ASSAY_FIELD_OF_X(r, data, name) archive(BOOST_PP_STRINGIZE(name), x.name);
#define ASSAY_FIELDS(Type, ...)                                                          \
  template <class Archive>                                                               \
  void fields(Archive& archive, Type& x) {                                               \
    [[maybe_unused]] const auto& [__VA_ARGS__] = x; /* compiles only with all members */ \
    BOOST_PP_SEQ_FOR_EACH(ASSAY_FIELD_OF_X, , BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__))     \
  }
