#include "../gltf_fixture.h"
#include "catch.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace bdpt::test::light_profiles_test {
using namespace bdpt::io;

namespace {

/// What an IES file says, and how.
struct IesText {
    std::string version = "IESNA:LM-63-2002";
    std::string tilt = "TILT=NONE";
    std::string multiplier = "1";
    std::string type = "1";
    std::string factors = "1 1 60";
    std::string vertical = "0 90 180";
    std::string horizontal = "0";
    std::string candelas = "100 50 0";
    std::string end = "\r\n";

    [[nodiscard]] std::string text() const
    {
        const auto count = [](const std::string& numbers) {
            return std::to_string(
                1 + std::count_if(numbers.begin(), numbers.end(), [](char c) { return c == ' '; }));
        };
        return version + end + "[TEST] none" + end + "[MANUFAC] of our own" + end + tilt + end +
               "1 -1 " + multiplier + " " + count(vertical) + " " + count(horizontal) + " " + type +
               " 2 0 0 0" + end + factors + end + vertical + end + horizontal + end + candelas +
               end;
    }
};

nlohmann::json as_data(const std::string& text)
{
    return {{"uri", "data:application/x-ies-lm-63;base64," + base64(text)}};
}

/// A node at (1, 2, 3) with a light by profile 0 of these.
GltfFixture with_profiles(const nlohmann::json& profiles)
{
    GltfFixture fixture;
    fixture.json["extensionsUsed"] = {"EXT_lights_ies"};
    fixture.json["extensions"]["EXT_lights_ies"]["lights"] = profiles;
    fixture.json["nodes"] = {{{"name", "lantern"},
                              {"translation", {1, 2, 3}},
                              {"extensions", {{"EXT_lights_ies", {{"light", 0}}}}}}};
    fixture.json["scenes"][0]["nodes"] = {0};
    return fixture;
}

GltfFixture with_profile(const std::string& text)
{
    return with_profiles(nlohmann::json::array({as_data(text)}));
}

nlohmann::json& node_light(GltfFixture& fixture)
{
    return fixture.json["nodes"][0]["extensions"]["EXT_lights_ies"];
}

ProfileLightDesc only_light(const LoadedScene& loaded)
{
    REQUIRE(loaded.scene.lights.size() == 1);
    REQUIRE(std::holds_alternative<ProfileLightDesc>(loaded.scene.lights[0]));
    return std::get<ProfileLightDesc>(loaded.scene.lights[0]);
}

/// The intensity at the point of the grid that lies in this direction of the world; none: there is
/// no such point. All points in this direction must agree.
std::optional<float> towards(const LoadedScene& loaded, Vec3 direction)
{
    const ProfileLightDesc light = only_light(loaded);
    const LightProfile& grid = loaded.scene.profiles.at(static_cast<std::size_t>(light.profile));
    std::optional<float> found;
    for (std::size_t i = 0; i < grid.intensities.size(); ++i) {
        const auto polar = static_cast<double>(grid.polar_angles[i % grid.polar_angles.size()]);
        const auto azimuth = static_cast<double>(grid.azimuths[i / grid.polar_angles.size()]);
        const Vec3 local(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                         -std::cos(polar));
        if (glm::distance(light.world_from_light * local, glm::normalize(direction)) > 1e-4f) {
            continue;
        }
        REQUIRE((!found || *found == grid.intensities[i]));
        found = grid.intensities[i];
    }
    return found;
}

}  // namespace

TEST_CASE("a light profile points down -z of its node")
{
    const LoadedScene loaded = with_profile(IesText{}.text()).load();
    const ProfileLightDesc light = only_light(loaded);
    CHECK(light.name == "lantern");
    CHECK(light.position == Vec3(1, 2, 3));
    CHECK(light.scale == Rgb(1));
    CHECK(light.world_from_light == Mat3(1));
    const LightProfile& profile = loaded.scene.profiles.at(0);
    CHECK(profile.polar_angles.size() == 3);
    CHECK(profile.polar_angles[2] == Approx(3.14159265));
    CHECK(profile.azimuths == std::vector<float>{0.0f});
    CHECK(profile.intensities == std::vector<float>{100, 50, 0});
    CHECK(towards(loaded, {0, 0, -1}) == 100.0f);
    CHECK(loaded.warnings.empty());
}

