#include "material/material.h"

#include "material/medium.h"
#include "math/elementary.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace bdpt {
namespace {

[[nodiscard]] Body find_body(const MaterialDesc& desc)
{
    const bool solid = desc.thickness > 0.0f && desc.transmission > 0.0f && !desc.unlit;
    return solid ? Body::solid : Body::thin_walled;
}

/// Returns the images in which the base colour is looked up. Emissive or transparent surfaces use
/// them at full size: they are sampled exactly, and the colours of invisible texels must not bleed
/// into visible ones.
[[nodiscard]] TextureImages color_images(const MaterialDesc& desc, const TextureImages& images)
{
    const bool as_it_is = desc.unlit || desc.alpha_mode != AlphaMode::opaque;
    return as_it_is ? images.at_full_size() : images;
}

}  // namespace

std::array<float, wavelengths> channel_indices(const MaterialDesc& desc)
{
    if (find_body(desc) != Body::solid) {
        return {desc.ior, desc.ior, desc.ior};
    }
    // Half of the difference of the indices of blue and red, (ior - 1) / Abbe number.
    const float spread = (desc.ior - 1.0f) * 0.025f * desc.dispersion;
    return {std::max(1.0f, desc.ior - spread), desc.ior, desc.ior + spread};
}

Exterior exterior_within(const MaterialDesc& desc, MediumId medium)
{
    Exterior exterior{.medium = medium};
    if (find_body(desc) == Body::solid) {
        exterior.indices = channel_indices(desc);
    }
    return exterior;
}

BoundaryIndices boundary_indices(const MaterialDesc& desc, const Exterior& exterior)
{
    BoundaryIndices result{.greater_by_less = channel_indices(desc)};
    if (find_body(desc) != Body::solid) {
        return result;
    }
    for (std::size_t i = 0; i < wavelengths; ++i) {
        const float inside = result.greater_by_less[i];
        const float outside = exterior.indices[i];
        result.turned[i] = inside < outside;
        result.greater_by_less[i] = inside < outside ? outside / inside : inside / outside;
    }
    return result;
}

Material::Material(const MaterialDesc& desc, const TextureImages& images,
                   const ChannelAlbedos& albedos, const LayerTables* tables,
                   const Exterior& exterior, MediumId within)
    : surface_{Rgb{desc.base_color.x, desc.base_color.y, desc.base_color.z},
               desc.metallic,
               desc.roughness,
               desc.specular,
               desc.specular_color,
               desc.transmission,
               find_body(desc)},
      emission_(desc.emission),
      // Surfaces without an inside have the same medium on both sides.
      media_{bdpt::has_inside(desc) ? within : exterior.medium, exterior.medium},
      has_inside_(is_solid_transmitter() || !medium_within(desc).is_clear() ||
                  media_.behind != media_.ahead),
      double_sided_(desc.double_sided),
      unlit_(desc.unlit),
      alpha_mode_(desc.alpha_mode),
      alpha_(desc.base_color.w),
      alpha_cutoff_(desc.alpha_cutoff),
      albedos_(albedos),
      turned_(boundary_indices(desc, exterior).turned),
      base_color_map_(
          make_texture(desc.base_color_texture, color_images(desc, images), Encoding::srgb)),
      metallic_roughness_map_(
          make_texture(desc.metallic_roughness_texture, images, Encoding::linear)),
      normal_map_(make_normal_map(desc.normal_texture, desc.normal_scale, images)),
      emission_map_(make_texture(desc.emission_texture, images.at_full_size(), Encoding::radiance)),
      specular_map_(make_texture(desc.specular_texture, images, Encoding::linear)),
      specular_color_map_(make_texture(desc.specular_color_texture, images, Encoding::srgb)),
      transmission_map_(make_texture(desc.transmission_texture, images, Encoding::linear)),
      glossiness_map_(make_texture(desc.glossiness_texture, images, Encoding::linear))
{
    const bool any_turned = turned_ != std::array<bool, wavelengths>{};
    disperses_ = albedos.disperse() || turned_[0] != turned_[1] || turned_[1] != turned_[2];
    const bool only_color_varies = !any_turned && !metallic_roughness_map_ && !specular_map_ &&
                                   !specular_color_map_ && !transmission_map_ && !glossiness_map_;
    const bool varies = !only_color_varies || base_color_map_;
    if (has_layers(desc) && !any_turned) {
        layers_ = std::make_shared<const MaterialLayers>(desc, images, albedos, *tables);
    } else if (only_color_varies && !unlit_ && !disperses()) {
        const SpecularAlbedo& albedo = albedos_.at(Wavelength::green);
        if (!varies) {
            plain_ = plain_model(surface_, albedo);
        }
        if (is_clear_sheet()) {
            const float f0 = albedo.normal_reflectance() * surface_.specular_color.x;
            const float f90 = std::clamp(surface_.specular, 0.0f, 1.0f);
            clear_sheet_.emplace(std::clamp(f0, 0.0f, 1.0f) * f90, f90, albedo);
        }
    }
    even_ = plain_ && !normal_map_ && !clear_sheet_;
    needs_footprint_ = images.mip_maps != nullptr && !unlit_ && (varies || layers_ != nullptr);
    tangent_uv_set_ = normal_map_ ? std::optional(normal_map_->uv_set())
                      : layers_   ? layers_->tangent_uv_set()
                                  : std::nullopt;
    measure_alpha();
    measure_emission();
}

