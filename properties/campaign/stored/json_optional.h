// What may be absent is null in JSON. (nlohmann-json has this from version 3.12 on.)
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

template <class T>
struct nlohmann::adl_serializer<std::optional<T>> {
  template <class Json>
  static void to_json(Json& j, const std::optional<T>& value) {
    j = value ? Json(*value) : Json(nullptr);
  }
  template <class Json>
  static void from_json(const Json& j, std::optional<T>& value) {
    value = j.is_null() ? std::nullopt : std::optional(j.template get<T>());
  }
};
