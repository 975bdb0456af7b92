#include "material/mapped_bsdf.h"

#include "catch.hpp"
#include "mapped_cases.h"
#include "math/rgb.h"
#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bdpt::test::mapped_bsdf_test {
namespace {

constexpr TransportMode radiance = TransportMode::radiance;
constexpr TransportMode importance = TransportMode::importance;

Vec3 any_above(test::Random& random)
{
    const Vec3 w = random.direction();
    return {w.x, w.y, std::abs(w.z)};
}

void check_close(Rgb a, Rgb b, float tolerance, float rounding = 0.0f)
{
    const float scale = std::max(max_component(a), max_component(b));
    for (int channel = 0; channel < 3; ++channel) {
        CHECK(std::abs(a[channel] - b[channel]) <= tolerance * scale + rounding);
    }
}

/// White surfaces that lose nothing when they lie even, of one refractive index at all.
std::vector<test::BsdfCase> lossless_cases()
{
    const Rgb white{1.0f};
    return {{"lambert", {white, 0, 0.5f, 0}},
            {"smooth dielectric", {white, 0, 0}},
            {"dielectric 0.3", {white, 0, 0.3f}},
            {"dielectric 1 ior 2.4", {white, 0, 1}, 2.4f},
            {"smooth metal", {white, 1, 0}},
            {"smooth thin glass", {white, 0, 0, 1, white, 1}},
            {"smooth glass", {white, 0, 0, 1, white, 1, Body::solid}},
            {"smooth coat on smooth metal", {white, 1, 0}, 1.5f, test::coated(1, 0)}};
}

/// What the eye sees in a furnace of radiance n^2.
test::Moments furnace(const test::MappedSurface& surface, const test::BsdfCase& what, Vec3 eye,
                      int samples)
{
    const Bsdf bsdf = surface.seen_from(eye);
    const auto index = [&](Vec3 w) {
        return what.refracts() && w.z < 0.0f ? static_cast<double>(what.ior) : 1.0;
    };
    test::Random random(83);
    test::Moments sum;
    for (int i = 0; i < samples; ++i) {
        const float u_lobe = random.next();
        const auto sampled = bsdf.sample(u_lobe, random.next_2d(), radiance);
        const double ratio = sampled ? index(sampled->wi) / index(eye) : 0.0;
        sum.add(sampled ? static_cast<double>(sampled->weight.x) * ratio * ratio : 0.0);
    }
    return sum;
}

}  // namespace

TEST_CASE("a white surface with any normal map is invisible in a white furnace", "[long]")
{
    for (const test::BsdfCase& what : lossless_cases()) {
        for (const float lean : test::leans()) {
            const test::MappedSurface surface(what, lean);
            for (const Vec3 eye : test::bsdf_directions()) {
                const test::Moments sum = furnace(surface, what, eye, 60000);
                CAPTURE(what.name, lean, eye.x, eye.y, eye.z);
                CHECK(sum.standard_error() < 0.002);
                const double lost = what.layers ? 0.06 : 0.001;
                CHECK(sum.mean() < 1.001 + 4.0 * sum.standard_error());
                CHECK(sum.mean() > 1.0 - lost - 4.0 * sum.standard_error());
            }
        }
    }
}

TEST_CASE("no surface with a normal map makes light", "[long]")
{
    for (test::BsdfCase what : test::bsdf_cases()) {
        if (what.refracts() && what.ior == 1.0f) {
            continue;
        }
        what.surface.base_color = Rgb{1.0f};
        const test::MappedSurface surface(what, 70.0f * test::degrees);
        for (const Vec3 eye : test::bsdf_directions()) {
            CAPTURE(what.name, eye.z);
            const test::Moments sum = furnace(surface, what, eye, 20000);
            CHECK(sum.standard_error() < 0.02);
            CHECK(sum.mean() < 1.001 + 4.0 * sum.standard_error());
        }
    }
}

