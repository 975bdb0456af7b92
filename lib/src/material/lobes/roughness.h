#pragma once

#include "material/specular_albedo.h"

#include <bdpt/types.h>

#include <algorithm>
#include <cmath>

namespace bdpt {

/// GGX alpha below which microfacets are perfectly smooth and their lobes delta lobes.
inline constexpr float smooth_alpha = 1e-3f;

// How rough a boundary is: the alpha of its lobes, and the rows of the tables of `SpecularAlbedo`
// that bound what it reflects. `reflected` gives that of one row.

/// As rough in all directions.
class IsotropicRoughness {
public:
    IsotropicRoughness() = default;
    /// Perceptual; clamped to [0, 1].
    explicit IsotropicRoughness(float roughness) : row_(SpecularAlbedo::at_roughness(roughness))
    {
        const float clamped = std::clamp(roughness, 0.0f, 1.0f);
        alpha_ = clamped * clamped;
    }

    [[nodiscard]] float alpha() const { return alpha_; }
    [[nodiscard]] bool is_rough() const { return alpha_ >= smooth_alpha; }
    void make_smooth() { alpha_ = 0.0f; }
    /// The row of the smoothest direction.
    [[nodiscard]] SpecularAlbedo::Roughness least() const
    {
        return is_rough() ? row_ : SpecularAlbedo::Roughness{};
    }

    template <typename Reflected>
    [[nodiscard]] float directional(const Reflected& reflected) const
    {
        return reflected(row_);
    }
    template <typename Reflected>
    [[nodiscard]] float average(const Reflected& reflected) const
    {
        return reflected(row_);
    }

private:
    float alpha_ = 0.0f;
    SpecularAlbedo::Roughness row_{};
};

/// With grooves, across which it is as smooth as without them [KHR_materials_anisotropy]: what it
/// reflects is that of an even surface which is as rough as it is along or across them, whichever
/// reflects more.
class AnisotropicRoughness {
public:
    AnisotropicRoughness() = default;
    /// Rougher along x; `anisotropy` in [0, 1].
    explicit AnisotropicRoughness(float roughness, float anisotropy = 0.0f)
        : across_(SpecularAlbedo::at_roughness(roughness)), along_(across_)
    {
        const float clamped = std::clamp(roughness, 0.0f, 1.0f);
        alpha_ = Vec2(clamped * clamped);
        if (anisotropy == 0.0f) {
            return;
        }
        // The rougher direction goes to 1 with the square of the strength.
        const float along = alpha_.x + (1.0f - alpha_.x) * anisotropy * anisotropy;
        along_ = SpecularAlbedo::at_roughness(std::sqrt(along));
        // Grooves are rough or not; what is smooth across them is as smooth as rough lobes can be.
        alpha_ = along >= smooth_alpha ? Vec2{along, std::max(alpha_.y, smooth_alpha)} : Vec2{0.0f};
    }

    [[nodiscard]] Vec2 alpha() const { return alpha_; }
    [[nodiscard]] bool is_rough() const { return alpha_.x >= smooth_alpha; }
    void make_smooth() { alpha_ = Vec2(0.0f); }
    /// The row of the smoothest direction.
    [[nodiscard]] SpecularAlbedo::Roughness least() const
    {
        return is_rough() ? across_ : SpecularAlbedo::Roughness{};
    }

    template <typename Reflected>
    [[nodiscard]] float directional(const Reflected& reflected) const
    {
        const float across = reflected(across_);
        return alpha_.x != alpha_.y ? std::max(across, reflected(along_)) : across;
    }
    template <typename Reflected>
    [[nodiscard]] float average(const Reflected& reflected) const
    {
        return std::max(reflected(across_), reflected(along_));
    }

private:
    Vec2 alpha_{0.0f};
    SpecularAlbedo::Roughness across_{};
    SpecularAlbedo::Roughness along_{};
};

}  // namespace bdpt
