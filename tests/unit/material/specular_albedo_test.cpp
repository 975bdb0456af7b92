#include "material/specular_albedo.h"

#include "catch.hpp"
#include "material/lobes/boundary.h"
#include "material/lobes/ggx.h"
#include "statistics.h"

#include <algorithm>
#include <cmath>

namespace bdpt::test::specular_albedo_test {
namespace {

/// What the table holds, by random samples of visible normals.
SpecularAlbedo::Split sampled(const SpecularAlbedo& albedo, float cosine, float roughness)
{
    constexpr int samples = 100000;
    const float alpha = roughness * roughness;
    const Vec3 wo{std::sqrt(1.0f - cosine * cosine), 0.0f, cosine};
    test::Random random(73);
    double f0 = 0.0;
    double f90 = 0.0;
    for (int i = 0; i < samples; ++i) {
        const Vec3 h = ggx::sample_visible_normal(wo, alpha, random.next_2d());
        const float cos_h = dot(wo, h);
        const Vec3 wi = 2.0f * cos_h * h - wo;
        if (wi.z <= 0.0f) {
            continue;
        }
        const ggx::Lobe lobe = ggx::reflect(wo, wi, alpha);
        const double weight = static_cast<double>(lobe.f_cos / lobe.pdf_fwd);
        const double g = static_cast<double>(albedo.fresnel_course(cos_h));
        f0 += weight * (1.0 - g);
        f90 += weight * g;
    }
    return {static_cast<float>(f0 / samples), static_cast<float>(f90 / samples)};
}

/// What `RefractionLoss` holds, by random samples of visible normals.
float sampled_loss(const SpecularAlbedo& albedo, RefractionLoss::Side side, float cosine,
                   float roughness)
{
    constexpr int samples = 100000;
    const bool is_outer = side == RefractionLoss::Side::outer;
    const float alpha = roughness * roughness;
    const float eta = is_outer ? 1.0f / albedo.ior() : albedo.ior();
    const Vec3 wo{std::sqrt(1.0f - cosine * cosine), 0.0f, cosine};
    test::Random random(79);
    double scattered = 0.0;
    for (int i = 0; i < samples; ++i) {
        const ggx::Microfacet facet = ggx::visible_microfacet(wo, alpha, random.next_2d());
        const float cos2_far = 1.0f - eta * eta * (1.0f - facet.cosine * facet.cosine);
        const float cos_outer = is_outer ? facet.cosine : std::sqrt(std::max(0.0f, cos2_far));
        const float reflected =
            cos2_far > 0.0f ? fresnel_dielectric(cos_outer, albedo.ior()) : 1.0f;
        const auto stay = [&](const ggx::Lobe& lobe) {
            return lobe.pdf_fwd > 0.0f ? static_cast<double>(lobe.f_cos / lobe.pdf_fwd) : 0.0;
        };
        if (const Vec3 up = facet.reflected(); up.z > 0.0f) {
            scattered += static_cast<double>(reflected) * stay(ggx::reflect(wo, up, alpha));
        }
        if (cos2_far <= 0.0f) {
            continue;
        }
        if (const Vec3 down = refracted(wo, facet.h, facet.cosine, eta); down.z < 0.0f) {
            const float n_o = is_outer ? 1.0f : albedo.ior();
            const float n_i = is_outer ? albedo.ior() : 1.0f;
            scattered += static_cast<double>(1.0f - reflected) *
                         stay(ggx::refract(wo, down, n_o, n_i, alpha));
        }
    }
    return static_cast<float>(1.0 - scattered / samples);
}

}  // namespace

TEST_CASE("RefractionLoss holds the integrals, also between its nodes", "[long]")
{
    for (const float ior : {1.1f, 1.33f, 1.5f, 2.4f}) {
        const SpecularAlbedo albedo(ior);
        const float f0 = albedo.normal_reflectance();
        for (const auto side : {RefractionLoss::Side::outer, RefractionLoss::Side::inner}) {
            for (const float roughness : {0.11f, 0.41f, 0.72f, 1.0f}) {
                for (const float cosine : {0.02f, 0.13f, 0.36f, 0.7f, 1.0f}) {
                    CAPTURE(ior, side == RefractionLoss::Side::outer, roughness, cosine);
                    const float table =
                        albedo.refraction_loss().directional(side, cosine, roughness, f0, 1.0f);
                    const float exact = sampled_loss(albedo, side, cosine, roughness);
                    CHECK(table == Approx(exact).margin(cosine < 0.1f ? 0.012 : 0.004));
                }
            }
        }
    }
}

TEST_CASE("fresnel_dielectric has the textbook's values")
{
    CHECK(fresnel_dielectric(1.0f, 1.5f) == Approx(0.04f));
    CHECK(fresnel_dielectric(0.0f, 1.5f) == 1.0f);
    CHECK(fresnel_dielectric(1.0f, 2.4f) == Approx(1.4 * 1.4 / (3.4 * 3.4)));
    // Brewster's angle: tan = n, no parallel part, and the other is ((n^2 - 1) / (n^2 + 1))^2.
    const float brewster = 1.0f / std::sqrt(1.0f + 2.25f);
    CHECK(fresnel_dielectric(brewster, 1.5f) == Approx(0.5 * std::pow(1.25 / 3.25, 2.0)));
    for (const float cosine : {0.0f, 1e-4f, 0.5f, 1.0f}) {
        CHECK(fresnel_dielectric(cosine, 1.0f) == Approx(0.0f).margin(1e-6));
    }
}

TEST_CASE("fresnel_course makes Fresnel's equations of F0 and F90")
{
    for (const float ior : {1.33f, 1.5f, 2.4f}) {
        const SpecularAlbedo albedo(ior);
        const float r0 = albedo.normal_reflectance();
        CHECK(r0 == Approx(fresnel_dielectric(1.0f, ior)));
        for (int i = 0; i <= 100; ++i) {
            const float cosine = static_cast<float>(i) / 100.0f;
            const float f = r0 + (1.0f - r0) * albedo.fresnel_course(cosine);
            CHECK(f == Approx(fresnel_dielectric(cosine, ior)).margin(1e-6));
        }
    }
    const SpecularAlbedo none(1.0f);
    CHECK(none.normal_reflectance() == 0.0f);
    CHECK(none.fresnel_course(0.3f) == Approx(0.0f).margin(1e-7));
    CHECK(none.fresnel_course(0.0f) == 0.0f);
}

TEST_CASE("SpecularAlbedo holds the integrals")
{
    for (const float ior : {1.0f, 1.33f, 1.5f, 2.4f}) {
        const SpecularAlbedo albedo(ior);
        for (const float roughness : {0.04f, 0.1f, 0.3f, 0.55f, 1.0f}) {
            for (const float cosine : {0.01f, 0.1f, 0.3f, 0.62f, 1.0f}) {
                CAPTURE(ior, roughness, cosine);
                const SpecularAlbedo::Split table =
                    albedo.directional(cosine, SpecularAlbedo::at_roughness(roughness));
                const SpecularAlbedo::Split exact = sampled(albedo, cosine, roughness);
                // A hundredth of the light at grazing angles is a hundredth of a thin rim.
                const double tolerance = cosine < 0.2f ? 0.02 : 0.004;
                CHECK(table.f0 == Approx(exact.f0).margin(tolerance));
                CHECK(table.f90 == Approx(exact.f90).margin(tolerance));
                CHECK(table.f0 >= 0.0f);
                CHECK(table.f90 >= 0.0f);
                CHECK(table.f0 + table.f90 <= 1.0f + 1e-6f);
            }
        }
    }
}

TEST_CASE("smooth boundaries have Fresnel's albedo")
{
    const SpecularAlbedo albedo(1.5f);
    for (int i = 1; i <= 50; ++i) {
        const float cosine = static_cast<float>(i) / 50.0f;
        const SpecularAlbedo::Split split =
            albedo.directional(cosine, SpecularAlbedo::at_roughness(0.0f));
        CHECK(split.f90 == Approx(albedo.fresnel_course(cosine)).margin(1e-3));
        CHECK(split.f0 + split.f90 == Approx(1.0f));
    }
}

TEST_CASE("the average of SpecularAlbedo fits its directional values")
{
    const SpecularAlbedo albedo(1.5f);
    for (const float roughness : {0.0f, 0.21f, 0.5f, 1.0f}) {
        constexpr int steps = 100000;
        double f0 = 0.0;
        double f90 = 0.0;
        for (int i = 0; i < steps; ++i) {
            const auto cosine = static_cast<float>((i + 0.5) / steps);
            const SpecularAlbedo::Split split =
                albedo.directional(cosine, SpecularAlbedo::at_roughness(roughness));
            f0 += 2.0 * static_cast<double>(split.f0 * cosine) / steps;
            f90 += 2.0 * static_cast<double>(split.f90 * cosine) / steps;
        }
        CHECK(albedo.average(SpecularAlbedo::at_roughness(roughness)).f0 ==
              Approx(f0).epsilon(1e-5));
        CHECK(albedo.average(SpecularAlbedo::at_roughness(roughness)).f90 ==
              Approx(f90).epsilon(1e-5));
    }
    // The diffuse reflectance of smooth glass from outside is 0.0918 at n = 1.5 [Duntley 1942].
    const SpecularAlbedo::Split smooth = albedo.average(SpecularAlbedo::at_roughness(0.0f));
    CHECK(0.04f * smooth.f0 + smooth.f90 == Approx(0.0918f).margin(3e-4));
}

}  // namespace bdpt::test::specular_albedo_test
