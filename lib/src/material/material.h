#pragma once

#include "material/bsdf.h"
#include "material/channel_albedos.h"
#include "material/material_layers.h"
#include "material/normal_map.h"
#include "math/side_media.h"
#include "texture/texture.h"

#include <bdpt/scene_desc.h>

#include <glm/common.hpp>

#include <array>
#include <memory>
#include <optional>

namespace bdpt {

/// A `MaterialDesc` prepared for lookups. Refers to the images, which must outlive it and its
/// copies.
class Material {
public:
    /// `albedos` belong to `boundary_indices(desc, exterior)`; `tables` are required if
    /// `has_layers(desc)`; `within` is the scene's id of `medium_within(desc)`. Throws nothing:
    /// `desc` has been validated.
    Material(const MaterialDesc& desc, const TextureImages& images, const ChannelAlbedos& albedos,
             const LayerTables* tables = nullptr, const Exterior& exterior = {},
             MediumId within = MediumId::clear);

    [[nodiscard]] Bsdf bsdf(const ShadingPoint& point) const noexcept;
    /// Tests whether the BSDF depends on `ShadingPoint::footprint`.
    [[nodiscard]] bool needs_footprint() const noexcept { return needs_footprint_; }
    /// Tests whether the BSDF is constant apart from vertex colours, and no clear sheet.
    [[nodiscard]] bool is_even() const noexcept { return even_; }
    /// Returns `bsdf` if it `is_even` and there are no vertex colours; arguments as in
    /// `ShadingPoint`.
    [[nodiscard]] Bsdf even_bsdf(Vec3 ng, Vec3 ns, Vec3 wo) const noexcept
    {
        if (const auto* common = std::get_if<Lambertian>(&*plain_)) [[likely]] {
            return {ng, Frame::from_normal(ns), wo, *common};
        }
        return std::visit(
            [&](const auto& model) -> Bsdf {
                return {ng, Frame::from_normal(ns), wo, model};
            },
            *plain_);
    }

    /// Returns the model of a clear sheet, which replaces `bsdf` and `opacity`; null for other
    /// materials.
    [[nodiscard]] const ClearSheet* clear_sheet() const noexcept
    {
        return clear_sheet_ ? &*clear_sheet_ : nullptr;
    }
    /// Returns the factor in [0, 1] of light that passes a clear sheet.
    [[nodiscard]] Rgb tint(const TexturePoint& point) const noexcept
    {
        return glm::clamp(base_color(point, nullptr), 0.0f, 1.0f);
    }
    /// Tests whether `tint` is 1 without vertex colours.
    [[nodiscard]] bool is_untinted() const noexcept
    {
        return !base_color_map_ && surface_.base_color == Rgb(1.0f);
    }
    /// Returns the fraction of rays that hit the surface, in [0, 1]; the others pass through.
    [[nodiscard]] float opacity(const TexturePoint& point) const noexcept;
    /// Returns a lower bound of `opacity` for vertex colours without alpha.
    [[nodiscard]] float min_opacity() const noexcept { return min_opacity_; }
    [[nodiscard]] AlphaMode alpha_mode() const noexcept { return alpha_mode_; }

    /// Returns the emitted radiance [nit] at a hit, equal in all directions of an emitting side.
    [[nodiscard]] Rgb emission(const TexturePoint& point) const noexcept;
    /// Returns `emission` times `opacity`: for points that were sampled rather than hit.
    [[nodiscard]] Rgb expected_emission(const TexturePoint& point) const noexcept
    {
        return emission(point) * opacity(point);
    }
    /// Returns the approximate average of `expected_emission` over its textures, without vertex
    /// colours; zero only if it is zero everywhere.
    [[nodiscard]] Rgb mean_emission() const noexcept { return mean_emission_; }
    /// Tests whether `expected_emission` depends on the vertex colours.
    [[nodiscard]] bool emission_needs_color() const noexcept
    {
        return unlit_ || alpha_mode_ != AlphaMode::opaque;
    }
    /// Tests whether `expected_emission` depends on a texture.
    [[nodiscard]] bool emission_needs_texture() const noexcept
    {
        return (emission_map_ && !unlit_) || (base_color_map_ && emission_needs_color());
    }
    /// Returns the distance of two points in texels of the finest texture that the emission depends
    /// on; 0 without any.
    [[nodiscard]] float emission_texels(const std::array<Vec2, 2>& a,
                                        const std::array<Vec2, 2>& b) const noexcept;
    [[nodiscard]] bool emits_from_both_sides() const noexcept { return double_sided_; }

