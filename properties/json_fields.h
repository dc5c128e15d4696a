// Types that name their fields (fields.h) as JSON objects, and back. An enum is written as its
// word, and read by its list of words.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "properties/fields.h"
#include "properties/words.h"

namespace assay::properties {

template <class Json>
class JsonWriter : public NamedFields<JsonWriter<Json>> {
 public:
  explicit JsonWriter(Json& object) : object_(object) { object_ = Json::object(); }

  template <class T>
  void field(const char* name, T& item) {
    if constexpr (requires { fields(*this, item); }) {
      JsonWriter inner(object_[name]);
      fields(inner, item);
    } else if constexpr (Listed<T>) {
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
    } else if constexpr (Listed<T>) {
      const auto& word = value.template get_ref<const std::string&>();
      const auto named = from_name<T>(word);
      if (!named)
        throw Json::other_error::create(502, "\"" + word + "\" is none of: " + all_names<T>(),
                                        &value);
      item = *named;
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