bool Material::is_clear_sheet() const noexcept
{
    const Rgb specular = surface_.specular_color;
    return surface_.body == Body::thin_walled && surface_.transmission >= 1.0f &&
           surface_.metallic <= 0.0f && !IsotropicRoughness(surface_.roughness).is_rough() &&
           specular.x == specular.y && specular.y == specular.z && !unlit_ &&
           alpha_mode_ == AlphaMode::opaque && is_black(emission_) && !normal_map_ && !has_inside_;
}

void Material::measure_alpha()
{
    if (alpha_mode_ == AlphaMode::opaque) {
        return;
    }
    const auto [least, greatest] =
        base_color_map_ ? base_color_map_->alpha_range() : std::pair(1.0f, 1.0f);
    min_opacity_ = to_opacity(alpha_ * least);
    mean_opacity_ = 0.5f * (min_opacity_ + to_opacity(alpha_ * greatest));
}

void Material::measure_emission()
{
    mean_emission_ = mean_opacity_ * (unlit_ ? surface_.base_color : emission_);
    if (unlit_ && base_color_map_) {
        mean_emission_ *= Rgb(base_color_map_->mean());
    } else if (!unlit_ && emission_map_) {
        mean_emission_ *= Rgb(emission_map_->mean());
    }
}

float Material::to_opacity(float alpha) const noexcept
{
    if (alpha_mode_ == AlphaMode::mask) {
        // Tolerance for the rounding of filtered uniform textures; texels differ by much more.
        constexpr float rounding = 1e-6f;
        return alpha + rounding >= alpha_cutoff_ ? 1.0f : 0.0f;
    }
    return std::clamp(alpha, 0.0f, 1.0f);
}

float Material::opacity(const TexturePoint& point) const noexcept
{
    if (alpha_mode_ == AlphaMode::opaque) {
        return 1.0f;
    }
    const float texture = base_color_map_ ? base_color_map_->lookup(point.uv).w : 1.0f;
    return to_opacity(alpha_ * texture * std::clamp(point.color.w, 0.0f, 1.0f));
}

Rgb Material::base_color(const TexturePoint& point, const UvFootprint* footprint) const noexcept
{
    const Rgb color = surface_.base_color * Rgb(point.color);
    return base_color_map_ ? color * Rgb(base_color_map_->lookup(point.uv, footprint)) : color;
}

Bsdf Material::at(const ShadingPoint& point, const PlainModel& any, bool turned) const noexcept
{
    const Vec3 ng = turned ? -point.ng : point.ng;
    const Vec3 ns = turned ? -point.ns : point.ns;
    return std::visit(
        [&](const auto& model) -> Bsdf {
            if (!normal_map_) {
                return {ng, Frame::from_normal(ns), point.wo, model};
            }
            const Vec3 normal = normal_map_->normal(point);
            return {ng, ns, Frame::from_normal(turned ? -normal : normal), point.wo, model};
        },
        any);
}

void Material::prefetch(const std::array<Vec2, 2>& uv) const noexcept
{
    if (base_color_map_) {
        base_color_map_->prefetch(uv);
    }
    if (metallic_roughness_map_) {
        metallic_roughness_map_->prefetch(uv);
    }
    if (normal_map_) {
        normal_map_->prefetch(uv);
    }
}

Bsdf Material::bsdf(const ShadingPoint& point) const noexcept
{
    if (plain_ && point.color == Vec4(1.0f)) {
        return at(point, *plain_, false);
    }
    const Rgb base = base_color({.uv = point.uv, .color = point.color}, point.footprint);
    if (unlit_) {
        return {point.ng, Frame::from_normal(shading_normal(point)), point.wo,
                Black(glm::clamp(base, 0.0f, 1.0f))};
    }
    GltfParameters surface = surface_;
    surface.base_color = base;
    if (metallic_roughness_map_) {
        const Vec4 texel = metallic_roughness_map_->lookup(point.uv, point.footprint);
        surface.roughness *= texel.y;
        surface.metallic *= texel.z;
    }
    if (glossiness_map_) {
        surface.roughness = 1.0f - (1.0f - surface.roughness) *
                                       glossiness_map_->lookup(point.uv, point.footprint).w;
    }
    if (specular_map_) {
        surface.specular *= specular_map_->lookup(point.uv, point.footprint).w;
    }
    if (specular_color_map_) {
        surface.specular_color *= Rgb(specular_color_map_->lookup(point.uv, point.footprint));
    }
    if (transmission_map_) {
        surface.transmission *= transmission_map_->lookup(point.uv, point.footprint).x;
    }
    if (layers_) {
        return layers_->bsdf(point, Frame::from_normal(shading_normal(point)), surface);
    }
    return at(point, plain_model(surface, albedos_.at(point.wavelength)),
              turned_[static_cast<std::size_t>(point.wavelength)]);
}

Rgb Material::emission(const TexturePoint& point) const noexcept
{
    if (unlit_) {
        return glm::clamp(base_color(point, nullptr), 0.0f, 1.0f);
    }
    return emission_map_ ? emission_ * Rgb(emission_map_->lookup(point.uv)) : emission_;
}

float Material::emission_texels(const std::array<Vec2, 2>& a,
                                const std::array<Vec2, 2>& b) const noexcept
{
    const auto texels = [&](const Texture& texture) {
        const Vec2 way = texture.texel_position(b) - texture.texel_position(a);
        return std::sqrt(dot(way, way));
    };
    return std::max(emission_map_ && !unlit_ ? texels(*emission_map_) : 0.0f,
                    base_color_map_ && emission_needs_color() ? texels(*base_color_map_) : 0.0f);
}

}  // namespace bdpt