TEST_CASE("whoever chooses lights knows the side of the surface, not that of a normal map's facet")
{
    const Vec3 ng = normalize(Vec3{-0.2f, 0.1f, 1.0f});
    const test::MappedSurface surface({"lambert", {Rgb(0.5f), 0, 0.5f, 0}}, 70.0f * test::degrees,
                                      ng);
    test::Random random(88);
    int behind_facet = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 wo = random.direction();
        if (dot(wo, ng) * wo.z <= 0.0f) {
            continue;  // behind the interpolated normal nothing scatters
        }
        const auto normal = surface.seen_from(wo).opaque_normal();
        REQUIRE(normal.has_value());
        CHECK(*normal == (dot(wo, ng) < 0.0f ? -ng : ng));
        behind_facet += dot(wo, ng) * dot(wo, surface.normal()) < 0.0f ? 1 : 0;
    }
    CHECK(behind_facet > 100);
}

TEST_CASE("walks from both ends see one normal-mapped surface", "[long]")
{
    // K*(wo, wi) / |wi.ng| = K(wi, wo) / |wo.ng|: the definition of the adjoint [Veach 1997, sec.
    // 5.3.2], here with a geometric normal that differs from the interpolated one, too.
    const Vec3 ng = normalize(Vec3{-0.2f, 0.1f, 1.0f});
    for (const test::BsdfCase& what : test::bsdf_cases()) {
        if (what.refracts() && what.ior == 1.0f) {
            continue;
        }
        const float alpha = what.surface.roughness * what.surface.roughness;
        const double tolerance = 5e-4 + 5e-5 / std::max(0.001, static_cast<double>(alpha));
        for (const float lean : test::leans()) {
            const test::MappedSurface surface(what, lean, ng);
            test::Random random(89);
            int compared = 0;
            for (int i = 0; i < 1500; ++i) {
                const Vec3 wo = random.direction();
                const auto mode = i % 2 == 0 ? radiance : importance;
                const auto other_mode = i % 2 == 0 ? importance : radiance;
                const float u_lobe = random.next();
                const auto sampled = surface.seen_from(wo).sample(u_lobe, random.next_2d(), mode);
                if (!sampled) {
                    continue;
                }
                const Vec3 wi = sampled->wi;
                const float cos_o = std::abs(dot(wo, ng));
                const float cos_i = std::abs(dot(wi, ng));
                REQUIRE(dot(wi, wi) == Approx(1.0).epsilon(1e-4));
                REQUIRE(is_finite(sampled->weight));
                if (sampled->delta || std::min(cos_o, cos_i) < 0.02f ||
                    std::min(std::abs(wo.z), std::abs(wi.z)) < 0.02f) {
                    continue;
                }
                CAPTURE(what.name, lean, wo.x, wo.y, wo.z, wi.x, wi.y, wi.z);
                const BsdfEval there = surface.eval(wo, wi, mode);
                const BsdfEval back = surface.eval(wi, wo, other_mode);
                check_close(there.f_cos / cos_i, back.f_cos / cos_o, static_cast<float>(tolerance));
                CHECK(there.pdf_fwd.value == Approx(back.pdf_rev.value).epsilon(tolerance));
                CHECK(there.pdf_rev.value == Approx(back.pdf_fwd.value).epsilon(tolerance));
                CHECK(there.pdf_fwd.value > 0.0f);
                if (max_component(there.f_cos) > 0.0f) {
                    CHECK(there.pdf_rev.value > 0.0f);
                    ++compared;
                }
                CHECK(sampled->pdf_fwd.value == Approx(there.pdf_fwd.value).epsilon(tolerance));
                CHECK(sampled->pdf_rev.value == Approx(there.pdf_rev.value).epsilon(tolerance));
                // A sample's direction passes through world space, where it is exact to 6e-8; so is
                // the share of its way to the facet, however small.
                constexpr float rounding = 1e-7f;
                check_close(sampled->weight * sampled->pdf_fwd.value, there.f_cos,
                            static_cast<float>(tolerance), rounding);
            }
            CAPTURE(what.name, lean);
            CHECK((compared > 30) == surface.has_smooth_lobe());
        }
    }
}

