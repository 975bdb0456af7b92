#pragma once

#include <bdpt/io/json_value.h>
#include <bdpt/scene_desc.h>
#include <bdpt/types.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace bdpt::io {

// Conversion of the fields of a `CameraDesc` to JSON and back: numbers, enumerators, texts,
// vectors and matrices.

template <typename T>
concept JsonScalar = std::is_arithmetic_v<T> || std::is_same_v<T, std::string>;

template <typename T>
requires JsonScalar<T> nlohmann::ordered_json value_to_json(const T& value)
{
    return value;
}

template <typename T>
requires std::is_enum_v<T> nlohmann::ordered_json value_to_json(T value)
{
    return static_cast<int>(value);
}

inline nlohmann::ordered_json value_to_json(Vec2 value)
{
    return nlohmann::ordered_json::array({value.x, value.y});
}

inline nlohmann::ordered_json value_to_json(const Mat4& matrix)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (int i = 0; i < 16; ++i) {
        json.push_back(matrix[i / 4][i % 4]);
    }
    return json;
}

template <typename T>
nlohmann::ordered_json value_to_json(const std::optional<T>& value)
{
    return value ? value_to_json(*value) : nlohmann::ordered_json();
}

template <typename T>
nlohmann::ordered_json value_to_json(const std::vector<T>& values)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const T& value : values) {
        json.push_back(value_to_json(value));
    }
    return json;
}

inline void value_from_json(const JsonValue& json, std::string& value)
{
    value = json.text();
}

template <typename T>
requires std::is_arithmetic_v<T>
void value_from_json(const JsonValue& json, T& value)
{
    value = json.number<T>();
}

inline void value_from_json(const JsonValue& json, Projection& value)
{
    value = static_cast<Projection>(json.number(0, static_cast<int>(Projection::orthographic)));
}

inline void value_from_json(const JsonValue& json, Vec2& value)
{
    value = Vec2(json.at(std::size_t{0}).number<float>(), json.at(std::size_t{1}).number<float>());
}

inline void value_from_json(const JsonValue& json, Mat4& matrix)
{
    for (int i = 0; i < 16; ++i) {
        matrix[i / 4][i % 4] = json.at(static_cast<std::size_t>(i)).number<float>();
    }
}

template <typename T>
void value_from_json(const JsonValue& json, std::optional<T>& value)
{
    if (!json.is_null()) {
        value_from_json(json, value.emplace());
    }
}

template <typename T>
void value_from_json(const JsonValue& json, std::vector<T>& values)
{
    for (const JsonValue& one : json.elements()) {
        value_from_json(one, values.emplace_back());
    }
}

}  // namespace bdpt::io
