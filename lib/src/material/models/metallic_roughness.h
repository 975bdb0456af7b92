#pragma once

#include "material/lobes/boundary.h"
#include "material/lobes/diffuse.h"
#include "material/lobes/fresnel.h"
#include "material/lobes/interreflection.h"
#include "material/lobes/returned_light.h"
#include "material/lobes/rough_diffuse.h"
#include "material/lobes/roughness.h"
#include "material/models/scattering_model.h"
#include "math/elementary.h"
#include "math/rgb.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstdint>

namespace bdpt {

/// The kind of body of a transmitting surface.
enum class Body : std::uint8_t {
    thin_walled,  ///< a sheet: light passes straight through
    solid,        ///< the boundary of a closed body: light is refracted
};

/// The parameters of the glTF material model at one surface point; see `MaterialDesc`.
struct GltfParameters {
    Rgb base_color{1.0f};
    float metallic = 0.0f;
    float roughness = 1.0f;  ///< perceptual
    float specular = 1.0f;
    Rgb specular_color{1.0f};
    float transmission = 0.0f;
    Body body = Body::thin_walled;

    /// Tests whether there is a visible boundary above the base.
    [[nodiscard]] bool has_boundary() const
    {
        return specular > 0.0f || metallic > 0.0f || transmission > 0.0f || body == Body::solid;
    }
    [[nodiscard]] bool is_lambertian() const { return !has_boundary(); }
};

// Interface of the base below the boundary.
// - `set_up`: `diffuse` is the fraction of light for which there is a base, `reaches_base` the
//   average transmission of the boundary. Returns the largest component of the albedo.
// - `set_boundary`: what the boundary transmits at normal incidence, over its average; called if
//   `needs_boundary`.
// - `add_to`: adds the lobes; `coupling` is the fraction of light that the boundary transmits, in
//   and out, and `choice_fwd` and `choice_rev` are the probabilities of the base from wo and wi.

/// A Lambertian base.
class DiffuseBase {
public:
    [[nodiscard]] float set_up(Rgb base_color, float diffuse, float reaches_base,
                               const GltfParameters&)
    {
        per_color_ = diffuse * inv_pi / reaches_base;
        return diffuse * max_component(base_color);
    }
    void add_to(BsdfEval& sum, Rgb base_color, float coupling, float choice_fwd, float choice_rev,
                Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
    {
        const DiffuseReflection lobe(base_color * per_color_, coupling);
        add(sum, chosen(lobe.eval(wo, wi, mode), choice_fwd, choice_rev));
    }
    [[nodiscard]] float reflected_share() const noexcept { return 1.0f; }
    [[nodiscard]] bool needs_boundary() const noexcept { return false; }
    void set_boundary(float) noexcept {}
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_base, Vec2 u,
                                                   TransportMode mode) const noexcept
    {
        return DiffuseReflection(Rgb(0.0f)).sample(wo, u_base, u, mode);
    }

private:
    float per_color_ = 0.0f;  ///< f over base colour [1/sr]
};

/// A base, Lambertian or rough, that transmits a fraction to the other side if the body is thin;
/// that part is Lambertian.
class TranslucentBase {
public:
    TranslucentBase() = default;
    /// `share` and `color` are clamped to [0, 1].
    TranslucentBase(float share, Rgb color, const RoughDiffuse& surface)
        : transmitted_(color), transmitted_choice_(share), surface_(surface)
    {}

