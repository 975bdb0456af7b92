#include "gltf/animation/animation.h"
#include "../gltf_fixture.h"
#include "catch.hpp"

#include <bdpt/scene_desc.h>

#include <cmath>
#include <functional>
#include <limits>

namespace bdpt::test::animation_test {
using namespace bdpt::io;

namespace {

/// A triangle whose node has one animated property.
struct Animated {
    GltfFixture fixture = GltfFixture::triangle();

    void add(const std::string& name, const std::string& path, const std::string& interpolation,
             const std::vector<float>& times, const std::string& type,
             const std::vector<float>& values, std::size_t count)
    {
        const int input = fixture.add_accessor(f32, "SCALAR", times.size(), bytes_of(times));
        const int output = fixture.add_accessor(f32, type, count, bytes_of(values));
        fixture.json["animations"].push_back(
            {{"name", name},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}},
             {"samplers",
              {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}});
    }

    [[nodiscard]] Mat4 matrix(double time) const
    {
        return fixture.load({.time = time}).scene.instances.at(0).world_from_object;
    }
};

Animated moving(const std::string& interpolation)
{
    Animated result;
    result.add("slide", "translation", interpolation, {1, 3}, "VEC3", {0, 0, 0, 4, 8, -2}, 2);
    return result;
}

}  // namespace

TEST_CASE("key frames are held, joined by lines or by splines")
{
    KeyFrames frames{{1, 3, 4}, {10, 20, 0}, 1, Interpolation::step};
    const auto at = [&frames](double t) { return value_at(frames, Quantity::numbers, t).at(0); };
    CHECK(at(0.0) == 10.0);
    CHECK(at(1.0) == 10.0);
    CHECK(at(2.999) == 10.0);
    CHECK(at(3.0) == 20.0);
    CHECK(at(9.0) == 0.0);
    frames.interpolation = Interpolation::linear;
    CHECK(at(0.0) == 10.0);
    CHECK(at(2.5) == Approx(17.5));
    CHECK(at(3.25) == Approx(15.0));
    CHECK(at(9.0) == 0.0);

    // A spline with the tangents of a cubic polynomial is that polynomial.
    const auto cubic = [](double t) { return 2.0 + t * (1.0 + t * (-3.0 + t * 0.5)); };
    const auto slope = [](double t) { return 1.0 + t * (-6.0 + t * 1.5); };
    KeyFrames spline{{1, 3}, {}, 1, Interpolation::cubic_spline};
    for (const double t : {1.0, 3.0}) {
        for (const double v : {slope(t), cubic(t), slope(t)}) {
            spline.values.push_back(static_cast<float>(v));
        }
    }
    for (const double t : {1.0, 1.25, 2.0, 2.9, 3.0}) {
        CAPTURE(t);
        CHECK(value_at(spline, Quantity::numbers, t).at(0) == Approx(cubic(t)));
    }
    CHECK(value_at(spline, Quantity::numbers, 0.0).at(0) == Approx(cubic(1.0)));
    CHECK(value_at(spline, Quantity::numbers, 7.0).at(0) == Approx(cubic(3.0)));
    // In-tangents and out-tangents are not the same thing.
    spline.values = {100, 0, 1, 3, 5, 100};
    CHECK(value_at(spline, Quantity::numbers, 2.0).at(0) ==
          Approx(0.5 * 0 + 2.0 * 0.125 * 1 + 0.5 * 5 - 2.0 * 0.125 * 3));
}

TEST_CASE("rotations turn evenly and by the shorter way")
{
    const auto about_z = [](double angle) {
        return std::vector<float>{0, 0, static_cast<float>(std::sin(angle / 2)),
                                  static_cast<float>(std::cos(angle / 2))};
    };
    const auto check = [&](double from, double to, double sign, double u, double expected) {
        CAPTURE(from, to, u);
        KeyFrames frames{{0, 1}, about_z(from), 4, Interpolation::linear};
        for (const float v : about_z(to)) {
            frames.values.push_back(static_cast<float>(sign) * v);
        }
        const std::vector<double> q = value_at(frames, Quantity::rotation, u);
        double angle = 2.0 * std::atan2(q[2], q[3]);
        angle = std::remainder(angle - expected, 2.0 * 3.141592653589793);
        CHECK(angle == Approx(0.0).margin(1e-6));
        CHECK(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])) == Approx(1.0));
    };
    check(0.0, 2.0, 1.0, 0.25, 0.5);
    check(0.0, 2.0, -1.0, 0.25, 0.5);  // q and -q are one rotation
    check(0.5, 3.0, 1.0, 0.8, 2.5);
    check(1.0, 1.0, 1.0, 0.5, 1.0);
    check(1.0, 1.0, -1.0, 0.5, 1.0);
}

