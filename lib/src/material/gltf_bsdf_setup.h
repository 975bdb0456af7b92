#pragma once

#include "material/gltf_bsdf.h"
#include "math/elementary.h"
#include "math/rgb.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

// The part of gltf_bsdf.cpp that makes models from parameters.

namespace bdpt {

/// Rough refraction into an index this close to the outer one has no half vector.
inline constexpr float least_refraction = 1.001f;

template <typename Features>
BasicGltfBsdf<Features>::BasicGltfBsdf(const GltfParameters& parameters,
                                       const SpecularAlbedo& albedo, const Features& features)
    : base_color_(clamp(parameters.base_color, 0.0f, 1.0f)),
      f90_(std::clamp(parameters.specular, 0.0f, 1.0f)),
      metallic_(std::clamp(parameters.metallic, 0.0f, 1.0f)),
      ior_(albedo.ior()),
      roughness_(SpecularAlbedo::at_roughness(parameters.roughness)),
      solid_(parameters.body == Body::solid),
      albedo_(&albedo)
{
    const float dielectric = 1.0f - metallic_;
    const float transmission = std::clamp(parameters.transmission, 0.0f, 1.0f);
    const float base_max = max_component(base_color_);
    transmission_ = dielectric * transmission;
    f0_ = clamp(albedo.normal_reflectance() * parameters.specular_color, 0.0f, 1.0f) * f90_;
    const float roughness = std::clamp(parameters.roughness, 0.0f, 1.0f);
    alpha_ = Alpha(roughness * roughness);
    if constexpr (rich) {
        add_anisotropy(features.anisotropy);
        rich_.film = features.film;
        rich_.film_f0 = features.film.factor > 0.0f ? features.film.greatest(1.0f, f0_) : 0.0f;
    }
    if (solid_ && is_rough() && ior_ < least_refraction) {
        // Equal indices: a dielectric boundary cannot be seen, however rough; where it is mixed
        // with metal, a refraction too weak to be noticed keeps the metal's roughness.
        alpha_ = metallic_ == 0.0f ? Alpha(0.0f) : alpha_;
        ior_ = metallic_ == 0.0f ? ior_ : least_refraction;
    }
    constexpr float least_loss = 1e-6f;  // a base below a perfect mirror gets no light at all
    const float reaches_base = 1.0f - average_reflected();
    const float diffuse = dielectric * (1.0f - transmission);
    diffuse_ = base_color_ * (diffuse * inv_pi / std::max(reaches_base, least_loss));
    diffuse_weight_ = diffuse * base_max;
    add_diffuse_transmission(features, diffuse, std::max(reaches_base, least_loss));
    transmission_weight_ = transmission_ * base_max;
    // 1/21 is the cosine-weighted average of Schlick's (1 - cos)^5.
    metal_weight_ = metallic_ * (base_max + (1.0f - base_max) / 21.0f);
    has_specular_ = f90_ > 0.0f || metallic_ > 0.0f || transmission_ > 0.0f || solid_;
    if constexpr (rich) {
        has_specular_ = has_specular_ || rich_.film.factor > 0.0f;
    }
}

template <typename Features>
void BasicGltfBsdf<Features>::add_anisotropy([[maybe_unused]] float strength)
{
    if constexpr (rich) {
        rich_.roughness_x = roughness_;
        if (strength == 0.0f) {
            return;
        }
        // KHR_materials_anisotropy: the rougher direction goes to 1 with the square of the
        // strength.
        const float along = alpha_.x + (1.0f - alpha_.x) * strength * strength;
        rich_.roughness_x = SpecularAlbedo::at_roughness(std::sqrt(along));
        // Grooves are rough or not; what is smooth across them is as smooth as rough lobes can be.
        alpha_ = along >= smooth_alpha ? Vec2{along, std::max(alpha_.y, smooth_alpha)} : Vec2{0.0f};
    }
}

template <typename Features>
void BasicGltfBsdf<Features>::add_diffuse_transmission([[maybe_unused]] const Features& features,
                                                       [[maybe_unused]] float diffuse,
                                                       [[maybe_unused]] float reaches_base)
{
    if constexpr (rich) {
        const float share = solid_ ? 0.0f : std::clamp(features.diffuse_transmission, 0.0f, 1.0f);
        if (share == 0.0f) {
            return;
        }
        const Rgb color = clamp(features.transmission_color, 0.0f, 1.0f);
        rich_.diffuse_transmitted = color * (share * diffuse * inv_pi / reaches_base);
        diffuse_ *= 1.0f - share;
        const float reflected = (1.0f - share) * diffuse_weight_;
        const float transmitted = share * diffuse * max_component(color);
        diffuse_weight_ = reflected + transmitted;
        rich_.transmitted_choice = diffuse_weight_ > 0.0f ? transmitted / diffuse_weight_ : 0.0f;
    }
}

}  // namespace bdpt