    [[nodiscard]] float set_up(Rgb base_color, float diffuse, float reaches_base,
                               const GltfParameters& parameters)
    {
        const float all = diffuse * max_component(base_color);
        per_color_ = diffuse / reaches_base;
        const float share =
            parameters.body == Body::solid ? 0.0f : std::clamp(transmitted_choice_, 0.0f, 1.0f);
        transmitted_choice_ = 0.0f;
        if (share == 0.0f) {
            return all;
        }
        const Rgb color = glm::clamp(transmitted_, 0.0f, 1.0f);
        transmitted_ = color * (share * diffuse * inv_pi / reaches_base);
        per_color_ *= 1.0f - share;
        reflected_share_ = 1.0f - share;
        const float transmitted = share * diffuse * max_component(color);
        const float weight = (1.0f - share) * all + transmitted;
        transmitted_choice_ = weight > 0.0f ? transmitted / weight : 0.0f;
        return weight;
    }
    void add_to(BsdfEval& sum, Rgb base_color, float coupling, float choice_fwd, float choice_rev,
                Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
    {
        const float reflected_choice = 1.0f - transmitted_choice_;
        const BsdfEval reflected =
            surface_.is_rough()
                ? RoughDiffuseReflection(base_color, surface_, per_color_ * coupling)
                      .eval(wo, wi, mode)
                : DiffuseReflection(base_color * (per_color_ * inv_pi), coupling)
                      .eval(wo, wi, mode);
        add(sum, chosen(reflected, reflected_choice * choice_fwd, reflected_choice * choice_rev));
        if (transmitted_choice_ > 0.0f) {
            add(sum, chosen(DiffuseTransmission(transmitted_, coupling).eval(wo, wi, mode),
                            transmitted_choice_ * choice_fwd, transmitted_choice_ * choice_rev));
        }
    }
    /// Returns the fraction of the light scattered by a white base that stays on the side it came
    /// from.
    [[nodiscard]] float reflected_share() const noexcept { return reflected_share_; }
    [[nodiscard]] bool needs_boundary() const noexcept { return surface_.is_rough(); }
    void set_boundary(float normal_over_mean) noexcept { surface_.set_boundary(normal_over_mean); }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_base, Vec2 u,
                                                   TransportMode mode) const noexcept
    {
        if (u_base < transmitted_choice_) {
            return DiffuseTransmission(transmitted_).sample(wo, u_base, u, mode);
        }
        if (surface_.is_rough()) {
            const float u_lobe = (u_base - transmitted_choice_) / (1.0f - transmitted_choice_);
            return RoughDiffuseReflection(Rgb(0.0f), surface_).sample(wo, u_lobe, u, mode);
        }
        return DiffuseReflection(Rgb(0.0f)).sample(wo, u_base, u, mode);
    }

private:
    float per_color_ = 0.0f;           ///< pi f over base colour, if Lambertian
    Rgb transmitted_{0.0f};            ///< f on the other side [1/sr]
    float transmitted_choice_ = 0.0f;  ///< probability of the other side
    float reflected_share_ = 1.0f;
    RoughDiffuse surface_;
};

/// The scattering model of glTF 2.0 metallic-roughness with KHR_materials_{ior, specular,
/// transmission, volume}: the lobes of a boundary above a base.
///
/// The boundary is that of a dielectric, or metal, or a mix; it reflects and transmits at the same
/// microfacets. The base receives the light transmitted by the boundary in both directions, so that
/// it is reciprocal and conserves energy [Kelemen and Szirmay-Kalos 2001, "A Microfacet Based
/// Coupled Specular-Matte BRDF Model"]. Light that the microfacets of a metal, or of a dielectric
/// that reflects as much, mask is reflected among them and eventually leaves [Kulla and Conty 2017,
/// "Revisiting Physically Based Shading at Imageworks"]: a white metal reflects all light, however
/// rough, and clear glass scatters all. All but solid transmitters scatter equally from both sides.
/// From inside a solid transmitter there is no base: the pigment lies below the boundary for light
/// from outside only, and a base seen from within would add to the light that is already reflected
/// in full.
template <typename Film, typename Roughness, typename Base>
class BasicMetallicRoughness {
public:
    /// Clamps the parameters to [0, 1]. `albedo` has the refractive index; it must outlive this.
    BasicMetallicRoughness(const GltfParameters& parameters, const SpecularAlbedo& albedo,
                           const Roughness& roughness, const Film& film, const Base& base);
    BasicMetallicRoughness(const GltfParameters& parameters, const SpecularAlbedo& albedo)
        : BasicMetallicRoughness(parameters, albedo, Roughness(parameters.roughness), Film(),
                                 Base())
    {}

    /// Values that depend on one direction alone.
    struct Side {
        float boundary_choice = 0.0f;         ///< probability of the lobes of the boundary
        float base_transmitted = 0.0f;        ///< fraction of light that reaches the base, 1 - E
        float interreflection_choice = 0.0f;  ///< probability of the lobe of interreflection
        float refraction_choice = 0.0f;       ///< probability of the lobe of repeated refraction
        /// Fraction of light that white microfacets do not reflect at once, if they interreflect.
        float unreflected = 0.0f;
    };
    /// Returns the values of a direction with this z.
    [[nodiscard]] Side side(float z) const noexcept;
    [[nodiscard]] Side side(Vec3 w) const noexcept { return side(w.z); }