TEST_CASE("samples from both ends of a normal-mapped surface carry the same light", "[long]")
{
    // The integral of f(eye, light) |cos eye| |cos light| h over all pairs, h being any function:
    // from the eye's side and from light's. Delta lobes take part.
    const auto h = [](Vec3 eye, Vec3 light) {
        return static_cast<double>(1.0f + 0.5f * eye.x - 0.7f * eye.y + 0.8f * light.x * eye.z +
                                   (light.z > 0.0f ? 0.0f : 2.0f));
    };
    const auto integral = [&](const test::MappedSurface& surface, TransportMode mode) {
        test::Random random(mode == radiance ? 97 : 101);
        test::Moments sum;
        for (int i = 0; i < 50000; ++i) {
            const Vec3 wo = random.direction();
            const float u_lobe = random.next();
            const auto sampled = surface.seen_from(wo).sample(u_lobe, random.next_2d(), mode);
            const double weight =
                sampled ? static_cast<double>(sampled->weight.y * std::abs(wo.z)) : 0.0;
            sum.add(!sampled           ? 0.0
                    : mode == radiance ? weight * h(wo, sampled->wi)
                                       : weight * h(sampled->wi, wo));
        }
        return sum;
    };
    for (const test::BsdfCase& what : test::bsdf_cases()) {
        for (const float lean : test::leans()) {
            const test::MappedSurface surface(what, lean);
            const test::Moments from_eye = integral(surface, radiance);
            const test::Moments from_light = integral(surface, importance);
            const double error = std::hypot(from_eye.standard_error(), from_light.standard_error());
            CAPTURE(what.name, lean, from_eye.mean(), from_light.mean(), error);
            CHECK(error < 0.02);
            CHECK(std::abs(from_eye.mean() - from_light.mean()) < 5.0 * error);
        }
    }
}

TEST_CASE("delta lobes of normal maps know the density of the way back")
{
    const Rgb white{1.0f};
    for (const test::BsdfCase& what : std::vector<test::BsdfCase>{
             {"mirror", {white, 1, 0}},
             {"glass", {white, 0, 0, 1, white, 1, Body::solid}},
             {"coated mirror", {white, 1, 0}, 1.5f, test::coated(1, 0, {0.3f, -0.2f, 1})}}) {
        const test::MappedSurface surface(what, 50.0f * test::degrees);
        test::Random random(103);
        int found = 0;
        for (int i = 0; i < 600; ++i) {
            const Vec3 eye = random.direction();
            const float u_lobe = random.next();
            const auto there = surface.seen_from(eye).sample(u_lobe, {}, radiance);
            if (!there || std::abs(there->wi.z) < 0.02f || std::abs(eye.z) < 0.02f) {
                continue;
            }
            REQUIRE(there->delta);
            const Bsdf from_light = surface.seen_from(there->wi);
            for (int k = 0; k < 400; ++k) {
                const auto back =
                    from_light.sample((static_cast<float>(k) + 0.5f) / 400.0f, {}, importance);
                if (!back || dot(back->wi - eye, back->wi - eye) > 1e-7f) {
                    continue;
                }
                CAPTURE(what.name, eye.x, eye.y, eye.z);
                CHECK(back->pdf_rev.value == Approx(there->pdf_fwd.value).epsilon(0.01));
                CHECK(back->pdf_fwd.value == Approx(there->pdf_rev.value).epsilon(0.01));
                // f cos is weight times density.
                CHECK(there->weight.x * there->pdf_fwd.value * std::abs(eye.z) ==
                      Approx(back->weight.x * back->pdf_fwd.value * std::abs(there->wi.z))
                          .epsilon(0.02));
                ++found;
                break;
            }
        }
        CAPTURE(what.name);
        CHECK(found > 250);
    }
}

