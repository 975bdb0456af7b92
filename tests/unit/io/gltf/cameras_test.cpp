#include "../gltf_fixture.h"
#include "catch.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace bdpt::io::cameras_test {
namespace {

using Json = nlohmann::json;

/// A scene of these cameras, each held by the node of its number.
GltfFixture with_cameras(const std::vector<Json>& cameras)
{
    GltfFixture fixture;
    fixture.json["cameras"] = cameras;
    fixture.json["nodes"] = Json::array();
    Json roots = Json::array();
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        fixture.json["nodes"].push_back({{"camera", i}});
        roots.push_back(i);
    }
    fixture.json["scenes"][0]["nodes"] = roots;
    return fixture;
}

/// With a field of view whose focal length is 24 mm.
Json perspective(const Json& extras)
{
    Json camera{{"type", "perspective"},
                {"perspective", {{"yfov", 2.0 * std::atan(0.5)}, {"znear", 0.1}}}};
    camera["extras"] = extras;
    return camera;
}

Json orthographic(const Json& xmag, const Json& ymag)
{
    return {{"type", "orthographic"},
            {"orthographic", {{"xmag", xmag}, {"ymag", ymag}, {"znear", 0.1}, {"zfar", 9}}}};
}

}  // namespace

TEST_CASE("cameras take the transform of their node")
{
    GltfFixture fixture = with_cameras(
        {{{"type", "perspective"},
          {"perspective", {{"yfov", 0.5}, {"aspectRatio", 1.5}, {"znear", 0.1}}}},
         {{"type", "perspective"}, {"perspective", {{"yfov", 4.0}}}, {"name", "broken"}}});
    fixture.json["nodes"][0].update({{"translation", {1, 2, 3}}, {"name", "front"}});
    const LoadedScene loaded = fixture.load();
    REQUIRE(loaded.cameras.size() == 1);
    CHECK(loaded.cameras[0].name == "front");
    CHECK(loaded.cameras[0].projection == Projection::perspective);
    CHECK(loaded.cameras[0].vertical_fov == 0.5f);
    CHECK(loaded.cameras[0].aspect_ratio == 1.5f);
    CHECK(loaded.cameras[0].lens_radius == 0.0f);
    CHECK(loaded.cameras[0].world_from_camera[3] == Vec4(1, 2, 3, 1));
    CHECK(warns(loaded.warnings, {"/cameras/1/perspective/yfov: 4", "skipped"}));

    fixture.json["cameras"][0]["name"] = "lens";
    fixture.json["cameras"][0]["perspective"].erase("aspectRatio");
    CHECK(fixture.load().cameras.at(0).name == "lens");
    CHECK_FALSE(fixture.load().cameras.at(0).aspect_ratio);
}

TEST_CASE("orthographic cameras have the extent of their file, which is half of the view")
{
    GltfFixture fixture = with_cameras({orthographic(3, 1.5)});
    fixture.json["nodes"][0]["translation"] = {0, 0, 7};
    const LoadedScene loaded = fixture.load();
    CHECK(loaded.warnings.empty());
    REQUIRE(loaded.cameras.size() == 1);
    CHECK(loaded.cameras[0].projection == Projection::orthographic);
    CHECK(loaded.cameras[0].vertical_extent == 3.0f);
    CHECK(loaded.cameras[0].aspect_ratio == 2.0f);
    CHECK(loaded.cameras[0].world_from_camera[3] == Vec4(0, 0, 7, 1));
}

TEST_CASE("an orthographic camera without an extent is skipped")
{
    const LoadedScene loaded =
        with_cameras({orthographic(1, 0), orthographic(-1, 1), orthographic(1, 3e38),
                      orthographic(1e-30, 1e30), orthographic(0, -1)})
            .load();
    CHECK(loaded.cameras.size() == 1);
    CHECK(warns(loaded.warnings, {"/cameras/0/orthographic: xmag 1, ymag 0", "and 3 more"}));
    Json half = orthographic(1, 1);
    half["orthographic"].erase("ymag");
    CHECK_THROWS_AS(with_cameras({half}).load(), Error);
}