    /// Returns the properties that a layer above needs.
    [[nodiscard]] CoveredBase covered() const noexcept;
    /// Returns the fraction of light from a direction with this z that white microfacets do not
    /// reflect at once; 0 if they do not interreflect.
    [[nodiscard]] float metal_unreflected(float z) const noexcept
    {
        return interreflects() ? unreflected(z) : 0.0f;
    }

    /// Evaluates the model; `from` belongs to wo, `to` to wi.
    [[nodiscard]] BsdfEval eval(const Side& from, const Side& to, Vec3 wo, Vec3 wi,
                                TransportMode mode) const noexcept;
    [[nodiscard]] BsdfEval eval(const Side& from, Vec3 wo, Vec3 wi,
                                TransportMode mode) const noexcept
    {
        return eval(from, side(wi.z), wo, wi, mode);
    }
    /// Samples a direction: the complete sample of a delta lobe, else only the direction matters.
    [[nodiscard]] std::optional<BsdfSample> direct(const Side& from, Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(const Side& from, Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
    {
        return eval(side(wo.z), wo, wi, mode);
    }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
    {
        return sample(side(wo.z), wo, u_lobe, u, mode);
    }

    [[nodiscard]] bool has_smooth_lobe() const noexcept
    {
        return base_weight_ > 0.0f || (boundary_.exists && roughness_.is_rough());
    }
    [[nodiscard]] bool transmits() const noexcept { return boundary_.transmits(); }
    [[nodiscard]] Rgb base_color() const noexcept { return boundary_.base_color; }

private:
    /// Tests whether its microfacets reflect light more than once.
    [[nodiscard]] bool interreflects() const noexcept
    {
        return boundary_.interreflects || (boundary_.metallic > 0.0f && roughness_.is_rough());
    }
    [[nodiscard]] float opaque_share() const noexcept
    {
        return 1.0f - boundary_.metallic - boundary_.transmission;
    }
    /// Returns the fraction of light that an opaque dielectric reflects later, of that which white
    /// microfacets do not reflect at once. It reaches no base. Only where it interreflects.
    [[nodiscard]] Rgb reflected_later() const noexcept;
    [[nodiscard]] Interreflection make_interreflection() const noexcept;
    /// Tests whether light is transmitted after scattering by several microfacets.
    [[nodiscard]] bool refracts_repeatedly() const noexcept
    {
        return boundary_.transmits() && roughness_.is_rough();
    }
    [[nodiscard]] RepeatedRefraction repeated_refraction() const noexcept;
    /// Returns the average transmission of the boundary to the base.
    [[nodiscard]] float reaches_base() const noexcept;
    // Fractions of light from a direction with this z.
    /// Returns the fraction that white microfacets do not reflect at once.
    [[nodiscard]] float unreflected(float z) const noexcept;
    [[nodiscard]] float average_unreflected() const noexcept;
    /// Returns the fraction that transparent microfacets do not scatter out at once.
    [[nodiscard]] float lost(float z) const noexcept;

    Boundary<Film> boundary_;
    Roughness roughness_;
    Base base_;
    Interreflection interreflection_;  ///< none unless `interreflects`
    // Largest components of albedos, for choosing among the lobes.
    float base_weight_ = 0.0f;
    float transmission_weight_ = 0.0f;
    float metal_weight_ = 0.0f;
};

/// The plain model, which lives in path vertices.
using MetallicRoughness = BasicMetallicRoughness<NoFilm, IsotropicRoughness, DiffuseBase>;
/// The base of layered models.
using LayerBase = BasicMetallicRoughness<ThinFilm, AnisotropicRoughness, TranslucentBase>;

extern template class BasicMetallicRoughness<NoFilm, IsotropicRoughness, DiffuseBase>;
extern template class BasicMetallicRoughness<ThinFilm, AnisotropicRoughness, TranslucentBase>;

static_assert(ScatteringModel<MetallicRoughness> && ScatteringModel<LayerBase>);

}  // namespace bdpt
