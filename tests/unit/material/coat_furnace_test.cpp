#include "material/layer_loss.h"
#include "material/lobes/fuzz.h"

#include "bsdf_cases.h"
#include "catch.hpp"
#include "mapped_cases.h"
#include "math/elementary.h"
#include "math/sampler.h"
#include "statistics.h"

#include <cmath>
#include <string>
#include <vector>

namespace bdpt::test::coat_furnace_test {
namespace {

/// Returns the share of light from `wo` that is scattered at all, within about 0.0005, by points of
/// a Sobol sequence.
double albedo_of(const test::TestedBsdf& bsdf, Vec3 wo)
{
    constexpr int log_samples = 15;
    double sum = 0.0;
    for (int i = 0; i < 1 << log_samples; ++i) {
        Sampler numbers(SamplerKind::sobol, 59, 0, 0, i, log_samples);
        numbers.start(SampleUse::camera_walk);
        const Vec2 u = numbers.next_2d();
        const auto sampled = bsdf.sample(wo, numbers.next_1d(), u, TransportMode::importance);
        sum += sampled ? static_cast<double>(sampled->weight.g) : 0.0;
    }
    return sum / (1 << log_samples);
}

Vec3 at_cosine(float cosine)
{
    return {std::sqrt(1.0f - cosine * cosine), 0.0f, cosine};
}

/// White below a full coat of this roughness.
std::vector<test::BsdfCase> white_cases(float coat)
{
    const Rgb white{1.0f};
    std::vector<test::BsdfCase> cases;
    for (const float base : {0.1f, 0.3f, 0.6f, 1.0f}) {
        const std::string name = " " + std::to_string(base);
        cases.push_back({"metal" + name, {white, 1, base}, 1.5f, test::coated(1, coat)});
        cases.push_back({"plastic" + name, {white, 0, base}, 1.5f, test::coated(1, coat)});
    }
    cases.push_back({"lambert", {white, 0, 1, 0}, 1.5f, test::coated(1, coat)});
    cases.push_back({"half a coat", {white, 1, 0.6f}, 1.5f, test::coated(0.5f, coat)});
    cases.push_back({"half metal", {white, 0.5f, 0.4f}, 1.5f, test::coated(1, coat)});
    cases.push_back({"index 2.4", {white, 0, 0.3f}, 2.4f, test::coated(1, coat)});
    cases.push_back({"index 3", {white, 0, 1}, 3.0f, test::coated(1, coat)});
    cases.push_back({"like metal", {white, 0, 0.6f, 1, Rgb{25}}, 1.5f, test::coated(1, coat)});
    cases.push_back({"index 1", {white, 0, 0.3f}, 1.0f, test::coated(1, coat)});
    cases.push_back({"half specular", {white, 0, 0.3f, 0.5f}, 1.5f, test::coated(1, coat)});
    return cases;
}

/// Returns the albedo of a surface with a normal map, seen from one height: the mean over all
/// azimuths, so that all tilts of a real map are there.
double mean_albedo(const test::MappedSurface& surface, int eyes, int samples_of_eye)
{
    double sum = 0.0;
    test::Random random(71);
    for (int i = 0; i < eyes; ++i) {
        const SinCos around = sin_cos(2.0f * pi * random.next());
        const Bsdf bsdf = surface.seen_from({0.8f * around.cos, 0.8f * around.sin, 0.6f});
        for (int k = 0; k < samples_of_eye; ++k) {
            const float u_lobe = random.next();
            const auto got = bsdf.sample(u_lobe, random.next_2d(), TransportMode::radiance);
            sum += got ? static_cast<double>(got->weight.g) : 0.0;
        }
    }
    return sum / (static_cast<double>(eyes) * samples_of_eye);
}

}  // namespace

TEST_CASE("a white surface below any coat is invisible in a white furnace", "[long]")
{
    const float coat = GENERATE(0.0f, 0.2f, 0.5f, 1.0f);
    for (const test::BsdfCase& bsdf_case : white_cases(coat)) {
        const test::TestedBsdf bsdf(bsdf_case);
        for (const float cosine : {1.0f, 0.7f, 0.4f, 0.15f, -0.6f}) {
            CAPTURE(coat, bsdf_case.name, cosine);
            const double sum = albedo_of(bsdf, at_cosine(cosine));
            CHECK(sum > 0.995);
            CHECK(sum < 1.001);
        }
    }
}

TEST_CASE("layers on black without a boundary reflect what they do alone")
{
    const float roughness = GENERATE(0.3f, 1.0f);
    const SpecularAlbedo coat(1.5f);
    const Rgb black{0.0f};
    const test::TestedBsdf coated(
        test::BsdfCase{"coat", {black, 0, 1, 0}, 1.5f, test::coated(1, roughness)});
    const test::TestedBsdf fuzzy(
        test::BsdfCase{"fibres", {black, 0, 1, 0}, 1.5f, test::fuzzy(1, Rgb{1.0f}, roughness, {})});
    for (const float cosine : {1.0f, 0.7f, 0.15f}) {
        CAPTURE(roughness, cosine);
        const auto [f0, f90] = coat.directional(cosine, SpecularAlbedo::at_roughness(roughness));
        CHECK(albedo_of(coated, at_cosine(cosine)) ==
              Approx(coat.normal_reflectance() * f0 + f90).epsilon(0.02));
        CHECK(albedo_of(fuzzy, at_cosine(cosine)) ==
              Approx(FuzzTable::directional(cosine, roughness)).epsilon(0.02));
    }
}

TEST_CASE("a white surface below fibres, and any coat above or below them, loses next to nothing",
          "[long]")
{
    const Rgb white{1.0f};
    const float fuzz = GENERATE(0.1f, 0.3f, 0.6f, 1.0f);
    for (const float coat : {-1.0f, 0.0f, 0.3f, 1.0f}) {
        for (const bool on_coat : {false, true}) {
            if (coat < 0.0f && on_coat) {
                continue;
            }
            const LayeredParameters layers = test::fuzzy(
                1, white, fuzz, coat < 0.0f ? LayeredParameters{} : test::coated(1, coat));
            std::vector<test::BsdfCase> cases{{"lambert", {white, 0, 1, 0}, 1.5f, layers},
                                              {"plastic 0.2", {white, 0, 0.2f}, 1.5f, layers},
                                              {"plastic 1", {white, 0, 1}, 1.5f, layers},
                                              {"index 2.4", {white, 0, 0.4f}, 2.4f, layers},
                                              {"mirror", {white, 1, 0}, 1.5f, layers},
                                              {"metal 0.3", {white, 1, 0.3f}, 1.5f, layers},
                                              {"metal 1", {white, 1, 1}, 1.5f, layers}};
            for (test::BsdfCase& bsdf_case : cases) {
                bsdf_case.fuzz_on_coat = on_coat;
                const test::TestedBsdf bsdf(bsdf_case);
                for (const float cosine : {1.0f, 0.7f, 0.4f, 0.15f, -0.6f}) {
                    CAPTURE(fuzz, coat, on_coat, bsdf_case.name, cosine);
                    const double sum = albedo_of(bsdf, at_cosine(cosine));
                    CHECK(sum > (coat < 0.0f ? 0.995 : 0.9945));
                    CHECK(sum < 1.001);
                }
            }
        }
    }
}

TEST_CASE("a white surface below a coat of any index loses next to nothing", "[long]")
{
    const float ior = GENERATE(1.0f, 1.2f, 1.8f, 2.5f, 4.0f);
    for (const float coat : {0.0f, 0.4f, 1.0f}) {
        for (test::BsdfCase bsdf_case : white_cases(coat)) {
            bsdf_case.coat_ior = ior;
            bsdf_case.coat_darkening = 1.0f;
            const test::TestedBsdf bsdf(bsdf_case);
            for (const float cosine : {1.0f, 0.5f, 0.15f}) {
                CAPTURE(ior, coat, bsdf_case.name, cosine);
                const double sum = albedo_of(bsdf, at_cosine(cosine));
                CHECK(sum > 0.995);
                CHECK(sum < 1.0015);
            }
        }
    }
}

TEST_CASE("an anisotropic coat neither makes nor loses much light", "[long]")
{
    const Rgb white{1.0f};
    for (const float roughness : {0.0f, 0.3f, 0.6f}) {
        const LayeredParameters layers = test::lacquered(white, 0.6f, test::coated(1, roughness));
        const std::vector<test::BsdfCase> cases{{"lambert", {white, 0, 1, 0}, 1.5f, layers},
                                                {"plastic", {white, 0, 0.3f}, 1.5f, layers},
                                                {"mirror", {white, 1, 0}, 1.5f, layers},
                                                {"metal", {white, 1, 0.5f}, 1.5f, layers}};
        for (const test::BsdfCase& bsdf_case : cases) {
            const test::TestedBsdf bsdf(bsdf_case);
            for (const float cosine : {1.0f, 0.7f, 0.4f, 0.15f}) {
                CAPTURE(roughness, bsdf_case.name, cosine);
                const double sum = albedo_of(bsdf, at_cosine(cosine));
                CHECK(std::abs(sum - 1.0) < 0.011);
            }
        }
    }
}

TEST_CASE("a coat colours by the way through it, and darkens by light reflected inside")
{
    const Rgb base{0.8f, 0.5f, 0.2f};
    const Rgb tint{0.9f, 0.4f, 0.25f};
    constexpr float ior = 1.6f;
    const auto seen = [&](float darkening, Rgb color, Vec3 wo, Vec3 wi) {
        test::BsdfCase lacquer{
            "lacquer", {base, 0, 1, 0}, 1.5f, test::lacquered(color, 0, test::coated(1, 0))};
        lacquer.coat_ior = ior;
        lacquer.coat_darkening = darkening;
        return test::TestedBsdf(lacquer).eval(wo, wi, TransportMode::radiance).f_cos;
    };
    const Vec3 up = at_cosine(1.0f);
    const Vec3 low = at_cosine(0.3f);
    // The way of light at 0.3 is bent to a cosine of sqrt(1 - 0.91 / 1.6^2).
    const float steep = std::sqrt(1.0f - 0.91f / (ior * ior));
    // The average of Fresnel's equations, as light comes from outside, is 0.11024 for 1.6: from
    // inside 1 - (1 - 0.11024) / 1.6^2 = 0.65244 is reflected.
    constexpr float inside = 0.65244f;
    const Rgb clear = seen(0.0f, Rgb(1.0f), low, up);
    const Rgb tinted = seen(0.0f, tint, low, up);
    const Rgb dark = seen(1.0f, Rgb(1.0f), low, up);
    const Rgb half_dark = seen(0.5f, Rgb(1.0f), low, up);
    for (int c = 0; c < 3; ++c) {
        const float way = 0.5f + 0.5f / steep;
        CHECK(tinted[c] / clear[c] == Approx(std::pow(tint[c], way)).epsilon(2e-3));
        const float left = (1.0f - inside) / (1.0f - inside * base[c]);
        CHECK(dark[c] / clear[c] == Approx(left).epsilon(5e-3));
        CHECK(half_dark[c] / clear[c] == Approx(0.5f + 0.5f * left).epsilon(5e-3));
    }
}

TEST_CASE("light that returns from fibres is coloured by the coat below them")
{
    // A coat that passes no blue light looks like one above black, in blue.
    const LayeredParameters varnish = test::coated(1, 0.3f);
    const auto blue = [&](Rgb base, Rgb tint, Vec3 wo) {
        test::BsdfCase velvet{"velvet",
                              {base, 0, 1, 0},
                              1.5f,
                              test::lacquered(tint, 0, test::fuzzy(1, Rgb(1.0f), 0.3f, varnish))};
        velvet.fuzz_on_coat = true;
        const Vec3 low = at_cosine(0.3f);
        return test::TestedBsdf(velvet).eval(wo, low, TransportMode::radiance).f_cos.b;
    };
    for (const float cosine : {1.0f, 0.5f}) {
        const Vec3 wo = at_cosine(cosine);
        CHECK(blue(Rgb(1.0f), {1.0f, 1.0f, 0.0f}, wo) ==
              Approx(blue(Rgb(1e-6f), Rgb(1.0f), wo)).epsilon(2e-3));
    }
}

TEST_CASE("light between a coat and a darker base gets darker and more saturated")
{
    // A share a of what arrives leaves a Lambertian base; the coat returns what it reflects.
    const Rgb color{0.9f, 0.5f, 0.0f};
    const Vec3 up{0.0f, 0.0f, 1.0f};
    const auto straight = [&](float share) {
        const test::TestedBsdf bsdf({"lambert", {color, 0, 1, 0}, 1.5f, test::coated(share, 0)});
        return bsdf.eval(up, up, TransportMode::radiance).f_cos;
    };
    const SpecularAlbedo coat(1.5f);
    const auto smooth = SpecularAlbedo::at_roughness(0.0f);
    const float r0 = coat.normal_reflectance();
    const SpecularAlbedo::Split average = coat.average(smooth);
    const float returned = r0 * average.f0 + average.f90;
    // Straight down nothing else comes between: f = T a / pi + a^2 (1 - r) / (1 - a r) L^2 / (pi
    // Lavg) with the loss L of white.
    const LayerLoss loss(coat, [&coat](float cosine, SpecularAlbedo::Roughness roughness) {
        const SpecularAlbedo::Split split = coat.directional(cosine, roughness);
        return coat.normal_reflectance() * split.f0 + split.f90;
    });
    const float lost = loss.directional(1.0f, smooth, smooth).below;
    const float lost_average = loss.average(smooth, smooth).below;
    CHECK(lost == Approx(returned - r0).epsilon(5e-3));
    const Rgb f = straight(1.0f);
    for (int channel = 0; channel < 3; ++channel) {
        const float a = color[channel];
        const float again = a * a * (1.0f - returned) / (1.0f - a * returned);
        CHECK(
            f[channel] ==
            Approx(inv_pi * ((1.0f - r0) * a + again * lost * lost / lost_average)).epsilon(2e-3));
    }
}

TEST_CASE("a coat over the facets of a normal map gives back what the map's mean loses at most")
{
    const Rgb white{1.0f};
    for (const float base : {0.3f, 0.6f, 1.0f}) {
        for (const float lean : test::leans()) {
            const Frame facet =
                Frame::from_normal({std::sin(lean) * 0.8f, std::sin(lean) * 0.6f, std::cos(lean)});
            const Vec3 even = facet.to_local({0.0f, 0.0f, 1.0f});
            const float specular = base == 1.0f ? 0.0f : 1.0f;
            const test::MappedSurface surface({"below a coat",
                                               {white, base == 1.0f ? 0.0f : 1.0f, base, specular},
                                               1.5f,
                                               test::coated(1, 0.1f, even)},
                                              lean);
            const double sum = mean_albedo(surface, 4000, 10);
            CAPTURE(base, lean, sum);
            CHECK(sum < 1.005);
            // Maps that hardly lean hardly change what an even surface reflects.
            CHECK((lean > 10.0f * test::degrees || base < 0.5f || sum > 0.985));
        }
    }
}

TEST_CASE("a coat with a normal map of its own makes no light, and loses little", "[long]")
{
    const Rgb white{1.0f};
    const std::vector<test::BsdfCase> bases{{"metal 0.3", {white, 1, 0.3f}},
                                            {"metal 0.7", {white, 1, 0.7f}},
                                            {"lambert", {white, 0, 1, 0}}};
    for (const float lean : {5.0f, 15.0f, 30.0f, 60.0f}) {
        const float angle = lean * test::degrees;
        for (const float coat : {0.0f, 0.3f, 0.8f}) {
            const auto layers = test::coated(1, coat, {std::sin(angle), 0.0f, std::cos(angle)});
            for (const test::BsdfCase& base : bases) {
                const test::TestedBsdf bsdf({base.name, base.surface, 1.5f, layers, true});
                for (const float cosine : {0.95f, 0.7f, 0.4f}) {
                    // Every azimuth, so that all leans of a real map are there.
                    double sum = 0.0;
                    constexpr int eyes = 40000;
                    test::Random random(73);
                    const float sine = std::sqrt(1.0f - cosine * cosine);
                    for (int i = 0; i < eyes; ++i) {
                        const SinCos around = sin_cos(2.0f * pi * random.next());
                        const float u_lobe = random.next();
                        const auto got =
                            bsdf.sample({sine * around.cos, sine * around.sin, cosine}, u_lobe,
                                        random.next_2d(), TransportMode::radiance);
                        sum += got ? static_cast<double>(got->weight.g) / eyes : 0.0;
                    }
                    CAPTURE(base.name, lean, coat, cosine, sum);
                    CHECK(sum < 1.005);
                    CHECK((lean > 5.0f || sum > 0.99));
                    CHECK(sum > 0.95);
                }
            }
        }
    }
}

TEST_CASE("a coat and its base with a normal map each hardly make light", "[long]")
{
    const Rgb white{1.0f};
    for (const float base : {0.3f, 0.6f, 1.0f}) {
        for (const float lean : test::leans()) {
            for (const float coat : {0.0f, lean, -lean}) {  // local to the facet
                const float metallic = base == 1.0f ? 0.0f : 1.0f;
                const test::MappedSurface surface(
                    {"below a coat",
                     {white, metallic, base, metallic},
                     1.5f,
                     test::coated(1, 0.1f, {std::sin(coat), 0.0f, std::cos(coat)}),
                     true},
                    lean);
                const double sum = mean_albedo(surface, 40000, 1);
                CAPTURE(base, lean, coat, sum);
                CHECK(sum < 1.01);
            }
        }
    }
}

}  // namespace bdpt::test::coat_furnace_test