TEST_CASE("horizontal angles of type C turn counter-clockwise from +x, seen from above")
{
    IesText ies;
    ies.horizontal = "0 90 180 270 360";
    ies.candelas = "9 1 8\n 9 2 8\n 9 3 8\n 9,4,8, 9 1 8";
    const LoadedScene loaded = with_profile(ies.text()).load();
    CHECK(towards(loaded, {0, 0, -1}) == 9.0f);
    CHECK(towards(loaded, {1, 0, 0}) == 1.0f);
    CHECK(towards(loaded, {0, 1, 0}) == 2.0f);
    CHECK(towards(loaded, {-1, 0, 0}) == 3.0f);
    CHECK(towards(loaded, {0, -1, 0}) == 4.0f);
    CHECK(towards(loaded, {0, 0, 1}) == 8.0f);
    CHECK(loaded.scene.profiles[0].azimuths.back() == Approx(6.2831853));
}

TEST_CASE("what symmetry leaves out of a light profile is there")
{
    IesText ies;
    ies.vertical = "0 90";
    SECTION("of all quadrants")
    {
        ies.horizontal = "0 45 90";
        ies.candelas = "9 1 9 2 9 3";
        const LoadedScene loaded = with_profile(ies.text()).load();
        for (const float x : {-1.0f, 1.0f}) {
            CHECK(towards(loaded, {x, 0, 0}) == 1.0f);
            CHECK(towards(loaded, {0, x, 0}) == 3.0f);
            CHECK(towards(loaded, {x, 1, 0}) == 2.0f);
            CHECK(towards(loaded, {x, -1, 0}) == 2.0f);
        }
        CHECK(loaded.scene.profiles[0].azimuths.size() == 9);
        CHECK(loaded.warnings.empty());
    }
    SECTION("about the plane of 0 and 180 degrees")
    {
        ies.horizontal = "0 90 180";
        ies.candelas = "9 1 9 2 9 3";
        const LoadedScene loaded = with_profile(ies.text()).load();
        CHECK(towards(loaded, {1, 0, 0}) == 1.0f);
        CHECK(towards(loaded, {0, 1, 0}) == 2.0f);
        CHECK(towards(loaded, {0, -1, 0}) == 2.0f);
        CHECK(towards(loaded, {-1, 0, 0}) == 3.0f);
    }
    SECTION("about the plane of 90 and 270 degrees")
    {
        ies.horizontal = "90 180 270";
        ies.candelas = "9 1 9 2 9 3";
        const LoadedScene loaded = with_profile(ies.text()).load();
        CHECK(towards(loaded, {0, 1, 0}) == 1.0f);
        CHECK(towards(loaded, {-1, 0, 0}) == 2.0f);
        CHECK(towards(loaded, {1, 0, 0}) == 2.0f);
        CHECK(towards(loaded, {0, -1, 0}) == 3.0f);
    }
    SECTION("of the last step round")
    {
        ies.horizontal = "0 90 180 270";
        ies.candelas = "9 1 9 2 9 3 9 4";
        const LoadedScene loaded = with_profile(ies.text()).load();
        CHECK(loaded.scene.profiles[0].azimuths.back() == Approx(6.2831853));
        CHECK(towards(loaded, {1, 0, 0}) == 1.0f);
        CHECK(towards(loaded, {0, -1, 0}) == 4.0f);
        CHECK(warns(loaded.warnings, {"lights/0: the last is 270", "closed"}));
    }
}

