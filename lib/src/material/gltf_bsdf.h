#pragma once

#include "material/bsdf_model.h"
#include "material/ggx.h"
#include "material/specular_albedo.h"
#include "material/thin_film.h"

#include <optional>
#include <type_traits>

namespace bdpt {

/// What a surface that transmits light is part of.
enum class Body {
    thin_walled,  ///< a sheet: light passes without changing its course
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
};

/// What `GltfBsdf` has beyond the parameters: nothing.
struct PlainFeatures {
    using Alpha = float;
};

/// What the base of a `LayeredBsdf` may have.
struct RichFeatures {
    using Alpha = Vec2;  ///< along x and y

    float anisotropy = 0.0f;  ///< [0, 1]; x is rougher [KHR_materials_anisotropy]
    ThinFilm film{};
    float diffuse_transmission = 0.0f;  ///< [0, 1], share of the base; thin-walled bodies only
    Rgb transmission_color{1.0f};       ///< [0, 1], of that share
};

/// The scattering model of glTF 2.0 metallic-roughness with KHR_materials_{ior, specular,
/// transmission, volume}. Directions are local unit vectors that point away from the surface; +z is
/// the shading normal, outside a solid body.
///
/// Three kinds of lobes: reflection (a rough dielectric boundary, or metal, or a mix), transmission
/// through the same microfacets, and a Lambertian base that gets what the boundary lets through in
/// both directions, so that it is reciprocal and no energy is lost or made [Kelemen and
/// Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model"]. All but solid
/// transmitters scatter alike from both sides. From inside a solid transmitter there is no
/// Lambertian part: the pigment lies below the boundary for light from outside only, and a base
/// seen from within would add to the light that is already reflected in full.
template <typename Features>
class BasicGltfBsdf {
public:
    /// GGX alpha below which the microfacet lobes are perfectly smooth, that is delta lobes.
    static constexpr float smooth_alpha = 1e-3f;

    /// Black.
    BasicGltfBsdf() = default;
    /// Black under that base colour: what is seen of it is not scattered light.
    explicit BasicGltfBsdf(Rgb base_color) : base_color_(base_color) {}
    /// Parameters are clamped to [0, 1]. `albedo` has the refractive index; it must outlive this.
    BasicGltfBsdf(const GltfParameters& parameters, const SpecularAlbedo& albedo,
                  const Features& features = {});

    /// What follows from one direction alone.
    struct Side {
        float specular_choice = 0.0f;   ///< probability of the microfacet lobes
        float base_transmitted = 0.0f;  ///< share of light that reaches the base, 1 - E
    };
    /// `z` is that of the direction.
    [[nodiscard]] Side side(float z) const noexcept;

    /// `from` is the side of wo.
    [[nodiscard]] BsdfEval eval(const Side& from, Vec3 wo, Vec3 wi,
                                TransportMode mode) const noexcept;
    /// `u_lobe` and `u` are uniform in [0, 1).
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

    /// Scatters into a lobe that is not delta.
    [[nodiscard]] bool has_smooth_lobe() const noexcept
    {
        return diffuse_weight_ > 0.0f || (has_specular_ && is_rough());
    }
    /// Light passes from one side to the other.
    [[nodiscard]] bool transmits() const noexcept { return transmission_ > 0.0f; }
    [[nodiscard]] Rgb base_color() const noexcept { return base_color_; }

private:
    using Alpha = typename Features::Alpha;
    static constexpr bool rich = std::is_same_v<Features, RichFeatures>;

    /// What becomes of light at one microfacet.
    struct Shares {
        Rgb reflected;
        Rgb transmitted;
        float reflect_choice;  ///< probability of reflection; equal from both sides
    };

    [[nodiscard]] bool inside(float z) const noexcept { return solid_ && z < 0.0f; }
    [[nodiscard]] float index_at(float z) const noexcept { return inside(z) ? ior_ : 1.0f; }
    [[nodiscard]] bool is_rough() const noexcept;
    /// The share of light that the boundary of the dielectric reflects, in the brightest channel.
    [[nodiscard]] float boundary_reflected(SpecularAlbedo::Split split) const noexcept;
    [[nodiscard]] float directional_reflected(float cosine) const noexcept;
    [[nodiscard]] float average_reflected() const noexcept;
    // Nothing where there are no such features.
    void add_anisotropy(float strength);
    void add_diffuse_transmission(const Features& features, float diffuse, float reaches_base);
    [[nodiscard]] Rgb under_film(Rgb bare, Rgb f0, float cosine) const noexcept;
    void add_transmitted(BsdfEval& sum, const Side& from, const Side& to, float cos_o,
                         float cos_i) const noexcept;
    [[nodiscard]] Shares shares(float cos_outer) const noexcept;
    [[nodiscard]] float cos_outer_of(float cos_microfacet, float z) const noexcept;
    [[nodiscard]] BsdfEval eval_lobes(const Side& from, Vec3 wo, Vec3 wi,
                                      TransportMode mode) const noexcept;
    [[nodiscard]] BsdfEval eval_microfacets(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<Vec3> sample_microfacets(Vec3 wo, float u_share,
                                                         Vec2 u) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample_smooth(Vec3 wo, float u_share,
                                                          float specular_choice,
                                                          TransportMode mode) const noexcept;

    Rgb base_color_{0.0f};
    Rgb diffuse_{0.0f};  ///< the base's f before the boundary's part [1/sr]
    Rgb f0_{0.0f};
    float f90_ = 0.0f;
    float metallic_ = 0.0f;
    float transmission_ = 0.0f;  ///< of the dielectric part
    float ior_ = 1.0f;           ///< of the inside of a solid body
    Alpha alpha_{0.0f};
    SpecularAlbedo::Roughness roughness_;
    // The largest components of the lobes' albedos, for choosing among them.
    float diffuse_weight_ = 0.0f;
    float transmission_weight_ = 0.0f;
    float metal_weight_ = 0.0f;
    bool solid_ = false;
    bool has_specular_ = false;
    const SpecularAlbedo* albedo_ = nullptr;

    /// What follows from `RichFeatures`.
    struct RichState {
        ThinFilm film;
        SpecularAlbedo::Roughness roughness_x;
        float film_f0 = 0.0f;             ///< bound of the reflectance under the film
        Rgb diffuse_transmitted{0.0f};    ///< as `diffuse_`, on the other side
        float transmitted_choice = 0.0f;  ///< probability of the other side
    };
    struct Nothing {};
    [[no_unique_address]] std::conditional_t<rich, RichState, Nothing> rich_;
};

/// The plain model, which lives in path vertices.
using GltfBsdf = BasicGltfBsdf<PlainFeatures>;
/// The base of layered models.
using RichGltfBsdf = BasicGltfBsdf<RichFeatures>;

extern template class BasicGltfBsdf<PlainFeatures>;
extern template class BasicGltfBsdf<RichFeatures>;

}  // namespace bdpt
