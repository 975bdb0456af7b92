// Light through bodies that touch, known on paper.

#include "catch.hpp"
#include "equal_means.h"
#include "scene_builder.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace bdpt::test::closed_form_contacts_test {
namespace {

constexpr double reflectance = 0.04;  // of a face of glass, at normal incidence

/// The share of parallel light that passes `faces` parallel faces, with all interreflections.
double passes(int faces)
{
    return (1.0 - reflectance) / (1.0 + (faces - 1) * reflectance);
}

RenderOptions deep(IntegratorKind integrator)
{
    RenderOptions result;
    result.integrator = integrator;
    result.transport.max_depth = 64;
    return result;
}

void check_mean(const SceneDesc& desc, const Mat4& world, double expected)
{
    SceneDesc placed = desc;
    for (InstanceDesc& instance : placed.instances) {
        instance.world_from_object = world * instance.world_from_object;
    }
    const Scene scene(std::move(placed));
    CameraDesc camera = in_parallel(camera_at({0.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 0.5f),
                                    0.2f * glm::length(Vec3(world[0])));
    camera.world_from_camera = world * camera.world_from_camera;
    for (const auto kind :
         {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt, IntegratorKind::vcm}) {
        TileMeans means(scene, camera, deep(kind));
        const MeanComparison result = compare_means(means, expected, {.detectable_bias = 0.01});
        INFO("scale " << world[0].x << ", at " << world[3].x << ", integrator "
                      << static_cast<int>(kind) << ", expected " << expected << ": "
                      << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

/// A lamp that fills the view, to which nothing returns.
SceneBuilder lamp_behind(float z)
{
    SceneBuilder builder;
    builder.quad({-9, -9, z}, {9, -9, z}, {9, 9, z}, {-9, 9, z}, emitter(Rgb(1.0f), Rgb(0.0f)));
    return builder;
}

MeshDesc pane(float z, float thickness)
{
    return box_mesh({-1.0f, -1.0f, z}, {1.0f, 1.0f, z + thickness});
}

/// Panes in front of a lamp, each `gap` before the next.
SceneDesc panes(int count, float thickness, float gap)
{
    SceneBuilder builder = lamp_behind(-1.0f);
    for (int i = 0; i < count; ++i) {
        builder.place(builder.add_mesh(pane(static_cast<float>(i) * (thickness + gap), thickness)),
                      glass(0.0f), Mat4(1.0f));
    }
    return builder.desc;
}

/// The meshes of all instances in one mesh; `welded`: without doubled vertices.
MeshDesc merged(const std::vector<MeshDesc>& meshes, bool welded)
{
    MeshDesc result;
    for (const MeshDesc& mesh : meshes) {
        for (const UVec3& triangle : mesh.triangles) {
            UVec3 corners;
            for (int k = 0; k < 3; ++k) {
                const Vec3 p = mesh.positions[triangle[k]];
                const auto known = std::find(result.positions.begin(), result.positions.end(), p);
                const auto index = static_cast<unsigned>(known - result.positions.begin());
                corners[k] = welded ? index : static_cast<unsigned>(result.positions.size());
                if (!welded || known == result.positions.end()) {
                    result.positions.push_back(p);
                }
            }
            result.triangles.push_back(corners);
        }
    }
    return result;
}

Mat4 turned()
{
    return glm::rotate(Mat4(1.0f), 0.7f, normalize(Vec3(1.0f, 2.0f, -0.5f)));
}

}  // namespace

TEST_CASE("panes with any gap, also none, pass as much as panes apart", "[closed-form][contacts]")
{
    for (const float gap : {0.0f, 1e-8f, 1e-7f, 1e-6f, 3e-6f, 1e-5f, 3e-5f, 1e-4f, 1e-3f}) {
        INFO("gap " << gap);
        check_mean(panes(2, 0.004f, gap), Mat4(1.0f), passes(4));
    }
}

TEST_CASE("touching panes may be turned, mirrored and scaled", "[closed-form][contacts]")
{
    const SceneDesc scene = panes(2, 0.1f, 0.0f);
    check_mean(scene, turned(), passes(4));
    check_mean(scene, glm::scale(turned(), Vec3(1.0f, 1.0f, -1.0f)), passes(4));
    check_mean(scene, glm::scale(turned(), Vec3(1e-3f)), passes(4));
    check_mean(scene, glm::scale(turned(), Vec3(1e3f)), passes(4));
    check_mean(scene, glm::translate(Mat4(1.0f), Vec3(100.0f, -50.0f, 30.0f)), passes(4));
}

TEST_CASE("rows of bodies that touch pass what their faces pass", "[closed-form][contacts]")
{
    for (const int count : {2, 3, 5}) {
        INFO(count << " bodies");
        check_mean(panes(count, 0.5f, 0.0f), turned(), passes(2 * count));
    }
}

TEST_CASE("stacks of clear bodies between equal lamps are invisible", "[closed-form][contacts]")
{
    // Radiance over the square of the index is constant: a boundary that is missed shows.
    std::mt19937 random(3);
    const std::array gaps{0.0f, 1e-7f, 3e-6f, 0.01f};
    const std::array thicknesses{0.004f, 0.03f, 0.2f};
    for (int count = 1; count <= 6; ++count) {
        SceneBuilder builder = lamp_behind(-1.0f);
        builder.quad({-9, 9, 5}, {9, 9, 5}, {9, -9, 5}, {-9, -9, 5}, emitter(Rgb(1.0f), Rgb(0.0f)));
        float z = 0.0f;
        for (int i = 0; i < count; ++i) {
            const float thickness = thicknesses[random() % thicknesses.size()];
            builder.place(builder.add_mesh(pane(z, thickness)), glass(0.0f), Mat4(1.0f));
            z += thickness + gaps[random() % gaps.size()];
        }
        INFO(count << " bodies");
        check_mean(builder.desc, turned(), 1.0);
    }
}

TEST_CASE("shells of one mesh touch like meshes", "[closed-form][contacts]")
{
    const std::vector<MeshDesc> parts{pane(0.0f, 0.3f), pane(0.3f, 0.3f), pane(0.6f, 0.3f)};
    for (const bool welded : {false, true}) {
        INFO("welded " << welded);
        SceneBuilder builder = lamp_behind(-1.0f);
        builder.place(builder.add_mesh(merged(parts, welded)), glass(0.0f), Mat4(1.0f));
        check_mean(builder.desc, turned(), passes(6));
    }
}

TEST_CASE("instances of one mesh touch like meshes", "[closed-form][contacts]")
{
    SceneBuilder builder = lamp_behind(-1.0f);
    const MeshId mesh = builder.add_mesh(pane(0.0f, 0.25f));
    for (const float z : {0.0f, 0.25f, 0.5f}) {
        builder.place(mesh, glass(0.0f), glm::translate(Mat4(1.0f), Vec3(0.0f, 0.0f, z)));
    }
    check_mean(builder.desc, turned(), passes(6));
}

TEST_CASE("a lamp shines through the glass that touches it", "[closed-form][contacts]")
{
    SceneBuilder builder = lamp_behind(0.0f);
    builder.place(builder.add_mesh(pane(0.0f, 0.004f)), glass(0.0f), Mat4(1.0f));
    check_mean(builder.desc, Mat4(1.0f), passes(2));
    check_mean(builder.desc, turned(), passes(2));
}

TEST_CASE("a lamp in the plane of a ceiling, or a little behind it, is in front of it",
          "[closed-form][contacts]")
{
    for (const float behind : {0.0f, 1e-6f, -1e-6f}) {
        SceneBuilder builder;
        builder.quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}, lambertian(Rgb(0.5f)));
        builder.quad({-5, -5, -behind}, {5, -5, -behind}, {5, 5, -behind}, {-5, 5, -behind},
                     emitter(Rgb(1.0f)));
        INFO("behind by " << behind);
        check_mean(builder.desc, Mat4(1.0f), 1.0);
        check_mean(builder.desc, turned(), 1.0);
    }
}

TEST_CASE("nothing shines through a wall on which a pane lies", "[closed-form][contacts]")
{
    // Paths of both sides stay on their side: the mean is that with a visible gap.
    const auto scene = [](float gap) {
        SceneBuilder builder;
        builder.quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}, lambertian(Rgb(0.5f)));
        builder.place(builder.add_mesh(box_mesh({-2.0f, -2.0f, gap}, {2.0f, 2.0f, 0.05f})),
                      glass(0.0f), Mat4(1.0f));
        builder.light(
            EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1)}}});
        return Scene(std::move(builder.desc));
    };
    const Scene apart = scene(1e-3f);
    const Scene touching = scene(0.0f);
    const CameraDesc camera =
        in_parallel(camera_at({0.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 0.5f), 0.2f);
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt}) {
        RenderOptions other = deep(kind);
        other.sampling.seed = 7;
        TileMeans a(apart, camera, deep(kind));
        TileMeans b(touching, camera, other);
        const MeanComparison result = compare_means(a, b, {.detectable_bias = 0.02});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

namespace {

/// Returns glass with an index of refraction.
MaterialDesc clear(float ior)
{
    MaterialDesc result = glass(0.0f);
    result.ior = ior;
    return result;
}

SceneDesc bonded(SceneDesc desc)
{
    desc.contacts = ContactKind::bonded;
    return desc;
}

/// The share of parallel light that passes plates with these indices, bonded to each other.
double passes(const std::vector<float>& indices)
{
    double lost = 0.0;  // 1 / T - 1 is the sum of R / (1 - R) over all boundaries
    double before = 1.0;
    const auto meet = [&](double index) {
        const double r = std::pow((index - before) / (index + before), 2.0);
        lost += r / (1.0 - r);
        before = index;
    };
    for (const float index : indices) {
        meet(static_cast<double>(index));
    }
    meet(1.0);
    return 1.0 / (1.0 + lost);
}

/// Plates of glass with these indices that touch, in front of a lamp.
SceneDesc plates(const std::vector<float>& indices)
{
    SceneBuilder builder = lamp_behind(-1.0f);
    float z = 0.0f;
    for (const float index : indices) {
        builder.place(builder.add_mesh(pane(z, 0.25f)), clear(index), Mat4(1.0f));
        z += 0.25f;
    }
    return builder.desc;
}

/// The mesh with the other diagonal in each face of a box.
MeshDesc other_diagonals(MeshDesc mesh)
{
    for (std::size_t t = 0; t + 1 < mesh.triangles.size(); t += 2) {
        UVec3& a = mesh.triangles[t];  // (0, 1, 2) and (0, 2, 3) of a quad
        UVec3& b = mesh.triangles[t + 1];
        REQUIRE(a.z == b.y);
        const std::array<unsigned, 4> quad{a.x, a.y, a.z, b.z};
        a = {quad[1], quad[2], quad[3]};
        b = {quad[1], quad[3], quad[0]};
    }
    return mesh;
}

/// Compares two scenes from below, where light falls through what is above.
void check_same_light(const SceneDesc& a, const SceneDesc& b, IntegratorKind of_a,
                      IntegratorKind of_b, const RenderOptions& options)
{
    const CameraDesc camera = camera_at({0.0f, -0.5f, 1.2f}, {0.0f, -1.0f, 0.0f}, 0.5f);
    const Scene one(a);
    const Scene other(b);
    RenderOptions for_a = options;
    RenderOptions for_b = options;
    for_a.integrator = of_a;
    for_b.integrator = of_b;
    for_b.sampling.seed = 7;
    TileMeans means_a(one, camera, for_a);
    TileMeans means_b(other, camera, for_b);
    const MeanComparison result = compare_means(means_a, means_b, {.detectable_bias = 0.05});
    INFO("integrators " << static_cast<int>(of_a) << " and " << static_cast<int>(of_b) << ": "
                        << result.text());
    CHECK(result.sharp_enough);
    CHECK(result.equal);
}

/// A floor below two panes with that gap, and a lamp above them.
SceneBuilder floor_below_panes(float gap)
{
    SceneBuilder builder;
    builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, lambertian(Rgb(0.7f)));
    builder.lamp(1.0f, 0.6f, Rgb(4.0f));
    for (const float y : {0.0f, 0.3f + gap}) {
        builder.place(builder.add_mesh(box_mesh({-1, y, -1}, {1, y + 0.3f, 1})), glass(0.3f),
                      Mat4(1.0f));
    }
    return builder;
}

}  // namespace