TEST_CASE("planes of type B share a horizontal axis, those of type A a vertical one")
{
    IesText ies;
    ies.vertical = "-90 -30 0 90";
    ies.horizontal = "-90 0 60 90";
    ies.candelas = "1 1 1 1  4 5 6 7  8 9 10 11  2 2 2 2";
    ies.type = "2";
    const float sine = std::sqrt(0.75f);
    const LoadedScene b = with_profile(ies.text()).load();
    CHECK(towards(b, {0, 1, 0}) == 1.0f);
    CHECK(towards(b, {0, -1, 0}) == 2.0f);
    CHECK(towards(b, {0, 0, -1}) == 6.0f);
    CHECK(towards(b, {1, 0, 0}) == 7.0f);
    CHECK(towards(b, {-1, 0, 0}) == 4.0f);
    CHECK(towards(b, {-0.5f, 0, -sine}) == 5.0f);
    CHECK(towards(b, {0, -sine, -0.5f}) == 10.0f);
    CHECK(towards(b, {0.5f, -sine, 0}) == 11.0f);
    CHECK_FALSE(towards(b, {0, 0, 1}));

    ies.candelas = "1 3 4 2  1 5 6 2  1 9 10 2  1 13 14 2";
    ies.type = "3";
    const LoadedScene a = with_profile(ies.text()).load();
    CHECK(towards(a, {-1, 0, 0}) == 1.0f);
    CHECK(towards(a, {1, 0, 0}) == 2.0f);
    CHECK(towards(a, {0, 0, -1}) == 6.0f);
    CHECK(towards(a, {0, 1, 0}) == 4.0f);
    CHECK(towards(a, {0, -1, 0}) == 14.0f);
    CHECK(towards(a, {-0.5f, 0, -sine}) == 5.0f);
    CHECK(towards(a, {0, -sine, -0.5f}) == 10.0f);
    CHECK(towards(a, {-0.5f, -sine * sine, -0.5f * sine}) == 9.0f);

    // Halves are mirrored.
    ies.vertical = "0 90";
    ies.horizontal = "0 60 90";
    ies.candelas = "6 7 10 11 2 2";
    ies.type = "2";
    const LoadedScene half = with_profile(ies.text()).load();
    CHECK(towards(half, {0, 1, 0}) == 2.0f);
    CHECK(towards(half, {-1, 0, 0}) == 7.0f);
    CHECK(towards(half, {0, sine, -0.5f}) == 10.0f);
    CHECK(towards(half, {-0.5f, -sine, 0}) == 11.0f);
}

TEST_CASE("the node turns a light profile, and does not make it brighter")
{
    IesText ies;
    ies.horizontal = "0 90 180 270 360";
    ies.candelas = "9 1 8 9 2 8 9 3 8 9 4 8 9 1 8";
    GltfFixture fixture = with_profile(ies.text());
    fixture.json["nodes"][0]["rotation"] = {0, -0.70710678118654752, 0, 0.70710678118654752};
    fixture.json["nodes"][0]["scale"] = {5, 5, 5};
    const LoadedScene turned = fixture.load();
    CHECK(towards(turned, {1, 0, 0}) == 9.0f);
    CHECK(towards(turned, {0, 0, 1}) == 1.0f);
    CHECK(towards(turned, {0, 1, 0}) == 2.0f);
    CHECK(towards(turned, {0, 0, -1}) == 3.0f);

    fixture.json["nodes"][0].erase("rotation");
    fixture.json["nodes"][0]["scale"] = {2, -3, 1};
    const LoadedScene mirrored = fixture.load();
    CHECK(towards(mirrored, {0, 0, -1}) == 9.0f);
    CHECK(towards(mirrored, {1, 0, 0}) == 1.0f);
    CHECK(towards(mirrored, {0, -1, 0}) == 2.0f);

    fixture.json["nodes"][0]["scale"] = {0, 0, 0};
    CHECK(towards(fixture.load(), {0, 0, -1}) == 9.0f);
}

TEST_CASE("colour and multiplier scale a light profile")
{
    GltfFixture fixture = with_profile(IesText{}.text());
    node_light(fixture)["multiplier"] = 5000000000;
    node_light(fixture)["color"] = {1, 0.5, 0};
    CHECK(only_light(fixture.load()).scale == Rgb(5e9f, 2.5e9f, 0));
    node_light(fixture)["multiplier"] = -1;
    node_light(fixture)["color"] = {1, 2, -1};
    const LoadedScene odd = fixture.load();
    CHECK(only_light(odd).scale == Rgb(0));
    CHECK(warns(odd.warnings, {"/nodes/0/extensions/EXT_lights_ies/multiplier: -1", "2 more"}));
}