TEST_CASE("negative extents of an orthographic camera turn its view upside down")
{
    GltfFixture fixture = with_cameras({orthographic(-3, -1.5)});
    fixture.json["nodes"][0]["translation"] = {0, 0, 7};
    const LoadedScene loaded = fixture.load({.strict = true});
    REQUIRE(loaded.cameras.size() == 1);
    const CameraDesc& camera = loaded.cameras[0];
    CHECK(camera.vertical_extent == 3.0f);
    CHECK(camera.aspect_ratio == 2.0f);
    CHECK(camera.world_from_camera ==
          Mat4(Vec4(-1, 0, 0, 0), Vec4(0, -1, 0, 0), Vec4(0, 0, 1, 0), Vec4(0, 0, 7, 1)));
    CHECK(warns(loaded.warnings, {"/cameras/0/orthographic: xmag -3, ymag -1.5", "upside down"}));
}

TEST_CASE("a single negative extent of an orthographic camera is taken as positive")
{
    const GltfFixture fixture = with_cameras({orthographic(-3, 1.5), orthographic(3, -1.5)});
    const LoadedScene loaded = fixture.load();
    REQUIRE(loaded.cameras.size() == 2);
    for (const CameraDesc& camera : loaded.cameras) {
        CHECK(camera.vertical_extent == 3.0f);
        CHECK(camera.aspect_ratio == 2.0f);
        CHECK(camera.world_from_camera == Mat4(1.0f));
    }
    CHECK(warns(loaded.warnings, {"/cameras/0/orthographic: xmag -3, ymag 1.5", "and 1 more"}));
    CHECK(fixture.error({.strict = true}).code() == ErrorCode::unsupported);
}

TEST_CASE("extras of a camera describe its lens")
{
    const auto lens = [](const Json& extras) {
        const LoadedScene loaded = with_cameras({perspective(extras)}).load();
        CHECK(loaded.warnings.empty());
        return loaded.cameras.at(0);
    };
    CHECK(lens({{"lensRadius", 0.25}, {"focusDistance", 4}}).lens_radius == 0.25f);
    CHECK(lens({{"lensRadius", 0.25}, {"focusDistance", 4}}).focus_distance == 4.0f);
    CHECK(lens({{"lensRadius", 0.25}, {"focusDistance", 3000000000}}).focus_distance == 3e9f);
    // 24 mm / (2 * 4)
    CHECK(lens({{"fStop", 4}}).lens_radius == Approx(0.003));
    CHECK(lens({{"fStop", 4}}).focus_distance == 1.0f);
    CHECK(lens({{"somethingElse", -1}}).lens_radius == 0.0f);
    CHECK(lens("text").lens_radius == 0.0f);
}

TEST_CASE("values of a lens that make no sense are ignored with a warning")
{
    const LoadedScene loaded =
        with_cameras({perspective({{"lensRadius", -1}}), perspective({{"fStop", 0}}),
                      perspective({{"focusDistance", 1e300}}), perspective({{"fStop", 1e-300}}),
                      perspective({{"lensRadius", "wide"}})})
            .load();
    REQUIRE(loaded.cameras.size() == 5);
    for (const CameraDesc& camera : loaded.cameras) {
        CHECK(camera.lens_radius == 0.0f);
        CHECK(camera.focus_distance == 1.0f);
    }
    CHECK(warns(loaded.warnings, {"/cameras/0/extras/lensRadius: -1", "and 3 more"}));
    CHECK(warns(loaded.warnings, {"/cameras/4/extras/lensRadius", "not a number"}));

    const LoadedScene both =
        with_cameras({perspective({{"lensRadius", 0.5}, {"fStop", 2}})}).load();
    CHECK(both.cameras.at(0).lens_radius == 0.5f);
    CHECK(warns(both.warnings, {"/cameras/0/extras/fStop", "ignored"}));

    Json parallel = orthographic(1, 1);
    parallel["extras"] = {{"fStop", 2}};
    const LoadedScene none = with_cameras({parallel}).load();
    CHECK(none.cameras.at(0).lens_radius == 0.0f);
    CHECK(warns(none.warnings, {"/cameras/0/extras", "orthographic"}));
}

}  // namespace bdpt::io::cameras_test