TEST_CASE("bonded plates have one boundary between them", "[closed-form][contacts]")
{
    const std::vector<std::vector<float>> stacks{
        {1.5f, 1.5f}, {1.5f, 1.33f}, {1.33f, 1.5f}, {1.5f, 1.33f, 1.5f}, {2.4f, 1.2f, 1.7f}};
    for (const std::vector<float>& stack : stacks) {
        INFO(stack.size() << " plates, the first with index " << stack[0]);
        check_mean(bonded(plates(stack)), turned(), passes(stack));
    }
    check_mean(bonded(plates({1.5f, 1.33f})), glm::scale(turned(), Vec3(1.0f, 1.0f, -1.0f)),
               passes(std::vector<float>{1.5f, 1.33f}));
}

TEST_CASE("bodies are bonded however their faces are divided, and as shells of one mesh",
          "[closed-form][contacts]")
{
    SceneDesc crossed = plates({1.5f, 1.33f});
    crossed.meshes.back() = other_diagonals(crossed.meshes.back());
    check_mean(bonded(crossed), turned(), passes(std::vector<float>{1.5f, 1.33f}));

    SceneBuilder builder = lamp_behind(-1.0f);
    builder.place(builder.add_mesh(merged({pane(0.0f, 0.3f), pane(0.3f, 0.3f)}, true)), glass(0.0f),
                  Mat4(1.0f));
    check_mean(bonded(builder.desc), turned(), passes(2));

    SceneBuilder row = lamp_behind(-1.0f);
    const MeshId mesh = row.add_mesh(pane(0.0f, 0.25f));
    for (const float z : {0.0f, 0.25f, 0.5f}) {
        row.place(mesh, glass(0.0f), glm::translate(Mat4(1.0f), Vec3(0.0f, 0.0f, z)));
    }
    check_mean(bonded(row.desc), turned(), passes(2));
}

