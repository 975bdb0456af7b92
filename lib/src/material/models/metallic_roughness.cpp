#include "material/models/metallic_roughness.h"

#include "material/lobes/boundary_lobes.h"
#include "material/specular_albedo.h"

#include <glm/common.hpp>

#include <cmath>

namespace bdpt {

/// Minimum relative index of rough refraction: closer to 1 it has no half vector.
constexpr float min_refraction = 1.001f;

/// Reflectance at normal incidence from which a dielectric interreflects; it does so in full from
/// twice as much. For indices up to 1.57, as of plastics, nearly all light that its microfacets do
/// not reflect at once reaches the base.
constexpr float min_f0 = 0.05f;

/// Returns the fraction of light that white microfacets do not reflect at once.
inline float passed_by_white(SpecularAlbedo::Split split)
{
    return 1.0f - split.f0 - split.f90;
}

template <typename Film, typename Roughness, typename Base>
BasicMetallicRoughness<Film, Roughness, Base>::BasicMetallicRoughness(
    const GltfParameters& parameters, const SpecularAlbedo& albedo, const Roughness& roughness,
    const Film& film, const Base& base)
    : roughness_(roughness), base_(base)
{
    const float metallic = std::clamp(parameters.metallic, 0.0f, 1.0f);
    const float dielectric = 1.0f - metallic;
    const float transmission = std::clamp(parameters.transmission, 0.0f, 1.0f);
    const float f90 = std::clamp(parameters.specular, 0.0f, 1.0f);
    boundary_ = {
        .base_color = clamp(parameters.base_color, 0.0f, 1.0f),
        .f0 = clamp(albedo.normal_reflectance() * parameters.specular_color, 0.0f, 1.0f) * f90,
        .f90 = f90,
        .metallic = metallic,
        .transmission = dielectric * transmission,
        .ior = albedo.ior(),
        .is_solid = parameters.body == Body::solid,
        .exists = parameters.has_boundary() || film.exists(),
        .albedo = PackedPointer(&albedo),
        .film = film};
    boundary_.film.bind(boundary_.f0);
    if (boundary_.is_solid && roughness_.is_rough() && boundary_.ior < min_refraction) {
        // Equal indices: a dielectric boundary is invisible, however rough; if it is mixed with
        // metal, an imperceptible refraction keeps the metal's roughness.
        if (metallic == 0.0f) {
            roughness_.make_smooth();
        } else {
            boundary_.ior = min_refraction;
        }
    }
    const float diffuse = dielectric * (1.0f - transmission);
    boundary_.interreflects =
        max_component(boundary_.f0) > min_f0 && diffuse > 0.0f && roughness_.is_rough();
    if (interreflects()) {
        interreflection_ = make_interreflection();
    }
    base_weight_ = base_.set_up(boundary_.base_color, diffuse,
                                diffuse > 0.0f ? reaches_base() : 1.0f, parameters);
    const float base_max = max_component(boundary_.base_color);
    transmission_weight_ = boundary_.transmission * base_max;
    metal_weight_ = metallic * (base_max + (1.0f - base_max) * mean_schlick_weight);
    if (base_.needs_boundary() && base_weight_ > 0.0f && boundary_.exists) {
        base_.set_boundary(side(1.0f).base_transmitted / reaches_base());
    }
}

template <typename Film, typename Roughness, typename Base>
float BasicMetallicRoughness<Film, Roughness, Base>::reaches_base() const noexcept
{
    constexpr float min_loss = 1e-6f;  // a base below a perfect mirror receives no light
    float average = roughness_.average([&](SpecularAlbedo::Roughness row) {
        return boundary_.reflected(boundary_.albedo->average(row));
    });
    if (boundary_.interreflects) [[unlikely]] {
        average += max_component(reflected_later()) *
                   roughness_.average([&](SpecularAlbedo::Roughness row) {
                       return passed_by_white(boundary_.albedo->average(row));
                   });
    }
    return std::max(1.0f - average, min_loss);
}

template <typename Film, typename Roughness, typename Base>
CoveredBase BasicMetallicRoughness<Film, Roughness, Base>::covered() const noexcept
{
    const float metallic = boundary_.metallic;
    const float passes = boundary_.exists ? reaches_base() : 1.0f;
    const float diffuse = base_weight_ > 0.0f ? opaque_share() * base_.reflected_share() : 0.0f;
    const Rgb metal = boundary_.base_color + (1.0f - boundary_.base_color) * mean_schlick_weight;
    const float later = boundary_.interreflects ? max_component(reflected_later()) : 0.0f;
    return {.metallic = metallic,
            .f0 = max_component(boundary_.f0),
            .f90 = boundary_.f90,
            .diffuse = diffuse / passes,
            .unreflected = interreflects() ? average_unreflected() : 0.0f,
            .later = later,
            .opaque_later = opaque_share() * later,
            .roughness = roughness_.least(),
            .fresnel_rise = boundary_.albedo->average({}).f90,
            .color = metallic * metal + (1.0f - metallic) * (1.0f - passes) +
                     diffuse * passes * boundary_.base_color};
}

template <typename Film, typename Roughness, typename Base>
auto BasicMetallicRoughness<Film, Roughness, Base>::side(float z) const noexcept -> Side
{
    const bool inside = boundary_.is_inside(z);
    const bool repeats = refracts_repeatedly();
    if (!repeats && !interreflects() && (inside || base_weight_ == 0.0f)) {
        return {.boundary_choice = boundary_.exists ? 1.0f : 0.0f};
    }
    if (!boundary_.exists) {
        return {.base_transmitted = 1.0f};
    }
    const float lost_share = repeats ? lost(z) : 0.0f;
    const float again = boundary_.transmission * lost_share;
    const float missing = interreflects() ? unreflected(z) : 0.0f;
    const float interreflected = interreflection_.weight() * missing;
    if (inside) {
        return {.boundary_choice = 1.0f - again - interreflected,
                .interreflection_choice = interreflected,
                .refraction_choice = again,
                .unreflected = missing};
    }
    const float cosine = std::abs(z);
    const float bare = roughness_.directional([&](SpecularAlbedo::Roughness row) {
        return boundary_.reflected(boundary_.albedo->directional(cosine, row));
    });
    const float reflected = boundary_.film.max_albedo_over(bare, cosine, boundary_.f0);
    float later = 0.0f;
    if (boundary_.interreflects) [[unlikely]] {
        later = max_component(reflected_later()) *
                roughness_.directional([&](SpecularAlbedo::Roughness row) {
                    return passed_by_white(boundary_.albedo->directional(cosine, row));
                });
    }
    const float passed = std::max(0.0f, 1.0f - reflected);
    const float rest = std::max(0.0f, passed - later);
    const float specular = (1.0f - boundary_.metallic) * reflected +
                           transmission_weight_ * std::max(0.0f, passed - lost_share) +
                           metal_weight_ * (1.0f - missing);
    const float diffuse = base_weight_ * rest;
    const float sum = specular + diffuse + interreflected + again;
    return {.boundary_choice = sum > 0.0f ? specular / sum : 0.0f,
            .base_transmitted = base_weight_ > 0.0f ? rest : 0.0f,
            .interreflection_choice = sum > 0.0f ? interreflected / sum : 0.0f,
            .refraction_choice = sum > 0.0f ? again / sum : 0.0f,
            .unreflected = missing};
}

template <typename Film, typename Roughness, typename Base>
float BasicMetallicRoughness<Film, Roughness, Base>::unreflected(float z) const noexcept
{
    return 1.0f - roughness_.directional([z](SpecularAlbedo::Roughness row) {
        return WhiteAlbedo::directional(std::abs(z), row.value());
    });
}

template <typename Film, typename Roughness, typename Base>
float BasicMetallicRoughness<Film, Roughness, Base>::average_unreflected() const noexcept
{
    return 1.0f - roughness_.average([](SpecularAlbedo::Roughness row) {
        return WhiteAlbedo::average(row.value());
    });
}

template <typename Film, typename Roughness, typename Base>
float BasicMetallicRoughness<Film, Roughness, Base>::lost(float z) const noexcept
{
    const float cosine = std::abs(z);
    const float f0 = max_component(boundary_.f0);
    const auto side =
        boundary_.is_inside(z) ? RefractionLoss::Side::inner : RefractionLoss::Side::outer;
    const float scattered = roughness_.directional([&](SpecularAlbedo::Roughness row) {
        if (boundary_.is_solid) {
            return 1.0f - boundary_.albedo->refraction_loss().directional(side, cosine, row.value(),
                                                                          f0, boundary_.f90);
        }
        // Transmission through a thin wall has the geometry of reflection.
        return WhiteAlbedo::directional(cosine, row.value());
    });
    return std::max(0.0f, 1.0f - scattered);
}

template <typename Film, typename Roughness, typename Base>
RepeatedRefraction BasicMetallicRoughness<Film, Roughness, Base>::repeated_refraction()
    const noexcept
{
    const auto loss = [this](RefractionLoss::Side side) {
        return 1.0f - roughness_.average([&](SpecularAlbedo::Roughness row) {
            if (boundary_.is_solid) {
                return 1.0f - boundary_.albedo->refraction_loss().average(
                                  side, row.value(), max_component(boundary_.f0), boundary_.f90);
            }
            return WhiteAlbedo::average(row.value());
        });
    };
    return {{.index = boundary_.index_at(1.0f), .loss = loss(RefractionLoss::Side::outer)},
            {.index = boundary_.index_at(-1.0f), .loss = loss(RefractionLoss::Side::inner)},
            boundary_.transmission,
            boundary_.base_color};
}

template <typename Film, typename Roughness, typename Base>
Interreflection BasicMetallicRoughness<Film, Roughness, Base>::make_interreflection() const noexcept
{
    Interreflection sum(boundary_.base_color, 1.0f - average_unreflected(), boundary_.metallic);
    if (boundary_.interreflects) {
        sum.add(opaque_share() * reflected_later());
    }
    return sum;
}

template <typename Film, typename Roughness, typename Base>
Rgb BasicMetallicRoughness<Film, Roughness, Base>::reflected_later() const noexcept
{
    const SpecularAlbedo::Split smooth = boundary_.albedo->average({});
    const float share = std::min(max_component(boundary_.f0) / min_f0 - 1.0f, 1.0f);
    return interreflected(share, boundary_.f0 * smooth.f0 + boundary_.f90 * smooth.f90,
                          1.0f - average_unreflected());
}

/// Returns the probability of the base.
template <typename Side>
float base_choice(const Side& side)
{
    return 1.0f - side.boundary_choice - side.interreflection_choice - side.refraction_choice;
}

template <typename Film, typename Roughness, typename Base>
BsdfEval BasicMetallicRoughness<Film, Roughness, Base>::eval(const Side& from, const Side& to,
                                                             Vec3 wo, Vec3 wi,
                                                             TransportMode mode) const noexcept
{
    BsdfEval sum;
    if (grazes(wo) || grazes(wi)) {
        return sum;
    }
    if (boundary_.exists && roughness_.is_rough()) {
        sum = chosen(GgxBoundary(boundary_, roughness_.alpha()).eval(wo, wi, mode),
                     from.boundary_choice, to.boundary_choice);
    }
    if (interreflects()) {
        add(sum, chosen(interreflection_.lobe(from.unreflected, to.unreflected).eval(wo, wi, mode),
                        from.interreflection_choice, to.interreflection_choice));
    }
    if (refracts_repeatedly()) {
        add(sum, chosen(repeated_refraction().eval(wo, wi, lost(wo.z), lost(wi.z), mode),
                        from.refraction_choice, to.refraction_choice));
    }
    if (base_weight_ > 0.0f) {
        base_.add_to(sum, boundary_.base_color, from.base_transmitted * to.base_transmitted,
                     base_choice(from), base_choice(to), wo, wi, mode);
    }
    return sum;
}

template <typename Film, typename Roughness, typename Base>
std::optional<BsdfSample> BasicMetallicRoughness<Film, Roughness, Base>::direct(
    const Side& from, Vec3 wo, float u_lobe, Vec2 u, TransportMode mode) const noexcept
{
    if (grazes(wo)) {
        return std::nullopt;
    }
    const float choice = from.boundary_choice;
    const float u_again = u_lobe - choice - from.interreflection_choice;
    std::optional<BsdfSample> sampled;
    if (u_lobe >= choice && u_again < 0.0f) {
        sampled = DiffuseReflection(Rgb(0.0f)).sample(wo, 0.0f, u, mode);
    } else if (u_lobe >= choice && u_again < from.refraction_choice) {
        sampled = repeated_refraction().sample(u_again / from.refraction_choice, u);
    } else if (u_lobe >= choice) {
        if (base_weight_ == 0.0f) {
            return std::nullopt;  // black: `eval` has no density of it
        }
        sampled = base_.sample(wo, (u_again - from.refraction_choice) / base_choice(from), u, mode);
    } else if (roughness_.is_rough()) {
        sampled = GgxBoundary(boundary_, roughness_.alpha()).sample(wo, u_lobe / choice, u, mode);
    } else {
        const auto choice_at = [this](float z) { return side(z).boundary_choice; };
        return SmoothBoundary(boundary_, choice, choice_at).sample(wo, u_lobe / choice, u, mode);
    }
    return sampled;
}

template <typename Film, typename Roughness, typename Base>
std::optional<BsdfSample> BasicMetallicRoughness<Film, Roughness, Base>::sample(
    const Side& from, Vec3 wo, float u_lobe, Vec2 u, TransportMode mode) const noexcept
{
    std::optional<BsdfSample> sampled = direct(from, wo, u_lobe, u, mode);
    if (!sampled || sampled->delta) {
        return sampled;
    }
    if (grazes(sampled->wi)) {
        return std::nullopt;
    }
    return smooth_sample(sampled->wi, eval(from, wo, sampled->wi, mode));
}

template class BasicMetallicRoughness<NoFilm, IsotropicRoughness, DiffuseBase>;
template class BasicMetallicRoughness<ThinFilm, AnisotropicRoughness, TranslucentBase>;

}  // namespace bdpt
