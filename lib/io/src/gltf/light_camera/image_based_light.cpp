#include "gltf/light_camera/light_camera.h"

#include "file/load_context.h"
#include "file/read_file.h"
#include "gltf/animation/node_transforms.h"
#include "image/cube_map.h"
#include "image/encoded_image.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::io {

namespace {

/// A failure that only loses the environment, unlike `Error`.
struct UnreadableCube : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Electro-optical transfer function of IEC 61966-2-1, without the C library.
constexpr std::array<float, 256> srgb_table = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double code = static_cast<double>(i) / 255.0;
        const double base = (code + 0.055) / 1.055;
        double root = 1.0;  // fifth root of base^2, by Newton's method
        for (int step = 0; step < 40; ++step) {
            const double power = root * root * root * root;
            root -= (root * power - base * base) / (5.0 * power);
        }
        table[i] = static_cast<float>(code <= 0.04045 ? code / 12.92 : base * base * root);
    }
    return table;
}();

std::size_t texel_count(const TexelImage& texels)
{
    return static_cast<std::size_t>(texels.width) * static_cast<std::size_t>(texels.height);
}

/// Returns the upper eight bits of an integer, the precision of RGBD.
std::uint8_t read_code(const TexelImage& texels, std::size_t texel, int channel)
{
    const auto value =
        texel * static_cast<std::size_t>(texels.channels) + static_cast<std::size_t>(channel);
    if (texels.type == TexelType::unorm8) {
        return texels.bytes[value];
    }
    std::uint16_t wide = 0;
    std::memcpy(&wide, texels.bytes.data() + 2 * value, sizeof wide);
    return static_cast<std::uint8_t>(wide >> 8U);
}

/// Decodes radiance from RGBD: sRGB colours divided by alpha. An image without alpha has 255.
Image decode_rgbd(const TexelImage& texels, const std::string& place, LoadContext& context)
{
    Image image{texels.width, texels.height, {}};
    if (texels.type != TexelType::unorm8 && texels.type != TexelType::unorm16) {
        throw UnreadableCube(place + ": its pixels are not integers, as RGBD needs");
    }
    image.pixels.reserve(texel_count(texels));
    const bool is_grey = texels.channels < 3;
    const bool has_alpha = texels.channels % 2 == 0;
    bool is_divided_by_zero = false;
    for (std::size_t i = 0; i < texel_count(texels); ++i) {
        const auto read_color = [&](int channel) {
            return srgb_table[read_code(texels, i, is_grey ? 0 : channel)];
        };
        const float divisor =
            has_alpha ? static_cast<float>(read_code(texels, i, texels.channels - 1)) / 255.0f
                      : 1.0f;
        is_divided_by_zero = is_divided_by_zero || divisor == 0.0f;
        const Rgb color(read_color(0), read_color(1), read_color(2));
        image.pixels.push_back(divisor > 0.0f ? color / divisor : Rgb(0.0f));
    }
    if (is_divided_by_zero) {
        context.warn("texels of an environment whose alpha is 0 are black", place);
    }
    return image;
}

DecodedImage read_face(const tinygltf::Model& model, std::size_t image, const LoadContext& context)
{
    const tinygltf::Image& source = model.images[image];
    try {
        return decode_texels(
            read_source(model, source.uri, source.bufferView, context.limits.file_bytes, context),
            context.limits);
    } catch (const Error& error) {
        if (error.code() == ErrorCode::not_found) {
            throw UnreadableCube(error.what());
        }
        throw;
    }
}

/// Returns the images of the sides of the largest cube; empty if there is no cube.
std::vector<std::size_t> first_level(const tinygltf::Value& light)
{
    std::vector<std::size_t> images;
    const tinygltf::Value& levels = light.Get("specularImages");
    if (levels.ArrayLen() > 0) {
        for (const tinygltf::Value& image : levels.Get(0).Get<tinygltf::Value::Array>()) {
            images.push_back(static_cast<std::size_t>(image.GetNumberAsInt()));
        }
    }
    return images;
}