TEST_CASE("bodies that touch in part keep a film of air", "[closed-form][contacts]")
{
    SceneDesc scene = panes(2, 0.25f, 0.0f);
    scene.meshes.back() = box_mesh({-1.0f, -1.0f, 0.25f}, {1.0f, 0.7f, 0.5f});
    check_mean(bonded(scene), turned(), passes(4));
}

TEST_CASE("bonded plates absorb like plates, and are invisible between equal lamps",
          "[closed-form][contacts]")
{
    SceneDesc stack = plates({1.5f, 1.33f, 2.0f});
    stack.materials[2].roughness = 0.4f;
    SceneBuilder lamps;
    lamps.desc = stack;
    lamps.quad({-9, 9, 5}, {9, 9, 5}, {9, -9, 5}, {-9, -9, 5}, emitter(Rgb(1.0f), Rgb(0.0f)));
    SceneDesc clear_stack = lamps.desc;
    clear_stack.materials[2].roughness = 0.0f;
    check_mean(bonded(clear_stack), turned(), 1.0);

    // Without reflections at the middle, light crosses both plates between the outer faces.
    SceneDesc dark = plates({1.5f, 1.5f});
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
        dark.materials[i].attenuation_color = Rgb(0.5f);
        dark.materials[i].attenuation_distance = 0.25f;
    }
    const double inside = 0.25;  // once through both
    const double through = (1.0 - reflectance) * (1.0 - reflectance) * inside /
                           (1.0 - std::pow(reflectance * inside, 2.0));
    check_mean(bonded(dark), turned(), through);
}