TEST_CASE("no side of a normal-mapped surface is black, and nothing jumps where a facet turns away")
{
    const test::MappedSurface surface({"lambert", {Rgb{0.5f}, 0, 1, 0}}, 70.0f * test::degrees);
    const Vec3 normal = surface.normal();
    const Vec3 light = normalize(Vec3{0.3f, 0.2f, 1.0f});
    const float ahead = surface.eval(normal, light, radiance).f_cos.x;
    CHECK(ahead > 0.1f);
    for (const float slope : {-8.0f, -2.0f, -0.5f, -0.3f, -0.1f, 0.0f, 0.5f}) {
        // The eye on the side that the facet leans away from; beyond 20 degrees it sees its back.
        const Vec3 eye = normalize(Vec3{slope * 0.8f, slope * 0.6f, 1.0f});
        CHECK(surface.eval(eye, light, radiance).f_cos.x == Approx(ahead).epsilon(1e-4));
    }
    // A rough mirror just before and just after its facet turns away.
    const test::MappedSurface mirror({"metal", {Rgb{0.9f}, 1, 0.6f}}, 40.0f * test::degrees);
    const auto seen = [&](float tangent) {
        const Vec3 eye = normalize(Vec3{-tangent * 0.8f, -tangent * 0.6f, 1.0f});
        return mirror.eval(eye, light, radiance).f_cos.x;
    };
    const float edge = 1.0f / std::tan(40.0f * test::degrees);
    CHECK(seen(edge - 1e-3f) > 0.01f);
    CHECK(seen(edge - 1e-3f) == Approx(seen(edge + 1e-3f)).epsilon(0.01));
}

TEST_CASE("light that comes along the surface reaches facets once, and its own share")
{
    // Lambertian, lean a: f_cos = color / pi (light.n + color lowered.n 2 light.z), by hand.
    const float color = 0.5f;
    const test::MappedSurface surface({"lambert", {Rgb{color}, 0, 1, 0}}, 30.0f * test::degrees);
    const Vec3 n = surface.normal();
    const Vec3 light = normalize(Vec3{0.8f, 0.6f, 0.3f});
    const float z = light.z;
    const float stretch = std::sqrt(1.0f + z * z);
    const Vec3 lowered{light.x * stretch, light.y * stretch, -z * z};
    CHECK(dot(lowered, lowered) == Approx(1.0));
    REQUIRE(dot(lowered, n) > 0.1f);
    const float expected = color * inv_pi * (dot(light, n) + color * 2.0f * z * dot(lowered, n));
    CHECK(surface.eval({0, 0, 1}, light, radiance).f_cos.x == Approx(expected).epsilon(1e-4));
    // From behind the facet there is none.
    CHECK(surface.eval({0, 0, 1}, normalize(Vec3{-0.8f, -0.6f, 0.3f}), radiance).f_cos.x == 0.0f);
}

TEST_CASE("a map that does not lean leaves the model as it is")
{
    const test::BsdfCase what{"plastic", {Rgb{0.4f, 0.6f, 0.2f}, 0, 0.4f}};
    const test::TestedBsdf model(what);
    const test::MappedSurface surface(what, 0.0f);
    test::Random random(107);
    for (int i = 0; i < 500; ++i) {
        const Vec3 wo = any_above(random);
        const Vec3 wi = any_above(random);
        const BsdfEval even = model.eval(wo, wi, importance);
        const BsdfEval mapped = surface.eval(wo, wi, importance);
        check_close(mapped.f_cos, even.f_cos, 1e-4f);
        CHECK(mapped.pdf_fwd.value == Approx(even.pdf_fwd.value).epsilon(1e-4));
        CHECK(mapped.pdf_rev.value == Approx(even.pdf_rev.value).epsilon(1e-4));
    }
}

}  // namespace bdpt::test::mapped_bsdf_test
