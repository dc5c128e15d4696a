// Types that name their fields once, in a function `fields(archive, x)` that calls
// archive("name", x.name, "other", x.other), as JSON objects, and back. An enum is written as its
// word (name_of), and read by its list of words.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

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

template <class Json>
class JsonWriter : public NamedFields<JsonWriter<Json>> {
 public:
  explicit JsonWriter(Json& object) : object_(object) { object_ = Json::object(); }

  template <class T>
  void field(const char* name, T& item) {
    if constexpr (requires { fields(*this, item); }) {
      JsonWriter inner(object_[name]);
      fields(inner, item);
    } else if constexpr (std::is_enum_v<T>) {
      object_[name] = name_of(item);
    } else {
      object_[name] = item;
    }
  }

 private:
  Json& object_;
};

// Throws the exceptions of nlohmann::json if a field is not there, or is of another type.
template <class Json>
class JsonReader : public NamedFields<JsonReader<Json>> {
 public:
  explicit JsonReader(const Json& object) : object_(object) {}

  template <class T>
  void field(const char* name, T& item) {
    const Json& value = object_.at(name);
    if constexpr (requires { fields(*this, item); }) {
      JsonReader inner(value);
      fields(inner, item);
    } else {
      value.get_to(item);
    }
  }

 private:
  const Json& object_;
};

template <class Json, class T>
Json json_of_fields(const T& x) {
  Json json;
  JsonWriter<Json> writer(json);
  // A writer does not change the object; `fields` takes it not const because readers use it too.
  fields(writer, const_cast<T&>(x));
  return json;
}

template <class Json, class T>
void read_fields(const Json& json, T& x) {
  JsonReader<Json> reader(json);
  fields(reader, x);
}

}  // namespace assay::properties