TEST_CASE("an animation moves a node to where it is at a time")
{
    const Animated linear = moving("LINEAR");
    CHECK(linear.matrix(0.0)[3] == Vec4(0, 0, 0, 1));
    CHECK(linear.matrix(2.0)[3] == Vec4(2, 4, -1, 1));
    CHECK(linear.matrix(100.0)[3] == Vec4(4, 8, -2, 1));
    CHECK(moving("STEP").matrix(2.0)[3] == Vec4(0, 0, 0, 1));
    // Without a time nodes rest.
    Animated resting = moving("LINEAR");
    resting.fixture.json["nodes"][0]["translation"] = {7, 0, 0};
    CHECK(resting.fixture.load().scene.instances.at(0).world_from_object[3] == Vec4(7, 0, 0, 1));
    CHECK(resting.fixture.load({.animation = "slide"}).scene.instances.at(0).world_from_object[3] ==
          Vec4(0, 0, 0, 1));
    CHECK(linear.fixture.load({.time = 1.0}).warnings.empty());
}

TEST_CASE("rotation and scale are animated, rotations as integers too")
{
    Animated scaled;
    scaled.add("grow", "scale", "LINEAR", {0, 2}, "VEC3", {1, 1, 1, 3, 5, 7}, 2);
    CHECK(scaled.matrix(1.0)[1] == Vec4(0, 3, 0, 0));

    Animated turned;
    turned.add("later_directions", "rotation", "LINEAR", {0, 1}, "VEC4", {0, 0, 0, 1, 0, 0, 1, 0},
               2);
    const int output = turned.fixture.add_accessor(
        i16, "VEC4", 2, bytes_of<std::int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0}));
    const Mat4 floats = turned.matrix(0.5);
    turned.fixture.json["animations"][0]["samplers"][0]["output"] = output;
    const Mat4 integers = turned.matrix(0.5);
    for (int c = 0; c < 3; ++c) {
        CHECK(floats[0][c] == Approx(c == 1 ? 1.0 : 0.0).margin(1e-6));
        CHECK(integers[0][c] == Approx(floats[0][c]).margin(1e-6));
    }
}

TEST_CASE("animations are chosen by name, by index, all, or the first")
{
    Animated both = moving("LINEAR");
    both.add("grow", "scale", "LINEAR", {0, 2}, "VEC3", {1, 1, 1, 3, 3, 3}, 2);
    const auto shown = [&both](std::optional<std::string> animation) {
        const LoadedScene loaded =
            both.fixture.load({.animation = std::move(animation), .time = 2.0});
        const Mat4 m = loaded.scene.instances.at(0).world_from_object;
        return Vec2(m[3][0], m[0][0]);
    };
    CHECK(shown("slide") == Vec2(2, 1));
    CHECK(shown("grow") == Vec2(0, 3));
    CHECK(shown("1") == Vec2(0, 3));
    CHECK(shown("all") == Vec2(2, 3));
    CHECK(shown(std::nullopt) == Vec2(2, 1));
    CHECK(warns(both.fixture.load({.time = 2.0}).warnings, {"/animations", "the first one"}));
    CHECK(both.fixture.load().facts.animation_names == std::vector<std::string>{"slide", "grow"});
    CHECK(both.fixture.load().facts.animation_ends == std::vector<double>{0.0, 0.0});  // not stated
    const auto input = [&](std::size_t animation) -> nlohmann::json& {
        const auto& sampler = both.fixture.json["animations"][animation]["samplers"][0];
        return both.fixture.json["accessors"][sampler["input"].get<std::size_t>()];
    };
    input(0)["max"] = {1.5};
    input(1)["max"] = {2};
    CHECK(both.fixture.load().facts.animation_ends == std::vector<double>{1.5, 2.0});
    const Error error = both.fixture.error({.animation = "run"});
    CHECK(error.code() == ErrorCode::not_found);
    CHECK(contains(error.what(),
                   "no animation \"run\"; the file has 2 animations: 0 \"slide\", 1 \"grow\""));
    CHECK(warns(GltfFixture::triangle().load({.time = 2.0}).warnings, {"no animations"}));
    CHECK(both.fixture.error({.time = std::numeric_limits<double>::quiet_NaN()}).code() ==
          ErrorCode::usage);
}