TEST_CASE("the factors of a light profile depend on its version")
{
    IesText ies;
    ies.multiplier = "2";
    ies.factors = "0.5 0.25 60";
    const auto nadir = [&ies](const std::string& version) {
        ies.version = version;
        return with_profile(ies.text()).load();
    };
    CHECK(nadir("IESNA:LM-63-2002").scene.profiles.at(0).intensities[0] == 100.0f);
    CHECK(nadir("IES:LM-63-2019").scene.profiles.at(0).intensities[0] == 100.0f);
    CHECK(nadir("IESNA:LM-63-1995").scene.profiles.at(0).intensities[0] == 25.0f);
    CHECK(nadir("IESNA:LM-63-1995").warnings.empty());
    const LoadedScene older = nadir("IESNA91");
    CHECK(older.scene.profiles.at(0).intensities[0] == 25.0f);
    CHECK(warns(older.warnings, {"lights/0: \"IESNA91\"", "LM-63-95"}));
}

TEST_CASE("what a light profile need not have is skipped")
{
    IesText ies;
    ies.tilt = "TILT=INCLUDE\n1\n3\n0 45 90\n1.0 0.9 0.8";
    const LoadedScene tilted = with_profile(ies.text()).load();
    CHECK(tilted.scene.profiles.at(0).intensities == std::vector<float>{100, 50, 0});
    CHECK(warns(tilted.warnings, {"TILT", "lights/0: \"INCLUDE\""}));
    ies.tilt = "TILT=lamp.tlt";
    const LoadedScene file = with_profile(ies.text()).load();
    CHECK(file.scene.profiles.at(0).intensities == std::vector<float>{100, 50, 0});
    CHECK(warns(file.warnings, {"TILT", "\"LAMP.TLT\""}));

    IesText lean;
    lean.version = "\xef\xbb\xbfIES:LM-63-2019 ";
    lean.tilt = "  Tilt = none";
    lean.candelas = "1e2,+50 \t\v -3 end";
    lean.end = "\n";
    const LoadedScene loaded = with_profile(lean.text()).load();
    CHECK(loaded.scene.profiles.at(0).intensities == std::vector<float>{100, 50, 0});
    CHECK(loaded.warnings.size() == 2);
    CHECK(warns(loaded.warnings, {"negative intensity", "-3 cd"}));
    CHECK(warns(loaded.warnings, {"after the intensities"}));
}

TEST_CASE("light profiles that are wrong are refused by line and value")
{
    const auto message = [](const IesText& ies) {
        const Error error = with_profile(ies.text()).error();
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(contains(error.what(), "/extensions/EXT_lights_ies/lights/0: "));
        return std::string(error.what());
    };
    CHECK(contains(message({.tilt = "none"}), "no line that begins with TILT="));
    CHECK(contains(message({.multiplier = "-2"}), "line 5: the candela multiplier is -2"));
    CHECK(contains(message({.multiplier = "many"}),
                   "line 5: the candela multiplier is \"many\", not a finite number"));
    CHECK(contains(message({.multiplier = "nan"}), "not a finite number"));
    CHECK(contains(message({.multiplier = "1e999"}), "not a finite number"));
    CHECK(
        contains(message({.multiplier = "1 2000000"}), "the number of vertical angles is 2000000"));
    CHECK(contains(message({.multiplier = "1 2.5"}), "the number of vertical angles is 2.5"));
    CHECK(contains(message({.multiplier = "1 1000 1001"}),
                   "horizontal angles is 1001, not an "
                   "integer from 1 to 1000"));
    CHECK(contains(message({.type = "4"}), "the photometric type is 4"));
    CHECK(contains(message({.factors = "-1 1 60"}), "line 6: the ballast factor is -1"));
    CHECK(contains(message({.version = "IESNA:LM-63-1995", .factors = "1 -1 60"}),
                   "the ballast-lamp factor is -1"));
    CHECK(contains(message({.vertical = "0"}), "the number of vertical angles is 1"));
    CHECK(contains(message({.vertical = "0 90 90"}),
                   "line 7: vertical angle 2 is 90, not above 90 before it"));
    CHECK(contains(message({.vertical = "0 90 181"}), "vertical angles go from 0 to 181 degrees"));
    CHECK(contains(message({.vertical = "-1 90 180"}), "vertical angles go from -1 to 180"));
    CHECK(contains(message({.horizontal = "0 100", .candelas = "1 2 3 4 5 6"}),
                   "horizontal angles go from 0 to 100 degrees"));
    CHECK(contains(message({.horizontal = "10 360", .candelas = "1 2 3 4 5 6"}),
                   "horizontal angles go from 10 to 360"));
    CHECK(contains(message({.type = "2"}), "horizontal angles go from 0 to 0"));
    CHECK(contains(message({.type = "3", .horizontal = "0 90", .candelas = "1 2 3 4 5 6"}),
                   "vertical angles go from 0 to 180"));
    CHECK(contains(message({.candelas = "100 50"}), "the file ends before an intensity"));
    CHECK(contains(message({.multiplier = "1e30", .candelas = "1 2 3e30"}),
                   "line 9: an intensity of 3e+60 cd is too great"));
    CHECK(contains(message({.tilt = "TILT=INCLUDE\n1\n900"}), "the file ends before"));
    for (std::size_t size = 0; size < 90; ++size) {
        const Error cut = with_profile(IesText{}.text().substr(0, size)).error();
        CAPTURE(size, cut.what());
        CHECK(cut.code() == ErrorCode::invalid_input);
    }
}

