#pragma once

#include "file/load_context.h"
#include "gltf/material/texture.h"

#include <bdpt/types.h>

#include <tiny_gltf.h>

#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace bdpt::io {

/// The greatest value of a property without an upper bound.
inline constexpr double no_limit = std::numeric_limits<float>::max();

/// The values of one material and its extensions, clamped to their ranges with a warning.
class MaterialValues {
public:
    /// `place` is the JSON pointer of the material. All arguments must outlive this object.
    MaterialValues(const tinygltf::Material& source, const std::string& place,
                   TextureResolver& textures, LoadContext& context)
        : source_(source), place_(place), textures_(textures), context_(context)
    {}

    /// Clamps a value to its range; `key` is its place within the material, for the warning.
    [[nodiscard]] float in_range(double value, double low, double high, std::string_view key) const;
    /// Returns an extension; null if the material does not have it.
    [[nodiscard]] const tinygltf::Value* extension(const std::string& name) const;
    /// Returns colour `key` of an extension, in [0, high]; `fallback` if it is missing.
    [[nodiscard]] Rgb color(const tinygltf::Value& object, const std::string& key, double high,
                            Rgb fallback = Rgb(1.0f)) const;
    /// Returns texture `key` of the extension `name`.
    [[nodiscard]] std::optional<TextureRef> texture(const tinygltf::Value& object,
                                                    const std::string& name,
                                                    const std::string& key) const;

private:
    const tinygltf::Material& source_;
    const std::string& place_;
    TextureResolver& textures_;
    LoadContext& context_;
};

}  // namespace bdpt::io
