#include "scene/contacts/contacts.h"

#include "catch.hpp"
#include "scene/checks/validate.h"
#include "scene/scene_geometry.h"
#include "scene_builder.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace bdpt::test::contacts_test {
namespace {

/// Boxes of glass with a side of 1, each `gap` above the last.
SceneBuilder pile(int count, float gap)
{
    SceneBuilder builder;
    for (int i = 0; i < count; ++i) {
        const float y = static_cast<float>(i) * (1.0f + gap);
        builder.place(builder.add_mesh(box_mesh({-1, y, -1}, {1, y + 1.0f, 1})), glass(0.0f),
                      Mat4(1.0f));
    }
    return builder;
}

/// Tests whether every vertex of `moved` is at most `most` from that of `mesh`, and one is not
/// equal.
bool is_near(const MeshDesc& moved, const MeshDesc& mesh, float most)
{
    float farthest = 0.0f;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        farthest = std::max(farthest, distance(moved.positions[i], mesh.positions[i]));
    }
    return farthest > 0.0f && farthest < most;
}

}  // namespace

TEST_CASE("faces of bodies move where they touch, and nowhere else", "[contacts]")
{
    const SceneGeometry apart(pile(3, 0.001f).desc);
    CHECK(apart.contacts.meshes.empty());
    CHECK(apart.contacts.pairs == 0);

    const SceneDesc desc = pile(3, 0.0f).desc;
    const SceneGeometry touching(desc);
    CHECK(touching.contacts.pairs == 2);
    CHECK(touching.contacts.thin.empty());
    REQUIRE(touching.contacts.meshes.size() == 3);
    for (const auto& [mesh, moved] : touching.contacts.meshes) {
        CHECK(is_near(moved, desc.meshes[mesh], 1e-4f));
        CHECK(&touching.placed[mesh].mesh() == &moved);
    }
    // The lowest keeps its bottom.
    for (const Vec3& p : touching.contacts.meshes.at(0).positions) {
        CHECK((p.y == 0.0f || p.y < 1.0f));
    }
}

TEST_CASE("bonded bodies keep one of two faces that coincide", "[contacts]")
{
    SceneDesc desc = pile(3, 0.0f).desc;
    desc.contacts = ContactKind::bonded;
    const SceneGeometry geometry(desc);
    const Contacts& contacts = geometry.contacts;
    CHECK(contacts.pairs == 2);
    CHECK(contacts.bonded_pairs == 2);
    CHECK(contacts.meshes.empty());
    REQUIRE(contacts.bonds.size() == 4);
    for (const Bond& bond : contacts.bonds) {
        CHECK(bond.partner == bond.instance + 1);
    }
    CHECK_FALSE(contacts.open.contains(0));
    CHECK(contacts.open.contains(1));
    CHECK(contacts.open.contains(2));

    // Bodies that move, shine, or have alpha, are not bonded.
    const auto air = [&desc](const auto& change) {
        SceneDesc other = desc;
        change(other);
        const SceneGeometry found(other);
        return found.contacts.bonded_pairs == 0 && found.contacts.pairs == 2;
    };
    CHECK_FALSE(air([](SceneDesc&) {}));
    CHECK(air([](SceneDesc& d) { d.contacts = ContactKind::air; }));
    // By default, bodies are if their indices differ.
    CHECK(air([](SceneDesc& d) { d.contacts = ContactKind::automatic; }));
    CHECK_FALSE(air([](SceneDesc& d) {
        d.contacts = ContactKind::automatic;
        d.materials[1].ior = 1.33f;
    }));
    CHECK(air([](SceneDesc& d) { d.instances[1].motion = {Mat4(2.0f)}; }));
    CHECK(air([](SceneDesc& d) { d.materials[1].emission = Rgb(1.0f); }));
    CHECK(air([](SceneDesc& d) { d.materials[1].alpha_mode = AlphaMode::mask; }));
}