TEST_CASE("key frames that make no sense are refused by name")
{
    const auto error_of = [](const std::function<void(nlohmann::json&)>& edit,
                             const std::vector<float>& times = {1, 3}) {
        Animated animated;
        animated.add("", "translation", "LINEAR", times, "VEC3", std::vector<float>(6), 2);
        edit(animated.fixture.json["animations"][0]);
        const Error error = animated.fixture.error({.time = 2.0});
        CHECK(error.code() == ErrorCode::invalid_input);
        // What does not play is not read.
        CHECK(std::string(animated.fixture.error().what()).empty());
        return std::string(error.what());
    };
    const auto nothing = [](nlohmann::json&) {};
    CHECK(contains(error_of(nothing, {3, 1}),
                   "/animations/0/samplers/0/input: key frame 1 is at 1 s, but must be after 3 s"));
    CHECK(contains(error_of(nothing, {1, NAN}), "/animations/0/samplers/0/input: accessor 2"));
    CHECK(contains(error_of(nothing, {1, 2, 3}),
                   "/animations/0/samplers/0/output: 6 numbers, but 3 key frames need 9"));
    CHECK(contains(error_of([](auto& a) { a["samplers"][0]["interpolation"] = "CUBICSPLINE"; }),
                   "/animations/0/samplers/0/output: 6 numbers, but 2 key frames need 18"));
    CHECK(contains(error_of([](auto& a) { a["samplers"][0]["interpolation"] = "BOUNCE"; }),
                   "/animations/0/samplers/0/interpolation: \"BOUNCE\" is not an interpolation"));
    CHECK(contains(error_of([](auto& a) { a["channels"][0]["sampler"] = 1; }),
                   "/animations/0/channels/0/sampler: index 1, but the number of samplers is 1"));
    CHECK(contains(error_of([](auto& a) { a["channels"][0].erase("sampler"); }),
                   "/animations/0/channels/0: \"sampler\" is missing"));
    CHECK(contains(error_of([](auto& a) { a["channels"][0].erase("target"); }),
                   "/animations/0/channels/0: \"target\" is missing"));
    CHECK(contains(error_of([](auto& a) { a["samplers"][0].erase("input"); }),
                   "/animations/0/samplers/0: \"input\" is missing"));
    CHECK(contains(error_of([](auto& a) { a["channels"][0]["target"]["path"] = "rotation"; }),
                   "/type: must be VEC4"));
}

TEST_CASE("parts of an animation that move nothing may lack something")
{
    Animated animated = moving("LINEAR");
    nlohmann::json& animation = animated.fixture.json["animations"][0];
    animation["samplers"].push_back({{"interpolation", 3}});
    const nlohmann::json target{{"path", "translation"}};
    const nlohmann::json moved = animation["channels"][0];
    animation["channels"] = nlohmann::json::array(
        {nlohmann::json{{"target", {{"node", 0}, {"path", 3}}}}, nlohmann::json{{"target", target}},
         nlohmann::json{{"target", target}, {"sampler", 1ULL << 40U}},
         nlohmann::json{{"target", target}, {"sampler", 1}}, moved});
    CHECK(animated.matrix(2.0)[3] == Vec4(2, 4, -1, 1));
    CHECK(warns(animated.fixture.load({.time = 2.0}).warnings,
                {"/animations/0/channels/0/target/path: 3"}));
    animation["channels"][4]["sampler"] = 1;
    CHECK(contains(animated.fixture.error({.time = 2.0}).what(),
                   "/animations/0/samplers/1/interpolation: 3 is not an interpolation"));
}

TEST_CASE("what cannot be animated rests, with a warning")
{
    Animated odd = moving("LINEAR");
    nlohmann::json& target = odd.fixture.json["animations"][0]["channels"][0]["target"];
    target["path"] = "pointer";
    CHECK(warns(odd.fixture.load({.time = 2.0}).warnings,
                {"/animations/0/channels/0/target/path", "\"pointer\""}));
    target["path"] = "weights";
    CHECK(warns(odd.fixture.load({.time = 2.0}).warnings, {"without morph targets"}));
    target["path"] = "translation";
    target.erase("node");
    CHECK(odd.matrix(2.0) == Mat4(1.0f));
    target["node"] = 0;
    odd.fixture.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
    CHECK(odd.matrix(2.0)[3] == Vec4(5, 6, 7, 1));
    CHECK(warns(odd.fixture.load({.time = 2.0}).warnings, {"has a matrix"}));
}

}  // namespace bdpt::test::animation_test
