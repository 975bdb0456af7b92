#include "material/models/layered.h"

#include "bsdf_cases.h"
#include "catch.hpp"
#include "material/models/recent_models.h"
#include "math/rgb.h"
#include "statistics.h"

#include <cmath>
#include <optional>

namespace bdpt::test::layered_bsdf_test {
namespace {

/// The delta sample of `wo` that leads to `wi`, by whichever number chooses it.
std::optional<BsdfSample> towards(const test::TestedBsdf& bsdf, Vec3 wo, Vec3 wi,
                                  TransportMode mode)
{
    constexpr int numbers = 400;
    for (int i = 0; i < numbers; ++i) {
        const float u_lobe = (static_cast<float>(i) + 0.5f) / numbers;
        const auto sampled = bsdf.sample(wo, u_lobe, {0.5f, 0.5f}, mode);
        if (sampled && sampled->delta && dot(sampled->wi, wi) > 0.99999f) {
            return sampled;
        }
    }
    return std::nullopt;
}

}  // namespace

TEST_CASE("delta lobes below and above layers know the density of the way back")
{
    int found = 0;
    for (const test::BsdfCase& bsdf_case : test::layered_cases()) {
        const test::TestedBsdf bsdf(bsdf_case);
        test::Random random(61);
        for (int i = 0; i < 300; ++i) {
            const Vec3 wo = random.direction();
            const auto there =
                bsdf.sample(wo, random.next(), random.next_2d(), TransportMode::radiance);
            if (!there || !there->delta || std::abs(there->wi.z) < 0.05f ||
                std::abs(wo.z) < 0.05f) {
                continue;
            }
            CAPTURE(bsdf_case.name, wo.x, wo.y, wo.z, there->wi.x, there->wi.y, there->wi.z);
            const auto back = towards(bsdf, there->wi, wo, TransportMode::importance);
            if (!back) {
                // A smooth coat and a smooth base share a direction: one of the two was found.
                CHECK(there->pdf_rev.value < 0.02f);
                continue;
            }
            // Two lobes may lead to one direction; then densities tell which one it was.
            if (there->pdf_fwd.value != Approx(back->pdf_rev.value).epsilon(1e-3)) {
                CHECK((bsdf_case.name.find("smooth coat on a mirror") == 0 ||
                       bsdf_case.name.find("smooth coat on glass") == 0 ||
                       bsdf_case.name == "all layers"));
                continue;
            }
            CHECK(there->pdf_rev.value == Approx(back->pdf_fwd.value).epsilon(1e-3));
            // Weight times density is f cos; f is the same both ways.
            const float f = max_component(there->weight) * there->pdf_fwd.value / there->wi.z;
            const float f_back = max_component(back->weight) * back->pdf_fwd.value / wo.z;
            CHECK(std::abs(f_back) == Approx(std::abs(f)).epsilon(2e-3));
            ++found;
        }
    }
    CHECK(found > 500);
}

TEST_CASE("layers are not seen from inside a solid body")
{
    const Rgb white{1.0f};
    const GltfParameters glass{white, 0, 0.4f, 1, white, 1, Body::solid};
    const test::TestedBsdf bare({"bare", glass});
    const test::TestedBsdf coated(
        {"coated", glass, 1.5f, test::sheen(white, 0.5f, test::coated(1, 0.3f))});
    const Vec3 wo = normalize(Vec3{0.3f, 0.1f, -0.9f});
    const Vec3 wi = normalize(Vec3{-0.4f, 0.2f, -0.8f});
    const BsdfEval seen = coated.eval(wo, wi, TransportMode::radiance);
    CHECK(max_component(glm::abs(seen.f_cos - bare.eval(wo, wi, TransportMode::radiance).f_cos)) <
          1e-6f);
    // What comes out has gone through them.
    const Vec3 out{wi.x, wi.y, -wi.z};
    CHECK(coated.eval(wo, out, TransportMode::radiance).f_cos.g <
          0.98f * bare.eval(wo, out, TransportMode::radiance).f_cos.g);
}

TEST_CASE("what comes through diffusely has the values worked out by hand")
{
    const test::TestedBsdf bsdf({"leaf",
                                 {Rgb{0.2f, 0.5f, 0.8f}, 0, 1, 0},
                                 1.5f,
                                 test::translucent(0.25f, {0.9f, 0.6f, 0.3f})});
    const Vec3 up{0.0f, 0.0f, 1.0f};
    const Vec3 down = normalize(Vec3{0.6f, 0.0f, -0.8f});
    const BsdfEval through = bsdf.eval(up, down, TransportMode::radiance);
    CHECK(through.f_cos.r == Approx(0.25f * 0.9f * 0.8f * 0.31831f).epsilon(1e-3));
    CHECK(through.f_cos.b == Approx(0.25f * 0.3f * 0.8f * 0.31831f).epsilon(1e-3));
    const BsdfEval back = bsdf.eval(up, -down, TransportMode::radiance);
    CHECK(back.f_cos.g == Approx(0.75f * 0.5f * 0.8f * 0.31831f).epsilon(1e-3));
}

TEST_CASE("a thread keeps the layered models that it made last")
{
    const LayeredConstants constants;
    const LayeredConstants of_other_scene;
    RecentModels<int> recent;
    int made = 0;
    const auto model = [&](const LayeredConstants& of, float roughness, Vec3 macro) {
        const LayeredParameters parameters({.roughness = roughness}, of);
        return recent.get(parameters, Direction16(macro), [&] { return ++made; });
    };
    const Vec3 even(0.0f, 0.0f, 1.0f);
    CHECK(model(constants, 0.5f, even) == 1);
    CHECK(model(constants, 0.5f, even) == 1);
    CHECK(model(constants, 0.6f, even) == 2);
    CHECK(model(constants, 0.5f, {0.6f, 0.0f, 0.8f}) == 3);
    CHECK(model(of_other_scene, 0.5f, even) == 4);
    CHECK(model(constants, 0.5f, even) == 1);
    CHECK(model(constants, 0.7f, even) == 5);  // in place of the oldest
    CHECK(model(constants, 0.6f, even) == 2);
    CHECK(model(constants, 0.5f, even) == 6);
}

}  // namespace bdpt::test::layered_bsdf_test
