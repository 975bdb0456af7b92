#include "bsdf_cases.h"
#include "catch.hpp"
#include "material/lobes/interreflection.h"
#include "material/specular_albedo.h"
#include "math/rgb.h"
#include "statistics.h"

#include <cmath>

namespace bdpt::test::bsdf_symmetry_test {
namespace {

/// A direction that scattering makes likely, or any; so that narrow lobes are tested too.
Vec3 partner(const test::TestedBsdf& bsdf, Vec3 wo, test::Random& random)
{
    const float u_lobe = random.next();
    const auto sampled = bsdf.sample(wo, u_lobe, random.next_2d(), TransportMode::radiance);
    const bool use_sample = random.next() < 0.8f && sampled && !sampled->delta;
    return use_sample ? sampled->wi : random.direction();
}

float index_at(const test::BsdfCase& bsdf_case, float z)
{
    return bsdf_case.refracts() && z < 0.0f ? bsdf_case.ior : 1.0f;
}

void check_close(Rgb a, Rgb b, float tolerance)
{
    const float scale = std::max(max_component(a), max_component(b));
    for (int channel = 0; channel < 3; ++channel) {
        CHECK(std::abs(a[channel] - b[channel]) <= tolerance * scale);
    }
}

}  // namespace

TEST_CASE("BSDFs have the symmetries of light")
{
    constexpr int pairs = 4000;
    for (const test::BsdfCase& bsdf_case : test::bsdf_cases()) {
        const test::TestedBsdf bsdf(bsdf_case);
        test::Random random(41);
        // Rounding of the directions moves the half vector by about 1e-7 / (ior - 1), which is
        // compared with the width of the lobe.
        const float alpha =
            std::max(0.001f, bsdf_case.surface.roughness * bsdf_case.surface.roughness);
        const float tolerance =
            bsdf_case.refracts() && bsdf_case.ior == 1.0f ? 0.05f : 1e-4f + 3e-6f / alpha;
        int nonzero = 0;
        for (int i = 0; i < pairs; ++i) {
            const Vec3 wo = random.direction();
            const Vec3 wi = partner(bsdf, wo, random);
            if (std::abs(wo.z) < 1e-3f || std::abs(wi.z) < 1e-3f) {
                continue;
            }
            CAPTURE(bsdf_case.name, wo.x, wo.y, wo.z, wi.x, wi.y, wi.z);
            const BsdfEval there = bsdf.eval(wo, wi, TransportMode::radiance);
            const BsdfEval back = bsdf.eval(wi, wo, TransportMode::radiance);
            const BsdfEval adjoint = bsdf.eval(wi, wo, TransportMode::importance);
            const float n_o = index_at(bsdf_case, wo.z);
            const float n_i = index_at(bsdf_case, wi.z);
            const Rgb f_there = there.f_cos / std::abs(wi.z);
            const Rgb f_back = back.f_cos / std::abs(wo.z);
            // f / n^2 is reciprocal [Veach 1997, eq. 5.14], n on the side that is looked from.
            if (!bsdf_case.tilted_coat) {
                check_close(f_there / (n_o * n_o), f_back / (n_i * n_i), tolerance);
            }
            // The adjoint is f with its arguments exchanged [Veach 1997, sec. 3.7.6].
            check_close(f_there, adjoint.f_cos / std::abs(wo.z), tolerance);
            // Over a normal of its own a coat knows which end is the eye.
            const BsdfEval& swapped = bsdf_case.tilted_coat ? adjoint : back;
            CHECK(there.pdf_fwd.value == Approx(swapped.pdf_rev.value).epsilon(tolerance));
            CHECK(there.pdf_rev.value == Approx(swapped.pdf_fwd.value).epsilon(tolerance));
            CHECK((bsdf_case.tilted_coat || adjoint.pdf_fwd.value == back.pdf_fwd.value));
            if (max_component(there.f_cos) > 0.0f) {
                CHECK(there.pdf_fwd.value > 0.0f);  // whatever scatters can be sampled
                ++nonzero;
            }
        }
        CAPTURE(bsdf_case.name);
        CHECK((nonzero > 0) == bsdf.has_smooth_lobe());
    }
}

TEST_CASE("eval and sample of a BSDF agree")
{
    for (const test::BsdfCase& bsdf_case : test::bsdf_cases()) {
        const test::TestedBsdf bsdf(bsdf_case);
        test::Random random(43);
        for (int i = 0; i < 4000; ++i) {
            const Vec3 wo = random.direction();
            const auto mode = i % 2 == 0 ? TransportMode::radiance : TransportMode::importance;
            const float u_lobe = random.next();
            const auto sampled = bsdf.sample(wo, u_lobe, random.next_2d(), mode);
            if (!sampled) {
                continue;
            }
            CAPTURE(bsdf_case.name, wo.x, wo.y, wo.z, sampled->wi.x, sampled->wi.y, sampled->wi.z);
            REQUIRE(dot(sampled->wi, sampled->wi) == Approx(1.0).epsilon(1e-5));
            REQUIRE(is_finite(sampled->weight));
            REQUIRE(std::isfinite(sampled->pdf_fwd.value));
            REQUIRE(std::isfinite(sampled->pdf_rev.value));
            CHECK(sampled->pdf_fwd.value > 0.0f);
            if (sampled->delta) {
                continue;
            }
            const BsdfEval value = bsdf.eval(wo, sampled->wi, mode);
            CHECK(sampled->pdf_fwd.value == Approx(value.pdf_fwd.value).epsilon(1e-5));
            CHECK(sampled->pdf_rev.value == Approx(value.pdf_rev.value).epsilon(1e-5));
            check_close(sampled->weight * sampled->pdf_fwd.value, value.f_cos, 1e-5f);
        }
    }
}

TEST_CASE("all but solid transmitters scatter alike from both sides")
{
    for (const test::BsdfCase& bsdf_case : test::bsdf_cases()) {
        if (bsdf_case.surface.body == Body::solid || bsdf_case.tilted_coat) {
            continue;
        }
        const test::TestedBsdf bsdf(bsdf_case);
        test::Random random(47);
        for (int i = 0; i < 1000; ++i) {
            const Vec3 wo = random.direction();
            const Vec3 wi = partner(bsdf, wo, random);
            const BsdfEval front = bsdf.eval(wo, wi, TransportMode::radiance);
            const BsdfEval back =
                bsdf.eval({wo.x, wo.y, -wo.z}, {wi.x, wi.y, -wi.z}, TransportMode::radiance);
            CHECK(front.f_cos == back.f_cos);
            CHECK(front.pdf_fwd.value == back.pdf_fwd.value);
            CHECK(front.pdf_rev.value == back.pdf_rev.value);
        }
    }
}

TEST_CASE("BSDFs have the values worked out by hand")
{
    const SpecularAlbedo albedo(1.5f);
    const Vec3 up{0.0f, 0.0f, 1.0f};
    const Vec3 down{0.0f, 0.0f, -1.0f};
    const Rgb base{0.2f, 0.5f, 0.8f};

    SECTION("Lambert: base / pi")
    {
        const Lambertian bsdf(base);
        const Vec3 wi = normalize(Vec3{1.0f, 0.0f, 1.0f});
        const BsdfEval value = bsdf.eval(up, wi, TransportMode::radiance);
        check_close(value.f_cos, base * (inv_pi * wi.z), 1e-6f);
        CHECK(value.pdf_fwd.value == Approx(inv_pi * wi.z));
        CHECK(value.pdf_rev.value == Approx(inv_pi));
        CHECK(bsdf.eval(up, down, TransportMode::radiance).pdf_fwd.value == 0.0f);
    }
    SECTION("metal of alpha 1, seen straight: base D G / 4 = base / (4 pi), and interreflection")
    {
        const MetallicRoughness bsdf({base, 1, 1}, albedo);
        const float unreflected = 1.0f - WhiteAlbedo::directional(1.0f, 1.0f);
        CHECK(unreflected == Approx(std::log(2.0f)).epsilon(5e-4));
        const Rgb repeated = Interreflection(base, WhiteAlbedo::average(1.0f), 1.0f)
                                 .lobe(unreflected, unreflected)
                                 .eval(up, up, TransportMode::radiance)
                                 .f_cos;
        check_close(bsdf.eval(up, up, TransportMode::radiance).f_cos,
                    base * (0.25f * inv_pi) + repeated, 1e-5f);
    }
    SECTION(
        "glass of alpha 1, straight through at one microfacet: (1 - F) D / (n - 1)^2, times n^2 "
        "for importance")
    {
        const MetallicRoughness bsdf({Rgb{1.0f}, 0, 1, 1, Rgb{1.0f}, 1, Body::solid}, albedo);
        const float radiance = 0.96f * inv_pi / 0.25f;
        const RefractionLoss& loss = albedo.refraction_loss();
        const float f0 = albedo.normal_reflectance();
        constexpr auto outer = RefractionLoss::Side::outer;
        constexpr auto inner = RefractionLoss::Side::inner;
        const RepeatedRefraction again({1.0f, loss.average(outer, 1.0f, f0, 1.0f)},
                                       {1.5f, loss.average(inner, 1.0f, f0, 1.0f)}, 1.0f,
                                       Rgb{1.0f});
        const float lost_up = loss.directional(outer, 1.0f, 1.0f, f0, 1.0f);
        const float lost_down = loss.directional(inner, 1.0f, 1.0f, f0, 1.0f);
        const auto once = [&](Vec3 wo, TransportMode mode) {
            const bool above = wo.z > 0.0f;
            return bsdf.eval(wo, -wo, mode).f_cos.x - again
                                                          .eval(wo, -wo,
                                                                above ? lost_up : lost_down,
                                                                above ? lost_down : lost_up, mode)
                                                          .f_cos.x;
        };
        CHECK(once(up, TransportMode::radiance) == Approx(radiance));
        CHECK(once(up, TransportMode::importance) == Approx(radiance * 2.25f));
        // Out of the glass the quotient of the indices is turned over.
        CHECK(once(down, TransportMode::radiance) == Approx(radiance * 2.25f));
        CHECK(once(down, TransportMode::importance) == Approx(radiance));
    }
    SECTION("a default BSDF is black")
    {
        const Black bsdf;
        CHECK(!bsdf.has_smooth_lobe());
        CHECK(bsdf.eval(up, up, TransportMode::radiance).f_cos == Rgb{0.0f});
        CHECK(!bsdf.sample(up, 0.3f, {0.1f, 0.9f}, TransportMode::radiance));
    }
}

}  // namespace bdpt::test::bsdf_symmetry_test
