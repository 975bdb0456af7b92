#include "material/bsdf.h"

#include "bsdf_cases.h"
#include "catch.hpp"
#include "math/rgb.h"
#include "statistics.h"

#include <cmath>

namespace bdpt::test::bsdf_test {
namespace {

Vec3 tilted_normal()
{
    return normalize(Vec3{0.4f, -0.2f, 1.0f});
}

/// A BSDF whose shading normal leans away from the geometric one.
Bsdf tilted(const PlainModel& any, Vec3 wo)
{
    return std::visit(
        [&](const auto& model) -> Bsdf {
            return {{0.0f, 0.0f, 1.0f}, Frame::from_normal(tilted_normal()), wo, model};
        },
        any);
}

bool agrees(Vec3 w)
{
    return w.z * dot(w, tilted_normal()) > 0.0f;
}

}  // namespace

TEST_CASE("opaque surfaces scatter no light from the other side of their normal")
{
    test::Random random(62);
    int opaque = 0;
    int scattered = 0;
    for (const test::BsdfCase& bsdf_case : test::bsdf_cases()) {
        const test::TestedBsdf placed(bsdf_case);
        bool transmits = false;
        for (int i = 0; i < 3000; ++i) {
            const Vec3 wo = random.direction();
            const Vec3 wi = random.direction();
            const Bsdf bsdf = placed.at({0.0f, 0.0f, 1.0f}, tilted_normal(), wo);
            CAPTURE(bsdf_case.name, wo.x, wo.y, wo.z, wi.x, wi.y, wi.z);
            if (is_black(bsdf.eval(wi, TransportMode::radiance).f_cos)) {
                continue;
            }
            transmits = transmits || wo.z * wi.z < 0.0f;
            if (const auto normal = bsdf.opaque_normal()) {
                ++scattered;
                REQUIRE(dot(*normal, wi) > 0.0f);
                REQUIRE(dot(*normal, wo) > 0.0f);
            }
        }
        const Bsdf above = placed.at({0.0f, 0.0f, 1.0f}, tilted_normal(), tilted_normal());
        if (above.opaque_normal()) {
            ++opaque;
            CHECK_FALSE(transmits);
        }
    }
    CHECK(opaque > 10);
    CHECK(scattered > 10000);
}

TEST_CASE("directions between the two normals' horizons scatter nothing but to the lens")
{
    const SpecularAlbedo albedo(1.5f);
    test::Random random(61);
    for (const test::BsdfCase& bsdf_case : test::bsdf_cases()) {
        const SpecularAlbedo own(bsdf_case.ior);
        const PlainModel model = plain_model(bsdf_case.surface, own);
        for (int i = 0; i < 3000; ++i) {
            const Vec3 wo = random.direction();
            const Vec3 wi = random.direction();
            const auto mode = i % 2 == 0 ? TransportMode::radiance : TransportMode::importance;
            const Bsdf bsdf = tilted(model, wo);
            const auto sampled = bsdf.sample(random.next(), random.next_2d(), mode);
            if (!agrees(wo)) {
                CHECK(!sampled);
            }
            if (sampled) {
                CHECK(agrees(sampled->wi));
            }
            if (!agrees(wo) || !agrees(wi)) {
                const BsdfEval value = bsdf.eval(wi, mode);
                CHECK(is_black(value.f_cos));
                CHECK(value.pdf_fwd.value == 0.0f);
                CHECK(value.pdf_rev.value == 0.0f);
            }
        }
    }
}

TEST_CASE("the lens sees surfaces whose shading normal faces away from it")
{
    const Vec3 ng{0.0f, 0.0f, 1.0f};
    const Vec3 ns = tilted_normal();
    const Frame facet = Frame::from_normal(normalize(ns + Vec3{0.3f, 0.2f, 0.0f}));
    const bool mapped = GENERATE(false, true);
    for (const test::BsdfCase& bsdf_case : test::bsdf_cases()) {
        const test::TestedBsdf placed(bsdf_case);
        const auto at = [&](Vec3 wo) {
            return mapped ? placed.mapped(ng, ns, facet, wo) : placed.at(ng, ns, wo);
        };
        CAPTURE(bsdf_case.name, mapped);
        if (!at(ns).connectible() || (bsdf_case.refracts() && bsdf_case.ior == 1.0f)) {
            continue;
        }
        test::Random random(68);
        const float alpha = bsdf_case.surface.roughness * bsdf_case.surface.roughness;
        // Tables of layers are interpolated.
        const double tolerance = bsdf_case.layers || mapped
                                     ? 0.005
                                     : 2e-4 + 1e-5 / std::max(0.001, static_cast<double>(alpha));
        int seen = 0;
        for (int i = 0; i < 80000 && seen < 200; ++i) {
            const Vec3 wo = random.direction();
            if (agrees(wo) || std::abs(wo.z) < 0.01f) {
                continue;
            }
            Bsdf bsdf = at(wo);
            bsdf.see_from_lens();
            const auto sampled =
                bsdf.sample(random.next(), random.next_2d(), TransportMode::radiance);
            if (!sampled || sampled->delta || std::abs(sampled->wi.z) < 0.01f) {
                continue;
            }
            const Vec3 wi = sampled->wi;
            CAPTURE(wo.x, wo.y, wo.z, wi.x, wi.y, wi.z);
            REQUIRE(agrees(wi));
            const BsdfEval radiance = bsdf.eval(wi, TransportMode::radiance);
            CHECK(max_component(sampled->weight) * sampled->pdf_fwd.value ==
                  Approx(max_component(radiance.f_cos)).epsilon(tolerance));
            CHECK(sampled->pdf_fwd.value == Approx(radiance.pdf_fwd.value).epsilon(tolerance));
            // Light paths evaluate the adjoint, and do not sample it.
            const BsdfEval importance = at(wi).eval_to_lens(wo);
            CHECK(max_component(importance.f_cos) / std::abs(wo.z) ==
                  Approx(max_component(radiance.f_cos) / std::abs(wi.z)).epsilon(tolerance));
            CHECK(importance.pdf_rev.value == Approx(radiance.pdf_fwd.value).epsilon(tolerance));
            CHECK(importance.pdf_fwd.value == 0.0f);
            CHECK(radiance.pdf_rev.value == 0.0f);
            CHECK(sampled->pdf_rev.value == 0.0f);
            ++seen;
        }
        CHECK(seen > 20);
    }
}

TEST_CASE("the lens sees other surfaces as light paths do")
{
    for (const test::BsdfCase& bsdf_case : test::bsdf_cases()) {
        const test::TestedBsdf placed(bsdf_case);
        test::Random random(69);
        for (int i = 0; i < 1000; ++i) {
            const Vec3 wo = random.direction();
            const Vec3 wi = random.direction();
            if (!agrees(wo) || !agrees(wi)) {
                continue;
            }
            const Bsdf bsdf = placed.at({0.0f, 0.0f, 1.0f}, tilted_normal(), wo);
            const BsdfEval value = bsdf.eval(wi, TransportMode::importance);
            const BsdfEval to_lens = bsdf.eval_to_lens(wi);
            CHECK(to_lens.f_cos == value.f_cos);
            CHECK(to_lens.pdf_fwd.value == value.pdf_fwd.value);
            CHECK(to_lens.pdf_rev.value == value.pdf_rev.value);
            Bsdf seen = bsdf;
            seen.see_from_lens();
            CHECK(seen.eval(wi, TransportMode::radiance).f_cos ==
                  bsdf.eval(wi, TransportMode::radiance).f_cos);
        }
    }
}

TEST_CASE("importance over tilted normals is the adjoint of radiance")
{
    // K*(wo, wi) / |wi.ng| = K(wi, wo) / |wo.ng|, where K holds |cos| to the shading normal: the
    // definition of the adjoint in the measure of the true surface [Veach 1997, sec. 5.3.2].
    for (const test::BsdfCase& bsdf_case : test::bsdf_cases()) {
        const SpecularAlbedo albedo(bsdf_case.ior);
        const PlainModel model = plain_model(bsdf_case.surface, albedo);
        if (!tilted(model, tilted_normal()).connectible() ||
            (bsdf_case.refracts() && bsdf_case.ior == 1.0f)) {
            continue;
        }
        test::Random random(67);
        const float alpha = bsdf_case.surface.roughness * bsdf_case.surface.roughness;
        const double tolerance = 1e-4 + 3e-6 / std::max(0.001, static_cast<double>(alpha));
        int compared = 0;
        for (int i = 0; i < 4000; ++i) {
            const Vec3 wo = random.direction();
            const Bsdf bsdf = tilted(model, wo);
            const auto sampled =
                bsdf.sample(random.next(), random.next_2d(), TransportMode::importance);
            if (!sampled || sampled->delta || std::abs(wo.z) < 0.01f ||
                std::abs(sampled->wi.z) < 0.01f) {
                continue;
            }
            const Vec3 wi = sampled->wi;
            const BsdfEval importance = bsdf.eval(wi, TransportMode::importance);
            const BsdfEval radiance = tilted(model, wi).eval(wo, TransportMode::radiance);
            CAPTURE(bsdf_case.name, wo.x, wo.y, wo.z, wi.x, wi.y, wi.z);
            CHECK(max_component(importance.f_cos) / std::abs(wi.z) ==
                  Approx(max_component(radiance.f_cos) / std::abs(wo.z)).epsilon(tolerance));
            CHECK(max_component(sampled->weight) * sampled->pdf_fwd.value ==
                  Approx(max_component(importance.f_cos)).epsilon(tolerance));
            CHECK(importance.pdf_fwd.value == Approx(radiance.pdf_rev.value).epsilon(tolerance));
            ++compared;
        }
        CAPTURE(bsdf_case.name);
        CHECK(compared > 400);
    }
}

TEST_CASE("the adjoint factor reaches smooth lobes too")
{
    const SpecularAlbedo albedo(1.5f);
    const Vec3 ns = tilted_normal();
    const Vec3 wo = normalize(Vec3{0.3f, 0.5f, 1.0f});
    const Bsdf bsdf = tilted(
        MetallicRoughness({.base_color = Rgb{1.0f}, .metallic = 1.0f, .roughness = 0.0f}, albedo),
        wo);
    const auto radiance = bsdf.sample(0.5f, {}, TransportMode::radiance);
    const auto importance = bsdf.sample(0.5f, {}, TransportMode::importance);
    REQUIRE((radiance && importance));
    const Vec3 wi = radiance->wi;
    CHECK(dot(wi, ns) == Approx(dot(wo, ns)));
    CHECK(radiance->weight.x == Approx(1.0f));
    CHECK(importance->weight.x == Approx(dot(wo, ns) * wi.z / (wo.z * dot(wi, ns))));
    CHECK(importance->weight.x != Approx(1.0f).epsilon(0.05));
}

TEST_CASE("equal normals leave importance and radiance equal to the bit")
{
    const SpecularAlbedo albedo(1.5f);
    const MetallicRoughness model({.base_color = Rgb{0.3f, 0.6f, 0.9f}, .roughness = 0.4f}, albedo);
    const Vec3 ns = tilted_normal();
    test::Random random(71);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 wo = random.direction();
        const Vec3 wi = random.direction();
        const Bsdf bsdf(ns, Frame::from_normal(ns), wo, model);
        CHECK(bsdf.eval(wi, TransportMode::radiance).f_cos ==
              bsdf.eval(wi, TransportMode::importance).f_cos);
    }
}

}  // namespace bdpt::test::bsdf_test
