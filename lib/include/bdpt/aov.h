#pragma once

#include <cstdint>
#include <initializer_list>

namespace bdpt {

/// Arbitrary output variables (AOVs), which are measured beside radiance. Those of surfaces belong
/// to the first surface that a camera ray meets, averaged over the rays of the image, and do not
/// depend on the integrator.
enum class Aov : std::uint8_t {
    /// Linear base colour in [0, 1]; rays that leave the scene count as black.
    albedo,
    /// Unit shading normal in world space, on the side of the camera; rays that leave count as 0.
    normal,
    /// Distance along the camera's axis [m], of rays that meet a surface; infinite without any.
    depth,
    /// In world space [m], of rays that meet a surface; 0 without any.
    position,
    /// Samples of the pixel.
    sample_count,
    /// The variance of the pixel's value [nit^2], estimated from its two half images; infinite when
    /// one is empty.
    variance,
    /// Share of rays that meet a surface; with `shadow` the opacity of that is added.
    alpha,
    /// Opacity of the scene's black shadow on a level ground (`FilmOptions::ground_height`), which
    /// rays meet that meet no surface: their share, times the share of the ground's direct light
    /// that the scene takes away. In [0, 1]; 0, to the bit, where nothing is in the way of any
    /// light.
    shadow,
    /// Shares of rays that meet each object, by the names of instances: Cryptomatte (`IdFilm`).
    object,
    /// The same by the names of materials.
    material,
    /// `alpha` without the shadow and without the noise of surfaces that let a share of the light
    /// through: along each ray it is what all of them take away, not one met by chance.
    opacity,
};

/// A set of them.
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

/// Does it have AOVs that are images of ids?
[[nodiscard]] constexpr bool asks_for_ids(AovSet aovs)
{
    return aovs.contains(Aov::object) || aovs.contains(Aov::material);
}

}  // namespace bdpt
