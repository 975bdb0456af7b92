#pragma once

#include "layered_cases.h"

#include <string>
#include <utility>
#include <vector>

namespace bdpt::test {

/// Lambertian, dielectric, metal, glass, and mixes of them; smooth, rough, and nearly smooth.
[[nodiscard]] inline std::vector<BsdfCase> bsdf_cases()
{
    const Rgb blue{0.2f, 0.5f, 0.8f};
    const Rgb white{1.0f};
    constexpr Body thin = Body::thin_walled;
    constexpr Body solid = Body::solid;
    // base, metallic, roughness, specular, specular colour, transmission, body
    std::vector<BsdfCase> cases{
        {"lambert", {blue, 0, 1, 0, white, 0, thin}},
        {"dielectric smooth", {blue, 0, 0, 1, white, 0, thin}},
        {"dielectric 0.3", {blue, 0, 0.3f, 1, white, 0, thin}},
        {"dielectric 0.6 half specular", {blue, 0, 0.6f, 0.5f, Rgb{1, 0.5f, 0.2f}, 0, thin}},
        {"dielectric 1 ior 2.4", {blue, 0, 1, 1, white, 0, thin}, 2.4f},
        {"dielectric 0.5 ior 1", {blue, 0, 0.5f, 1, white, 0, thin}, 1.0f},
        {"black dielectric 0.2", {Rgb{0.0f}, 0, 0.2f, 1, white, 0, thin}},
        {"black dielectric 0.8 like gold", {Rgb{0.0f}, 0, 0.8f, 1, Rgb{25, 19, 8}, 0, thin}},
        {"dielectric 0.6 half specular ior 3", {blue, 0, 0.6f, 0.5f, white, 0, thin}, 3.0f},
        {"metal 0.033", {blue, 1, 0.033f, 1, white, 0, thin}},
        {"metal 0.05", {blue, 1, 0.05f, 1, white, 0, thin}},
        {"metal 0.3", {blue, 1, 0.3f, 1, white, 0, thin}},
        {"metal 1", {blue, 1, 1, 1, white, 0, thin}},
        {"half metal 0.4", {blue, 0.5f, 0.4f, 1, white, 0, thin}},
        {"thin glass smooth", {white, 0, 0, 1, white, 1, thin}},
        {"thin glass 0.3", {blue, 0, 0.3f, 1, white, 1, thin}},
        {"solid glass smooth", {blue, 0, 0, 1, white, 1, solid}},
        {"solid glass 0.05", {white, 0, 0.05f, 1, white, 1, solid}},
        {"solid glass 0.3", {blue, 0, 0.3f, 1, white, 1, solid}},
        {"solid glass 0.8 ior 1.33", {white, 0, 0.8f, 1, white, 1, solid}, 1.33f},
        {"solid glass 0.5 ior 2.4", {white, 0, 0.5f, 1, white, 1, solid}, 2.4f},
        {"solid glass 0.5 no specular", {white, 0, 0.5f, 0, white, 1, solid}},
        {"solid 0.5 ior 1", {blue, 0, 0.5f, 1, white, 1, solid}, 1.0f},
        {"solid half metal 0.4 ior 1", {blue, 0.5f, 0.4f, 1, white, 1, solid}, 1.0f},
        {"thin half transmission 0.4", {blue, 0, 0.4f, 1, white, 0.5f, thin}},
        {"solid half transmission 0.4", {blue, 0, 0.4f, 1, white, 0.5f, solid}},
        {"solid half transmission smooth", {blue, 0, 0, 1, white, 0.5f, solid}},
        {"all at once", {blue, 0.3f, 0.5f, 0.7f, Rgb{0.9f, 1, 0.8f}, 0.6f, solid}, 1.4f},
    };
    for (BsdfCase& layered : layered_cases()) {
        cases.push_back(std::move(layered));
    }
    return cases;
}

/// Unit directions from steep to grazing, above and below the surface.
[[nodiscard]] inline std::vector<Vec3> bsdf_directions()
{
    return {normalize(Vec3{0.05f, -0.1f, 1.0f}), normalize(Vec3{1.0f, 0.3f, 1.0f}),
            normalize(Vec3{-0.4f, 1.0f, 0.15f}), normalize(Vec3{0.1f, 0.2f, -1.0f}),
            normalize(Vec3{-0.7f, 0.2f, -1.0f}), normalize(Vec3{1.0f, 0.5f, -0.5f})};
}

}  // namespace bdpt::test
