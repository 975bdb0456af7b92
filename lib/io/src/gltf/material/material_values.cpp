#include "gltf/material/material_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace bdpt::io {

float MaterialValues::in_range(double value, double low, double high, std::string_view key) const
{
    if (value >= low && value <= high) {
        return static_cast<float>(value);
    }
    const double nearest = std::clamp(value, low, high);
    context_.warn("an out-of-range material value is clamped",
                  fmt::format("{}/{}: {} becomes {}", place_, key, value, nearest));
    return static_cast<float>(nearest);
}

const tinygltf::Value* MaterialValues::extension(const std::string& name) const
{
    const auto found = source_.extensions.find(name);
    return found == source_.extensions.end() ? nullptr : &found->second;
}

Rgb MaterialValues::color(const tinygltf::Value& object, const std::string& key, double high,
                          Rgb fallback) const
{
    if (!object.Has(key)) {
        return fallback;
    }
    const auto& values = object.Get(key).Get<tinygltf::Value::Array>();
    Rgb rgb;
    for (int c = 0; c < 3; ++c) {
        rgb[c] = in_range(values[static_cast<std::size_t>(c)].GetNumberAsDouble(), 0.0, high, key);
    }
    return rgb;
}

std::optional<TextureRef> MaterialValues::texture(const tinygltf::Value& object,
                                                  const std::string& name,
                                                  const std::string& key) const
{
    return textures_.resolve(texture_info(object, key),
                             fmt::format("{}/extensions/{}/{}", place_, name, key));
}

}  // namespace bdpt::io
