#pragma once

/// @file
/// Names the layers that a render measures beside radiance: depth, normals, ids.
///
/// @code{.cpp}
/// void render_layers(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     const bdpt::AovSet aovs = {bdpt::Aov::alpha, bdpt::Aov::depth, bdpt::Aov::normal};
///     const bdpt::RenderResult result = bdpt::render(scene, camera, {.film = {.aovs = aovs}});
///     const std::vector<bdpt::Layer> layers = result.aovs.develop(result.film);
///     bdpt::io::write_exr("layers.exr", result.image(), layers, {});
/// }
/// @endcode

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string_view>

namespace bdpt {

/// Arbitrary output variables (AOVs), measured beside radiance. Surface AOVs describe the first
/// surface that a camera ray hits, averaged over the rays of a pixel, and are independent of the
/// integrator.
enum class Aov : std::uint8_t {
    /// Linear base colour in [0, 1]; rays that leave the scene count as black.
    albedo,
    /// Unit shading normal in world space, facing the camera; rays that leave count as 0.
    normal,
    /// Distance along the camera's axis [m], averaged over rays that hit a surface; infinite if
    /// none does.
    depth,
    /// Position [m] in coordinates of the file (`SceneDesc::origin`), averaged over rays that hit a
    /// surface; 0 if none does.
    position,
    /// Number of samples of the pixel.
    sample_count,
    /// Variance of the pixel's value [nit^2], estimated from its two half images; infinite if one
    /// is empty.
    variance,
    /// Fraction of rays that hit a surface; with `shadow`, the opacity of the shadow is added.
    alpha,
    /// Opacity of the scene's black shadow on a horizontal ground (`FilmOptions::ground_height`):
    /// the fraction of rays that hit the ground and no surface, times the fraction of the ground's
    /// direct light that the scene blocks. In [0, 1]; exactly 0 where nothing blocks any light.
    shadow,
    /// Fractions of rays that hit each object, by the names of instances: Cryptomatte (`IdFilm`).
    object,
    /// Fractions of rays that hit each material, by name: Cryptomatte (`IdFilm`).
    material,
    /// `alpha` without the shadow and without the noise of partially transparent surfaces: the
    /// total opacity along each ray, not that of one hit chosen at random.
    opacity,
    /// Texture coordinates of set 0 (TEXCOORD_0; v grows downwards), averaged over rays that hit a
    /// surface; 0 where the mesh has none.
    uv,
    /// Distance from the lens along the ray [m], averaged over rays that hit a surface; infinite if
    /// none does.
    distance,
    /// `normal` in the space of the camera: x to the right, y upwards, z towards the viewer.
    camera_normal,
    /// Fractions of rays that hit each instance, also those of the same name: Cryptomatte
    /// (`IdFilm`).
    instance,
};

/// How a layer of the first surface combines the rays of a pixel.
enum class AovMean : std::uint8_t {
    none,     ///< no layer of the first surface
    of_rays,  ///< mean over all rays; those that leave the scene count as 0
    of_hits,  ///< mean over the rays that hit a surface
};

/// The names of an AOV, and how it is measured.
struct AovLayer {
    Aov aov;
    std::string_view name;      ///< in options
    std::string_view layer;     ///< in images; empty: the main layer
    std::string_view channels;  ///< one letter each; ids have layers of their own
    AovMean mean = AovMean::none;
    float without_hits = 0.0f;  ///< the value of a mean of hits without any
};

/// All AOVs, in the order of their layers. An AOV of the first surface needs its row, and its value
/// in `PrimaryHit`.
inline constexpr std::array aov_layers{
    AovLayer{Aov::albedo, "albedo", "albedo", "RGB", AovMean::of_rays},
    AovLayer{Aov::normal, "normal", "normal", "XYZ", AovMean::of_rays},
    AovLayer{Aov::camera_normal, "camera-normal", "cameraNormal", "XYZ", AovMean::of_rays},
    AovLayer{Aov::depth, "depth", "depth", "Z", AovMean::of_hits,
             std::numeric_limits<float>::infinity()},
    AovLayer{Aov::distance, "distance", "distance", "Z", AovMean::of_hits,
             std::numeric_limits<float>::infinity()},
    AovLayer{Aov::position, "position", "position", "XYZ", AovMean::of_hits},
    AovLayer{Aov::uv, "uv", "uv", "UV", AovMean::of_hits},
    AovLayer{Aov::sample_count, "samples", "sampleCount", "Y"},
    AovLayer{Aov::variance, "variance", "variance", "RGB"},
    AovLayer{Aov::alpha, "alpha", "", "A"},
    AovLayer{Aov::opacity, "opacity", "opacity", "A"},
    AovLayer{Aov::object, "object", "", ""},
    AovLayer{Aov::instance, "instance", "", ""},
    AovLayer{Aov::material, "material", "", ""},
    AovLayer{Aov::shadow, "shadow", "shadow", "A"},
};

/// A set of AOVs.
class AovSet {
public:
    constexpr AovSet() = default;
    constexpr AovSet(std::initializer_list<Aov> aovs)
    {
        for (const Aov aov : aovs) {
            insert(aov);
        }
    }
    constexpr void insert(Aov aov) { bits_ |= bit(aov); }
    [[nodiscard]] constexpr bool contains(Aov aov) const { return (bits_ & bit(aov)) != 0; }
    [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
    [[nodiscard]] constexpr bool operator==(const AovSet&) const = default;

private:
    [[nodiscard]] static constexpr std::uint32_t bit(Aov aov)
    {
        return std::uint32_t{1} << static_cast<std::uint32_t>(aov);
    }
    std::uint32_t bits_ = 0;
};

/// Tests whether `aovs` includes AOVs that are id images.
[[nodiscard]] constexpr bool asks_for_ids(AovSet aovs)
{
    return aovs.contains(Aov::object) || aovs.contains(Aov::material) ||
           aovs.contains(Aov::instance);
}

/// Tests whether a set has AOVs of the first surface beside whether there is one.
[[nodiscard]] constexpr bool asks_for_surfaces(AovSet aovs)
{
    return std::any_of(aov_layers.begin(), aov_layers.end(), [aovs](const AovLayer& layer) {
        return layer.mean != AovMean::none && aovs.contains(layer.aov);
    });
}

}  // namespace bdpt