TEST_CASE("light profiles are files, data or views, each read once and only if it is used",
          "[long]")
{
    const std::string text = IesText{}.text();
    GltfFixture fixture = with_profiles({{{"uri", "some%20lamps/a.ies"}}, {{"uri", "none.ies"}}});
    fixture.json["nodes"].push_back(fixture.json["nodes"][0]);
    fixture.json["nodes"].push_back(
        {{"extensions",
          {{"KHR_node_visibility", {{"visible", false}}}, {"EXT_lights_ies", {{"light", 1}}}}}});
    fixture.json["scenes"][0]["nodes"] = {0, 1, 2};
    const TempFolder folder;
    folder.write("some lamps/a.ies", text);
    const LoadedScene loaded = load_gltf(folder.write("scene.gltf", fixture.text()));
    CHECK(loaded.scene.lights.size() == 2);
    CHECK(loaded.scene.profiles.size() == 1);
    CHECK(loaded.scene.profiles[0].intensities[0] == 100.0f);

    GltfFixture view = with_profiles(nlohmann::json::array({nlohmann::json::object()}));
    node_light(view)["light"] = 1;
    view.json["extensions"]["EXT_lights_ies"]["lights"].push_back(
        {{"bufferView", view.add_view(text)}, {"mimeType", "application/x-ies-lm-63"}});
    CHECK(view.load().scene.profiles.at(0).intensities[0] == 100.0f);
    GltfOptions little;
    little.limits.mesh_bytes = 90;
    CHECK(contains(view.error(little).what(), "light profiles and instances need 96 B"));
    // What is missing, or not where it may be.
    fixture.json["nodes"][0]["extensions"]["EXT_lights_ies"]["light"] = 1;
    const Error missing = load_error(folder.write("missing.gltf", fixture.text()));
    CHECK(missing.code() == ErrorCode::not_found);
    CHECK(contains(missing.what(), "/extensions/EXT_lights_ies/lights/1: \"none.ies\": no such"));
    const auto refused = [](const nlohmann::json& profile) {
        const Error error = with_profiles(nlohmann::json::array({profile})).error();
        CHECK(error.code() == ErrorCode::invalid_input);
        return std::string(error.what());
    };
    CHECK(contains(refused({{"uri", "../a.ies"}}),
                   "/extensions/EXT_lights_ies/lights/0/uri: \"../a.ies\": leads to"));
    CHECK(contains(refused({{"uri", "http://x/a.ies"}}), "only relative and data URIs"));
    CHECK(contains(refused({{"uri", "a.ies"}, {"bufferView", 0}}), "bufferView: index 0"));
    CHECK(contains(refused({{"uri", 3}}), "/lights/0/uri: must be a string"));
    CHECK(contains(refused(nlohmann::json::object()), "neither \"uri\" nor \"bufferView\""));
    CHECK(contains(refused(as_data(std::string((33 << 20), ' '))), "but the limit is 33554432"));
    GltfFixture index = with_profile(text);
    node_light(index)["light"] = 1;
    CHECK(contains(index.error().what(),
                   "EXT_lights_ies/light: index 1, but the number of lights is 1"));
    node_light(index) = {{"light", 0}, {"multiplier", "bright"}};
    CHECK(contains(index.error().what(), "EXT_lights_ies/multiplier: must be a number"));
}

}  // namespace bdpt::test::light_profiles_test
