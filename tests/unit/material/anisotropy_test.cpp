#include "material/lobes/ggx.h"
#include "material/lobes/interreflection.h"
#include "material/models/layered.h"
#include "material/specular_albedo.h"

#include "catch.hpp"
#include "layered_cases.h"

#include <algorithm>
#include <cmath>

namespace bdpt::test::anisotropy_test {

TEST_CASE("the normals of a brushed surface fill its area once")
{
    // The integral of D(h) h.z over the hemisphere is 1.
    for (const Vec2 alpha : {Vec2{0.3f, 0.3f}, Vec2{0.8f, 0.2f}, Vec2{1.0f, 0.5f}}) {
        constexpr int heights = 400;
        constexpr int azimuths = 400;
        constexpr double exact_pi = 3.14159265358979323846;
        double sum = 0.0;
        for (int i = 0; i < heights; ++i) {
            const double z = (i + 0.5) / heights;
            const double sine = std::sqrt(1.0 - z * z);
            for (int j = 0; j < azimuths; ++j) {
                const double turn = 2.0 * exact_pi * (j + 0.5) / azimuths;
                const Vec3 h(sine * std::cos(turn), sine * std::sin(turn), z);
                sum += static_cast<double>(ggx::distribution(h, 1.0f, alpha)) * z;
            }
        }
        CAPTURE(alpha.x, alpha.y);
        CHECK(sum * 2.0 * exact_pi / (heights * azimuths) == Approx(1.0).epsilon(2e-3));
    }
}

TEST_CASE("equal roughness both ways is the isotropic distribution")
{
    const Vec3 wo = normalize(Vec3{0.3f, -0.5f, 0.7f});
    const Vec3 wi = normalize(Vec3{-0.6f, 0.1f, 0.4f});
    const ggx::Lobe one = ggx::reflect(wo, wi, 0.4f);
    const ggx::Lobe two = ggx::reflect(wo, wi, Vec2{0.4f, 0.4f});
    CHECK(two.f_cos == Approx(one.f_cos));
    CHECK(two.pdf_fwd == Approx(one.pdf_fwd));
    CHECK(two.pdf_rev == Approx(one.pdf_rev));
    const Vec3 below{wi.x, wi.y, -wi.z};
    CHECK(ggx::refract(wo, below, 1.0f, 1.5f, Vec2{0.4f, 0.4f}).f_cos ==
          Approx(ggx::refract(wo, below, 1.0f, 1.5f, 0.4f).f_cos));
}

TEST_CASE("brushed metal has the values of the extension's formula")
{
    // Roughness 0.5 and strength 0.6: alpha is 0.25 across and mix(0.25, 1, 0.36) = 0.52 along x.
    const test::TestedBsdf bsdf({"brushed", {Rgb{1.0f}, 1, 0.5f}, 1.5f, test::brushed(0.6f)});
    const Vec3 wo = normalize(Vec3{0.4f, 0.1f, 0.8f});
    const Vec3 wi = normalize(Vec3{-0.1f, 0.3f, 0.6f});
    const Vec3 h = normalize(wo + wi);
    const double at = 0.52;
    const double ab = 0.25;
    const auto d = [](float x) { return static_cast<double>(x); };
    const double q = std::pow(d(h.x) / at, 2) + std::pow(d(h.y) / ab, 2) + std::pow(d(h.z), 2);
    const double distribution = 1.0 / (3.14159265358979 * at * ab * q * q);
    const auto length = [&](Vec3 w) {
        return std::sqrt(std::pow(at * d(w.x), 2) + std::pow(ab * d(w.y), 2) + std::pow(d(w.z), 2));
    };
    const double visibility = 0.5 / (d(wi.z) * length(wo) + d(wo.z) * length(wi));
    // And what is reflected often, as by the roughness that reflects more at once.
    const auto larger = [](const auto& of) { return std::max(of(0.5f), of(std::sqrt(0.52f))); };
    const auto unreflected = [&](Vec3 w) {
        return 1.0f - larger([&](float r) { return WhiteAlbedo::directional(w.z, r); });
    };
    const Interreflection repeated(Rgb{1.0f}, larger(WhiteAlbedo::average), 1.0f);
    const double expected =
        distribution * visibility * d(wi.z) + d(repeated.lobe(unreflected(wo), unreflected(wi))
                                                    .eval(wo, wi, TransportMode::radiance)
                                                    .f_cos.g);
    CHECK(d(bsdf.eval(wo, wi, TransportMode::radiance).f_cos.g) == Approx(expected).epsilon(1e-3));
    // The blur is along x.
    const Vec3 up{0.0f, 0.0f, 1.0f};
    const auto towards = [&](Vec3 w) {
        return bsdf.eval(up, normalize(w), TransportMode::radiance).f_cos.g;
    };
    CHECK(towards({0.9f, 0.0f, 1.0f}) > 2.0f * towards({0.0f, 0.9f, 1.0f}));
}

}  // namespace bdpt::test::anisotropy_test
