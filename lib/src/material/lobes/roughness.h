#pragma once

#include "material/specular_albedo.h"

#include <bdpt/types.h>

#include <algorithm>
#include <cmath>

namespace bdpt {

/// GGX alpha below which microfacets are perfectly smooth and their lobes delta lobes.
inline constexpr float smooth_alpha = 1e-3f;

// Roughness of a boundary: the alpha of its lobes, and the rows of the tables of `SpecularAlbedo`
// that bound its reflection. `reflected` returns the reflection of one row.

/// Equal roughness in all directions.
class IsotropicRoughness {
public:
    IsotropicRoughness() = default;
    /// Perceptual roughness, clamped to [0, 1].
    explicit IsotropicRoughness(float roughness) : row_(SpecularAlbedo::at_roughness(roughness))
    {
        const float clamped = std::clamp(roughness, 0.0f, 1.0f);
        alpha_ = clamped * clamped;
    }

    [[nodiscard]] float alpha() const { return alpha_; }
    [[nodiscard]] bool is_rough() const { return alpha_ >= smooth_alpha; }
    void make_smooth() { alpha_ = 0.0f; }
    /// Returns the row of the smoothest direction.
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

/// Anisotropic roughness of grooves; across them it equals the isotropic roughness
/// [KHR_materials_anisotropy]. Its reflection is that of an isotropic surface with the roughness
/// along or across the grooves, whichever reflects more.
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
        // Alpha of the rougher direction increases to 1 with the square of the strength.
        const float along = alpha_.x + (1.0f - alpha_.x) * anisotropy * anisotropy;
        along_ = SpecularAlbedo::at_roughness(std::sqrt(along));
        // Either both directions are rough or none; a smooth direction gets the minimum alpha of
        // rough lobes.
        alpha_ = along >= smooth_alpha ? Vec2{along, std::max(alpha_.y, smooth_alpha)} : Vec2{0.0f};
    }

    [[nodiscard]] Vec2 alpha() const { return alpha_; }
    [[nodiscard]] bool is_rough() const { return alpha_.x >= smooth_alpha; }
    void make_smooth() { alpha_ = Vec2(0.0f); }
    /// Returns the row of the smoothest direction.
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
