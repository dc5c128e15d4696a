// A type names its fields once, beside it:
//
//   ASSAY_FIELDS(MeshCounts, triangles, vertices, steps)
//
// names all members. One that is left out does not compile, and neither does a name that is no
// member. A type that shows less, or more, has a function `fields(archive, x)` that calls
// archive("name", x.name, "other", x.other).
//
// Archives turn that into messages (worker/messages.h) and into JSON objects, and back. Whoever
// wants JSON includes <nlohmann/json.hpp>, which the worker is built without.
#pragma once

#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/stringize.hpp>
#include <boost/preprocessor/variadic/to_seq.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "properties/words.h"

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

// Such types as JSON objects, and back. An enum is written as its word, and read by its list of
// words; what is not there is null.

// Whether fields that are 0 or empty are left out of an object, and of all objects in it, and may
// be missing when it is read.
enum class Zeros : std::uint8_t { stay, left_out };

template <class Json, Zeros zeros>
class JsonWriter : public NamedFields<JsonWriter<Json, zeros>> {
 public:
  explicit JsonWriter(Json& object) : object_(object) { object_ = Json::object(); }

  template <class T>
  void field(std::string_view name, T& item) {
    if constexpr (zeros == Zeros::left_out) {
      if (item == T{}) return;
    }
    put(object_[std::string(name)], item);
  }
  // An object that is there as a whole, or left out if it says nothing.
  template <class T>
  void may(const char* name, T& item) {
    if (item == T{}) return;
    JsonWriter<Json, Zeros::stay> whole(object_[name]);
    fields(whole, item);
  }

 private:
  template <class T>
  static void put(Json& json, T& item) {
    if constexpr (requires(JsonWriter & inner) { fields(inner, item); }) {
      JsonWriter inner(json);
      fields(inner, item);
    } else if constexpr (Listed<T>) {
      json = name_of(item);
    } else {
      json = item;
    }
  }
  template <class T>
  static void put(Json& json, std::optional<T>& item) {
    if (item) put(json, *item);
  }
  template <class T>
  static void put(Json& json, std::vector<T>& items) {
    json = Json::array();
    for (auto& item : items) put(json.emplace_back(), item);
  }
  template <class T, class Less>
  static void put(Json& json, std::map<std::string, T, Less>& items) {
    json = Json::object();
    for (auto& [key, item] : items) put(json[key], item);
  }

  Json& object_;
};

// Throws the exceptions of nlohmann::json if a field is not there, or is of another type.
template <class Json, Zeros zeros>
class JsonReader : public NamedFields<JsonReader<Json, zeros>> {
 public:
  explicit JsonReader(const Json& object) : object_(object) {}

  template <class T>
  void field(std::string_view name, T& item) {
    const std::string key(name);
    // at() throws if this is no object; contains() would take that for one without fields.
    if (zeros == Zeros::stay || !object_.is_object() || object_.contains(key))
      get(object_.at(key), item);
  }
  template <class T>
  void may(const char* name, T& item) {
    item = {};
    if (!object_.contains(name)) return;
    JsonReader<Json, Zeros::stay> whole(object_.at(name));
    fields(whole, item);
  }

 private:
  template <class T>
  static void get(const Json& json, T& item) {
    if constexpr (requires(JsonReader & inner) { fields(inner, item); }) {
      JsonReader inner(json);
      fields(inner, item);
    } else if constexpr (Listed<T>) {
      const auto& word = json.template get_ref<const std::string&>();
      const auto named = from_name<T>(word);
      if (!named)
        throw Json::other_error::create(502, "\"" + word + "\" is none of: " + all_names<T>(),
                                        &json);
      item = *named;
    } else {
      json.get_to(item);
    }
  }
  template <class T>
  static void get(const Json& json, std::optional<T>& item) {
    item.reset();
    if (!json.is_null()) get(json, item.emplace());
  }
  template <class T>
  static void get(const Json& json, std::vector<T>& items) {
    items.clear();
    for (const auto& one : json.template get_ref<const typename Json::array_t&>())
      get(one, items.emplace_back());
  }
  template <class T, class Less>
  static void get(const Json& json, std::map<std::string, T, Less>& items) {
    items.clear();
    for (const auto& [key, one] : json.template get_ref<const typename Json::object_t&>())
      get(one, items[key]);
  }

  const Json& object_;
};

template <class Json, Zeros zeros = Zeros::stay, class T>
Json json_of_fields(const T& x) {
  Json json;
  JsonWriter<Json, zeros> writer(json);
  // A writer does not change the object; `fields` takes it not const because readers use it too.
  fields(writer, const_cast<T&>(x));
  return json;
}

template <class Json, Zeros zeros = Zeros::stay, class T>
void read_fields(const Json& json, T& x) {
  JsonReader<Json, zeros> reader(json);
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