    /// Tests whether wavelengths are refracted differently.
    [[nodiscard]] bool disperses() const noexcept { return disperses_; }
    /// Tests whether it bounds a solid transparent body; its inside is on the back of ng.
    [[nodiscard]] bool is_solid_transmitter() const noexcept
    {
        return surface_.body == Body::solid;
    }
    /// Tests whether it has an inside that light enters, refracted or not, and whose medium differs
    /// from the surroundings.
    [[nodiscard]] bool has_inside() const noexcept { return has_inside_; }
    /// Returns the media on both sides of its surfaces.
    [[nodiscard]] SideMedia media() const noexcept { return media_; }
    /// Returns the set of texture coordinates that the tangent follows, if the material needs one.
    [[nodiscard]] std::optional<int> tangent_uv_set() const noexcept { return tangent_uv_set_; }

    /// Starts to load the texels of `bsdf` at these coordinates: waiting for one after the other
    /// took 7 % of the time of renders of textured models.
    void prefetch(const std::array<Vec2, 2>& uv) const noexcept;

private:
    [[nodiscard]] Vec3 shading_normal(const ShadingPoint& point) const noexcept
    {
        return normal_map_ ? normal_map_->normal(point) : point.ns;
    }
    /// Returns the BSDF of one channel; `turned` if seen from the other side.
    [[nodiscard]] Bsdf at(const ShadingPoint& point, const PlainModel& any,
                          bool turned) const noexcept;
    [[nodiscard]] Rgb base_color(const TexturePoint& point,
                                 const UvFootprint* footprint) const noexcept;
    [[nodiscard]] float to_opacity(float alpha) const noexcept;
    /// Tests whether a surface without layers, of which only the base colour may vary, is smooth
    /// thin glass whose reflection has no colour.
    [[nodiscard]] bool is_clear_sheet() const noexcept;
    void measure_alpha();
    void measure_emission();

    GltfParameters surface_;           ///< factors, which textures multiply
    std::optional<PlainModel> plain_;  ///< model of a surface without variation
    std::optional<ClearSheet> clear_sheet_;
    Rgb emission_{0.0f};
    Rgb mean_emission_{0.0f};
    SideMedia media_;
    bool has_inside_;
    bool disperses_ = false;
    bool double_sided_;
    bool unlit_;
    bool needs_footprint_ = false;
    bool even_ = false;
    AlphaMode alpha_mode_;
    float alpha_;  ///< factor of alpha
    float alpha_cutoff_;
    float min_opacity_ = 1.0f;
    float mean_opacity_ = 1.0f;  ///< approximate
    ChannelAlbedos albedos_;
    std::array<bool, wavelengths> turned_;

    std::optional<Texture> base_color_map_;
    std::optional<Texture> metallic_roughness_map_;
    std::optional<NormalMap> normal_map_;
    std::optional<Texture> emission_map_;
    std::optional<Texture> specular_map_;
    std::optional<Texture> specular_color_map_;
    std::optional<Texture> transmission_map_;
    std::optional<Texture> glossiness_map_;
    std::shared_ptr<const MaterialLayers> layers_;  ///< set for materials with layers
    std::optional<int> tangent_uv_set_;
};

}  // namespace bdpt
