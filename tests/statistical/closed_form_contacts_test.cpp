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
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt}) {
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

}  // namespace bdpt::test::closed_form_contacts_test
