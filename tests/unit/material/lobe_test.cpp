#include "bsdf_cases.h"
#include "catch.hpp"
#include "chi_square.h"
#include "direction_bins.h"
#include "material/lobes/boundary_lobes.h"
#include "material/lobes/coat.h"
#include "material/lobes/diffuse.h"
#include "material/lobes/fuzz.h"
#include "material/lobes/rough_diffuse.h"
#include "math/rgb.h"

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::test::lobe_test {
namespace {

/// A lobe of any type.
struct LobeCase {
    template <Lobe L>
    LobeCase(std::string what, const L& lobe, std::optional<float> index = {})
        : name(std::move(what)),
          ior(index),
          is_delta(lobe.is_delta()),
          eval([lobe](Vec3 wo, Vec3 wi, TransportMode mode) { return lobe.eval(wo, wi, mode); }),
          sample([lobe](Vec3 wo, float u_lobe, Vec2 u, TransportMode mode) {
              return lobe.sample(wo, u_lobe, u, mode);
          })
    {}

    std::string name;
    std::optional<float> ior;  ///< of lobes that refract
    bool is_delta;
    std::function<BsdfEval(Vec3, Vec3, TransportMode)> eval;
    std::function<std::optional<BsdfSample>(Vec3, float, Vec2, TransportMode)> sample;
    bool from_above = false;     ///< knows no directions below
    bool has_one_normal = true;  ///< f is reciprocal with the cosines to +z
};

const SpecularAlbedo& albedo()
{
    static const SpecularAlbedo result(1.5f);
    return result;
}

Boundary<NoFilm> dielectric(float transmission, bool is_solid)
{
    return {.base_color = Rgb{0.2f, 0.5f, 0.8f},
            .f0 = Rgb(albedo().normal_reflectance()),
            .f90 = 1.0f,
            .transmission = transmission,
            .ior = 1.5f,
            .is_solid = is_solid,
            .exists = true,
            .albedo = PackedPointer(&albedo())};
}

RoughDiffuse below_boundary(float roughness)
{
    RoughDiffuse surface(roughness);
    surface.set_boundary(1.05f);
    return surface;
}

constexpr auto always = [](float) { return 1.0f; };

std::vector<LobeCase> lobes()
{
    static const Boundary<NoFilm> plastic = dielectric(0.0f, false);
    static const Boundary<NoFilm> pane = dielectric(1.0f, false);
    static const Boundary<NoFilm> glass = dielectric(1.0f, true);
    static const FuzzTable fibres;
    const Vec2 brushed{0.5f, 0.2f};
    const Rgb f{0.1f, 0.2f, 0.3f};
    std::vector<LobeCase> result{
        {"diffuse reflection", DiffuseReflection(f)},
        {"diffuse transmission", DiffuseTransmission(f)},
        {"rough diffuse reflection", RoughDiffuseReflection(f, RoughDiffuse(0.4f))},
        {"very rough diffuse reflection", RoughDiffuseReflection(f, below_boundary(1.0f))},
        {"reflection of plastic", GgxReflection(plastic, 0.3f)},
        {"reflection of brushed plastic", GgxReflection(plastic, brushed)},
        {"reflection of glass", GgxReflection(glass, 0.3f), 1.5f},
        {"transmission of a pane", GgxTransmission(pane, 0.3f)},
        {"transmission of glass", GgxTransmission(glass, 0.3f), 1.5f},
        {"transmission of brushed glass", GgxTransmission(glass, brushed), 1.5f},
        {"both of a pane", GgxBoundary(pane, 0.3f)},
        {"both of glass", GgxBoundary(glass, 0.3f), 1.5f},
        {"smooth plastic", SmoothBoundary(plastic, 1.0f, always)},
        {"smooth glass", SmoothBoundary(glass, 1.0f, always), 1.5f},
    };
    const std::vector<LobeCase> above{
        {"coat", EvenCoat(0.8f, 0.5f, &albedo())},
        {"brushed coat", EvenCoat(0.8f, 0.5f, &albedo(), 0.5f)},
        {"smooth coat", EvenCoat(0.8f, 0.0f, &albedo())},
        {"tilted coat", Coat(1.0f, 0.5f, normalize(Vec3{0.3f, -0.2f, 1.0f}), &albedo())},
        {"fuzz", Fuzz(0.9f, Rgb{1.0f, 0.5f, 0.2f}, 0.5f, &fibres)},
        {"thin fuzz", Fuzz(1.0f, Rgb{1.0f}, 0.2f, &fibres)},
        {"dust", Fuzz(1.0f, Rgb{1.0f}, 1.0f, &fibres)},
    };
    for (LobeCase lobe : above) {
        lobe.from_above = true;
        lobe.eval = [eval = lobe.eval](Vec3 wo, Vec3 wi, TransportMode mode) {
            return wi.z > 0.0f ? eval(wo, wi, mode) : BsdfEval{};
        };
        lobe.has_one_normal = lobe.name != "tilted coat";
        result.push_back(lobe);
    }
    return result;
}

/// Calls `visit` for each lobe and each direction that it knows.
template <typename Visit>
void for_each_lobe(const Visit& visit)
{
    for (const LobeCase& lobe : lobes()) {
        for (const Vec3 wo : test::bsdf_directions()) {
            if (wo.z > 0.0f || !lobe.from_above) {
                CAPTURE(lobe.name, wo.x, wo.y, wo.z);
                visit(lobe, wo);
            }
        }
    }
}

}  // namespace

TEST_CASE("samples of every lobe are distributed by its density")
{
    const double significance = test::sidak(0.01, 100);
    int tested = 0;
    for_each_lobe([&](const LobeCase& lobe, Vec3 wo) {
        constexpr int samples = 60000;
        const test::Axes axes = test::axes_of(lobe.ior, wo);
        const std::vector<double> expected = test::bin_probabilities(lobe, axes, wo);
        const std::vector<double> counts = test::bin_counts(lobe, axes, wo, samples);
        if (lobe.is_delta) {
            CHECK(expected.back() == 1.0);
            CHECK(counts.back() == samples);
            return;
        }
        if (expected.back() > 0.9999) {
            CHECK(counts.back() > 0.999 * samples);  // total reflection
            return;
        }
        const test::ChiSquare chi_square = test::chi_square(counts, expected);
        CAPTURE(chi_square.statistic, chi_square.degrees, expected.back());
        CHECK(chi_square.p_value > significance);
        CHECK(chi_square.degrees >= 10);
        CHECK(chi_square.min_detectable(significance) < 0.1);
        ++tested;
    });
    CHECK(tested >= 60);
}

TEST_CASE("every lobe is the same from both ends")
{
    // f is reciprocal; where light is refracted, radiance over n^2 of its side is [Veach 1997, eq.
    // 5.14], and importance is what radiance is the other way. Densities swap.
    for_each_lobe([](const LobeCase& lobe, Vec3 wo) {
        test::Random random(31);
        int compared = 0;
        for (int i = 0; i < 20000 && compared < 100; ++i) {
            const float u_lobe = random.next();
            const auto sampled = lobe.sample(wo, u_lobe, random.next_2d(), TransportMode::radiance);
            if (!sampled || sampled->delta || std::abs(sampled->wi.z) < 0.02f) {
                continue;
            }
            const Vec3 wi = sampled->wi;
            const BsdfEval there = lobe.eval(wo, wi, TransportMode::radiance);
            const BsdfEval back = lobe.eval(wi, wo, TransportMode::importance);
            CAPTURE(wi.x, wi.y, wi.z);
            CHECK(there.pdf_fwd.value > 0.0f);
            CHECK(there.pdf_fwd.value == Approx(back.pdf_rev.value).epsilon(1e-3));
            CHECK(there.pdf_rev.value == Approx(back.pdf_fwd.value).epsilon(1e-3));
            for (int c = 0; lobe.has_one_normal && c < 3; ++c) {
                CHECK(there.f_cos[c] / std::abs(wi.z) ==
                      Approx(back.f_cos[c] / std::abs(wo.z)).epsilon(1e-3));
            }
            ++compared;
        }
        CHECK((compared == 100 || lobe.is_delta));
    });
}

TEST_CASE("no lobe makes light")
{
    for_each_lobe([](const LobeCase& lobe, Vec3 wo) {
        test::Random random(37);
        test::Moments sum;
        for (int i = 0; i < 4000; ++i) {
            const float u_lobe = random.next();
            const auto sampled =
                lobe.sample(wo, u_lobe, random.next_2d(), TransportMode::importance);
            double weight = 0.0;
            if (sampled && sampled->delta) {
                weight = static_cast<double>(max_component(sampled->weight));
            } else if (sampled && !grazes(sampled->wi)) {
                const BsdfEval value = lobe.eval(wo, sampled->wi, TransportMode::importance);
                weight = static_cast<double>(max_component(value.f_cos) / value.pdf_fwd.value);
            }
            sum.add(weight);
        }
        CHECK(sum.mean() < 1.0 + 1e-4 + 4.0 * sum.standard_error());
    });
}

TEST_CASE("a Lambertian surface is the general model without a boundary")
{
    const GltfParameters diffuse{.base_color = Rgb{0.2f, 0.5f, 0.8f}, .specular = 0.0f};
    const MetallicRoughness general(diffuse, albedo());
    const PlainModel plain = plain_model(diffuse, albedo());
    REQUIRE(std::holds_alternative<Lambertian>(plain));
    const Lambertian& lambertian = std::get<Lambertian>(plain);
    CHECK(lambertian.base_color() == general.base_color());
    test::Random random(41);
    for (int i = 0; i < 500; ++i) {
        const Vec3 wo = random.direction();
        const Vec3 wi = random.direction();
        const BsdfEval a = lambertian.eval(wo, wi, TransportMode::importance);
        const BsdfEval b = general.eval(wo, wi, TransportMode::importance);
        CHECK(a.f_cos == b.f_cos);
        CHECK(a.pdf_fwd.value == b.pdf_fwd.value);
        CHECK(a.pdf_rev.value == b.pdf_rev.value);
        const Vec2 u = random.next_2d();
        const auto c = lambertian.sample(wo, 0.7f, u, TransportMode::radiance);
        const auto d = general.sample(wo, 0.7f, u, TransportMode::radiance);
        REQUIRE((c && d));
        CHECK(c->wi == d->wi);
        CHECK(c->weight == diffuse.base_color);
        CHECK(d->weight.g == Approx(c->weight.g).epsilon(1e-6));
        CHECK(c->pdf_fwd.value == d->pdf_fwd.value);
    }
}

TEST_CASE("surfaces have the simplest model that there is for them")
{
    const auto model = [](const GltfParameters& parameters) {
        return plain_model(parameters, albedo());
    };
    CHECK(std::holds_alternative<Black>(model({.base_color = Rgb(0.0f), .specular = 0.0f})));
    CHECK(std::holds_alternative<Lambertian>(model({.specular = 0.0f})));
    CHECK(std::holds_alternative<MetallicRoughness>(model({})));
    CHECK(std::holds_alternative<MetallicRoughness>(model({.metallic = 0.1f, .specular = 0.0f})));
    CHECK(
        std::holds_alternative<MetallicRoughness>(model({.specular = 0.0f, .transmission = 0.1f})));
    CHECK(
        std::holds_alternative<MetallicRoughness>(model({.specular = 0.0f, .body = Body::solid})));
}

}  // namespace bdpt::test::lobe_test