TEST_CASE("opaque things stay where they touch", "[contacts]")
{
    SceneBuilder builder;
    for (const float y : {0.0f, 1.0f}) {
        builder.place(builder.add_mesh(box_mesh({-1, y, -1}, {1, y + 1.0f, 1})),
                      lambertian(Rgb(0.5f)), Mat4(1.0f));
    }
    CHECK(SceneGeometry(builder.desc).contacts.pairs == 0);
    builder.place(builder.add_mesh(box_mesh({-1, 2, -1}, {1, 3, 1})), glass(0.0f), Mat4(1.0f));
    const SceneGeometry geometry(builder.desc);
    CHECK(geometry.contacts.pairs == 1);
    CHECK(geometry.contacts.meshes.size() == 1);
    CHECK(geometry.contacts.meshes.contains(2));
}

TEST_CASE("materials decide what a contact is", "[contacts]")
{
    SharedSceneDesc desc(pile(2, 0.0f).desc);
    const SceneGeometry geometry(desc);
    CHECK(geometry.fits(desc));
    std::vector<MaterialDesc> materials = desc.materials;
    for (MaterialDesc& material : materials) {
        material = lambertian(Rgb(0.5f));
    }
    desc.materials = materials;
    CHECK_FALSE(geometry.fits(desc));

    // Where nothing touches, materials do not matter.
    SharedSceneDesc apart(pile(2, 0.01f).desc);
    const SceneGeometry other(apart);
    apart.materials = desc.materials;
    CHECK(other.fits(apart));
}

TEST_CASE("a body that is thinner than points are known is told", "[contacts]")
{
    const auto warnings = [](float thickness) {
        SceneBuilder builder;
        builder.place(builder.add_mesh(box_mesh({-1, -1, 0}, {1, 1, thickness})), glass(0.0f),
                      glm::translate(Mat4(1.0f), Vec3(1e4f, 0.0f, 1e4f)));
        builder.desc.instances.back().name = "pane";
        return precision_warnings(builder.desc, SceneGeometry(builder.desc));
    };
    CHECK(warnings(0.1f).empty());
    const auto told = warnings(0.004f);
    REQUIRE(told.size() == 1);
    CHECK(told[0].find("instance 0 \"pane\": is too thin") == 0);
}

TEST_CASE("a face moves less than its body is thick", "[contacts]")
{
    SceneBuilder builder;
    const float thickness = 4e-6f;  // a few roundings at a distance of 1 m
    for (const float z : {1.0f, 1.0f + thickness}) {
        builder.place(builder.add_mesh(box_mesh({-1, -1, z}, {1, 1, z + thickness})), glass(0.0f),
                      Mat4(1.0f));
    }
    const SceneGeometry geometry(builder.desc);
    CHECK_FALSE(geometry.contacts.thin.empty());
    for (const auto& [mesh, moved] : geometry.contacts.meshes) {
        CHECK(is_near(moved, builder.desc.meshes[mesh], 0.5f * thickness));
    }
}

TEST_CASE("any number of faces at one place is separated in bounded time", "[contacts]")
{
    SECTION("coincident sheets of glass")
    {
        MeshDesc sheets;
        sheets.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        sheets.triangles.assign(100'000, UVec3(0, 1, 2));
        SceneBuilder builder;
        builder.place(builder.add_mesh(std::move(sheets)), glass(0.0f), Mat4(1.0f));
        const SceneGeometry geometry(builder.desc);
        CHECK(geometry.placed.size() == 1);
    }
    SECTION("a pile of many panes")
    {
        CHECK(SceneGeometry(pile(10'000, 0.0f).desc).contacts.pairs == 9'999);
    }
    SECTION("coordinates beyond all scenes")
    {
        SceneBuilder builder;
        for (int i = 0; i < 2; ++i) {
            builder.place(builder.add_mesh(box_mesh({-1, -1, 0}, {1, 1, 1})), glass(0.0f),
                          glm::translate(Mat4(1.0f), Vec3(1e15f)));
        }
        const SceneGeometry geometry(builder.desc);
        for (const auto& [mesh, moved] : geometry.contacts.meshes) {
            for (const Vec3& p : moved.positions) {
                CHECK(std::isfinite(p.x + p.y + p.z));
            }
        }
    }
}

}  // namespace bdpt::test::contacts_test