TEST_CASE("a rough boundary of bonded bodies of one index is no boundary",
          "[closed-form][contacts]")
{
    SceneDesc stack = plates({1.5f, 1.5f});
    stack.materials[1].roughness = 0.5f;
    stack.materials[2].roughness = 0.5f;
    SceneDesc whole = plates({1.5f});
    whole.meshes.back() = pane(0.0f, 0.5f);
    whole.materials[1].roughness = 0.5f;
    const CameraDesc camera =
        in_parallel(camera_at({0.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 0.5f), 0.2f);
    const Scene fused(bonded(stack));
    const Scene one(whole);
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt}) {
        RenderOptions other = deep(kind);
        other.sampling.seed = 7;
        TileMeans a(fused, camera, deep(kind));
        TileMeans b(one, camera, other);
        const MeanComparison result = compare_means(a, b, {.detectable_bias = 0.02});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

TEST_CASE("light falls through panes that touch as through panes apart", "[closed-form][contacts]")
{
    const SceneDesc apart = floor_below_panes(1e-3f).desc;
    const SceneDesc touching = floor_below_panes(0.0f).desc;
    RenderOptions options;
    options.transport.max_depth = 32;
    check_same_light(touching, apart, IntegratorKind::lt, IntegratorKind::mis, options);
    check_same_light(touching, apart, IntegratorKind::bdpt, IntegratorKind::mis, options);
    options.bidirectional.merge_radius = 0.0f;
    check_same_light(touching, apart, IntegratorKind::vcm, IntegratorKind::mis, options);
    options.bidirectional.light_paths = 0.5;
    options.bidirectional.connections = 2.0;
    options.bidirectional.connection_rays = 2.0;
    check_same_light(touching, apart, IntegratorKind::bdpt, IntegratorKind::mis, options);
    check_same_light(bonded(touching), bonded(touching), IntegratorKind::lt, IntegratorKind::mis,
                     options);
}

TEST_CASE("panes touch in fog, while they move, and under masks", "[closed-form][contacts]")
{
    RenderOptions options;
    options.transport.max_depth = 32;
    const auto check = [&](const auto& change) {
        SceneBuilder apart = floor_below_panes(1e-3f);
        SceneBuilder touching = floor_below_panes(0.0f);
        change(apart);
        change(touching);
        check_same_light(touching.desc, apart.desc, IntegratorKind::bdpt, IntegratorKind::mis,
                         options);
    };
    check([](SceneBuilder& s) {
        s.desc.fog = MediumDesc{.extinction = Rgb(0.3f), .albedo = Rgb(0.8f)};
    });
    check([](SceneBuilder& s) {
        for (const std::size_t pane : {std::size_t{2}, std::size_t{3}}) {
            s.desc.instances[pane].motion = {glm::translate(Mat4(1.0f), Vec3(0.3f, 0.0f, 0.1f))};
        }
    });
    check([](SceneBuilder& s) {
        // A label that lets half of the rays pass lies on the lower pane's bottom.
        MaterialDesc label = lambertian(Rgb(0.2f, 0.5f, 0.2f));
        label.alpha_mode = AlphaMode::blend;
        label.base_color.w = 0.5f;
        s.quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, label);
    });
}

}  // namespace bdpt::test::closed_form_contacts_test