/// Reads a cube. `images`: indices of the six sides.
CubeMap read_cube(const tinygltf::Model& model, const std::vector<std::size_t>& images,
                  const std::string& place, LoadContext& context)
{
    CubeMap cube;
    std::uint64_t bytes = 0;
    for (std::size_t side = 0; side < cube.faces.size(); ++side) {
        const std::string face_place = fmt::format("{}/{}", place, side);
        const auto same = std::find(
            images.begin(), images.begin() + static_cast<std::ptrdiff_t>(side), images[side]);
        if (const auto earlier = static_cast<std::size_t>(same - images.begin()); earlier < side) {
            cube.faces[side] = cube.faces[earlier];
            continue;
        }
        try {
            const DecodedImage decoded = read_face(model, images[side], context);
            if (!decoded.damage.empty()) {
                context.warn(WarningKind::loss,
                             "an image of the environment is damaged; its decoded part is used",
                             face_place + ": " + decoded.damage);
            }
            Image& face = cube.faces[side];
            const std::uint64_t taken = texel_count(decoded.image) * sizeof(Rgb);
            context.budget.memory().check(face_place, taken);
            bytes += taken;
            if (bytes > context.limits.texture_bytes) {
                throw Error(
                    ErrorCode::invalid_input,
                    fmt::format(
                        "all sides together need more than {}",
                        human_bytes(static_cast<long double>(context.limits.texture_bytes))));
            }
            face = decode_rgbd(decoded.image, face_place, context);
            if (face.width != face.height || face.width != cube.faces[0].width) {
                context.warn(
                    "the sides of an environment should be square and of one size",
                    fmt::format("{}: {} x {} pixels", face_place, face.width, face.height));
            }
        } catch (const Error& error) {
            throw Error(error.code(), face_place + ": " + error.what());
        } catch (const std::runtime_error& error) {
            throw UnreadableCube(face_place + ": " + error.what());
        }
    }
    return cube;
}

int longest_side(const CubeMap& cube)
{
    int longest = 0;
    for (const Image& face : cube.faces) {
        longest = std::max({longest, face.width, face.height});
    }
    return longest;
}

/// Flattens the cube. Four texels along a full circle per texel of a side keep its detail, if the
/// limits allow it.
Image flatten(CubeMap cube, const std::string& place, LoadContext& context)
{
    constexpr int least = 32;  // so that even sides of one texel have edges
    constexpr double most =
        2048;  // more would take seconds and gigabytes, which a small file could request
    const double affordable =
        std::sqrt(static_cast<double>(context.limits.image_bytes / sizeof(Rgb)) / 2.0);
    const int highest = std::max(
        1, static_cast<int>(std::min({most, affordable, context.limits.image_side / 2.0})));
    const int wanted = std::max(2 * longest_side(cube), least);
    if (wanted > highest) {
        context.warn(WarningKind::loss,
                     "an environment loses detail, because its equirectangular image would be too "
                     "large",
                     fmt::format("{}: {} x {} pixels", place, 2 * wanted, wanted));
    }
    while (longest_side(cube) > 1 && 2 * longest_side(cube) > highest) {
        cube = halved(cube);
    }
    const int height = std::min(std::max(2 * longest_side(cube), least), highest);
    const auto rows = static_cast<std::uint64_t>(height);
    context.budget.memory().spend(place, 2 * rows * rows * environment_pixel);
    return to_equirectangular(cube, height);
}

float read_intensity(const tinygltf::Value& light, const std::string& place, LoadContext& context)
{
    // The divisor alpha is 255 at most.
    constexpr double most = std::numeric_limits<float>::max() / 256.0;
    const double intensity =
        light.Has("intensity") ? light.Get("intensity").GetNumberAsDouble() : 1.0;
    if (!(intensity >= 0.0 && intensity <= most)) {
        context.warn("an out-of-range intensity of an environment is clamped",
                     fmt::format("{}/intensity: {}", place, intensity));
    }
    return static_cast<float>(std::clamp(intensity, 0.0, most));
}

}  // namespace

std::optional<EnvironmentLightDesc> read_image_based_light(const tinygltf::Model& model,
                                                           std::size_t scene, LoadContext& context)
{
    const auto& extensions = model.scenes[scene].extensions;
    const auto found = extensions.find("EXT_lights_image_based");
    if (found == extensions.end()) {
        return std::nullopt;
    }
    const auto index = static_cast<std::size_t>(found->second.Get("light").GetNumberAsInt());
    const tinygltf::Value& light = find_light(model, "EXT_lights_image_based", index);
    const std::string place = fmt::format("/extensions/EXT_lights_image_based/lights/{}", index);
    const std::vector<std::size_t> sides = first_level(light);
    if (sides.size() != 6) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{}/specularImages: a cube of {} sides, but it must have 6", place,
                                sides.size()));
    }
    Image radiance;
    try {
        CubeMap cube = read_cube(model, sides, place + "/specularImages/0", context);
        radiance = flatten(std::move(cube), place, context);
    } catch (const UnreadableCube& error) {
        context.warn(WarningKind::loss,
                     "an image of the environment cannot be read; the environment is left out",
                     error.what());
        return std::nullopt;
    }
    const float intensity = read_intensity(light, place, context);
    for (Rgb& pixel : radiance.pixels) {
        pixel *= intensity;
    }
    EnvironmentLightDesc desc{.radiance = std::move(radiance)};
    if (light.Has("rotation")) {
        std::vector<double> xyzw;
        for (const tinygltf::Value& number : light.Get("rotation").Get<tinygltf::Value::Array>()) {
            xyzw.push_back(number.GetNumberAsDouble());
        }
        desc.world_from_environment = Mat3(glm::dmat3(rotation(xyzw, place, context)));
    }
    return desc;
}

}  // namespace bdpt::io
