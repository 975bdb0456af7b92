#include <bdpt/error.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "catch.hpp"
#include "commands/commands.h"
#include "live/frame.h"
#include "live/live_render.h"
#include "live/live_scene.h"
#include "scratch_folder.h"
#include "server/server.h"
#include "state/view_state.h"

namespace bdpt::view::live_view_parts_test {
namespace {

std::uint32_t number_at(const FrameHeader& header, std::size_t i)
{
    std::uint32_t result = 0;
    for (std::size_t byte = 0; byte < 4; ++byte) {
        result |= static_cast<std::uint32_t>(header.at(4 * i + byte)) << (8 * byte);
    }
    return result;
}

/// The first half of `pixels`, decoded by the definition.
double half_at(const std::vector<std::uint8_t>& bytes, std::size_t i)
{
    const int bits = bytes.at(2 * i) | (bytes.at(2 * i + 1) << 8);
    const int exponent = (bits >> 10) & 31;
    const double mantissa = bits & 1023;
    return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
}

std::string message_of(const std::string& request)
{
    try {
        static_cast<void>(parse_request(request));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
        return error.what();
    }
    return "";
}

TEST_CASE("pixels go to pages as halves", "[live_view]")
{
    for (const float value :
         {0.0f, 1.0f, 0.5f, 1.0009765f, 1.5e-5f, 6e-8f, 3.14159f, 1234.5f, 65503.0f}) {
        const std::vector<std::uint8_t> bytes =
            half_pixels({.width = 1, .height = 1, .pixels = {Rgb(value, 2.0f * value, 0.0f)}});
        REQUIRE(bytes.size() == 6);
        CAPTURE(value);
        // To the nearest: half a step of 11 bits, or of the least half.
        const auto exact = static_cast<double>(value);
        CHECK(std::abs(half_at(bytes, 0) - exact) <= std::max(exact * 0x1p-11, 0x1p-25));
        CHECK(half_at(bytes, 2) == 0.0);
    }
    const float inf = std::numeric_limits<float>::infinity();
    const std::vector<std::uint8_t> odd =
        half_pixels({.width = 1, .height = 1, .pixels = {Rgb(inf, -1.0f, std::nanf(""))}});
    CHECK(half_at(odd, 0) == 65504.0);
    CHECK(half_at(odd, 1) == 0.0);
    CHECK(half_at(odd, 2) == 0.0);
}

TEST_CASE("pixels over a background go to pages with what covers it", "[live_view]")
{
    const Image image{.width = 2, .height = 1, .pixels = {Rgb(2.0f), Rgb(0.0f)}};
    const std::vector<float> alpha{0.75f, 1.0f};
    const std::vector<float> shadow{0.25f, 1.0f};
    const std::vector<std::uint8_t> bytes = half_pixels(image, {.alpha = alpha, .shadow = shadow});
    REQUIRE(bytes.size() == 20);
    CHECK(half_at(bytes, 3) == 0.5);   // light
    CHECK(half_at(bytes, 4) == 0.25);  // background
    CHECK(half_at(bytes, 5) == 0.0);
    CHECK(half_at(bytes, 8) == 0.0);
    CHECK(half_at(bytes, 9) == 0.0);
    CHECK(half_at(half_pixels(image, {.alpha = alpha}), 3) == 0.75);
}

TEST_CASE("a frame tells each page which of its requests it shows", "[live_view]")
{
    Frame frame{.slot = 1,
                .generation = 7,
                .grid_width = 40,
                .grid_height = 30,
                .x = 3,
                .y = 4,
                .width = 5,
                .height = 6,
                .samples = 258,
                .denoised = 1};
    frame.sequences = {{11, 99}};
    const FrameHeader header = frame_header(frame, 11);
    const std::vector<std::uint32_t> expected{3, 1, 7, 99, 40, 30, 3, 4, 5, 6, 258, 3, 1};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CHECK(number_at(header, i) == expected[i]);
    }
    CHECK(number_at(frame_header(frame, 12), 3) == 0);
}

TEST_CASE("tokens are long, and differ", "[live_view]")
{
    const std::string token = random_token();
    CHECK(token.size() == 32);
    CHECK(token.find_first_not_of("0123456789abcdef") == std::string::npos);
    CHECK(token != random_token());
    CHECK(are_equal_in_constant_time(token, std::string(token)));
    CHECK_FALSE(are_equal_in_constant_time(token, token.substr(1)));
    for (std::size_t i = 0; i < token.size(); ++i) {
        std::string other = token;
        other[i] = other[i] == '0' ? '1' : '0';
        CHECK_FALSE(are_equal_in_constant_time(token, other));
    }
}

TEST_CASE("only who knows the address is answered, under our own names", "[live_view]")
{
    const Access access("00ff", "beef", "127.0.0.1");
    const auto status = [&](const RequestHead& head) {
        const auto refusal = access.refusal(head);
        return refusal ? refusal->status : 200;
    };
    const RequestHead good{.method = "GET", .target = "/00ff/", .host = "127.0.0.1:80"};
    CHECK(status(good) == 200);
    for (const char* host : {"localhost:9000", "LOCALHOST", "[::1]:1", "127.0.0.1"}) {
        CHECK(status({.method = "GET", .target = "/00ff/", .host = host}) == 200);
    }
    for (const char* host : {"", "evil.example", "127.0.0.1.evil.example:80", "10.0.0.1",
                             "localhost:80; script-src *", "localhost.evil:80", "[::2]", "x"}) {
        CAPTURE(host);
        CHECK(status({.method = "GET", .target = "/00ff/", .host = host}) == 403);
    }
    for (const char* target : {"/", "", "/00ff", "/00fe/", "/00FF/", "/0/", "//00ff/", "00ff/",
                               "/../00ff/", "/%3000ff/", "/00ff0/save.exr"}) {
        CAPTURE(target);
        CHECK(status({.method = "GET", .target = target, .host = "localhost"}) == 403);
    }
    RequestHead foreign = good;
    foreign.origin = "http://evil.example";
    CHECK(status(foreign) == 403);
    foreign.origin = "null";
    CHECK(status(foreign) == 403);
    foreign.origin = "https://127.0.0.1:80";
    CHECK(status(foreign) == 403);
    foreign.origin = "http://127.0.0.1:80";
    CHECK(status(foreign) == 200);
    CHECK(status({.method = "POST", .target = "/00ff/", .host = "localhost"}) == 405);

    // A file is only taken from the page itself.
    const RequestHead file{.method = "PUT",
                           .target = "/00ff/environment?name=a.hdr",
                           .host = "localhost",
                           .origin = "http://localhost"};
    CHECK(status(file) == 200);
    RequestHead nobody = file;
    nobody.origin.reset();
    CHECK(status(nobody) == 403);
    CHECK(status({.method = "PUT", .target = "/00ff/", .host = "localhost"}) == 405);
    CHECK(percent_decoded("a%20%c3%A4.hdr") == "a \xc3\xa4.hdr");
    for (const char* wrong : {"%", "a%2", "%g0", "%-1", "%+1"}) {
        CHECK_FALSE(percent_decoded(wrong));
    }

    const Access everywhere("00ff", "beef", "0.0.0.0");
    CHECK_FALSE(everywhere.refusal({.method = "GET", .target = "/00ff/", .host = "10.1.2.3:80"}));
    CHECK(everywhere.refusal({.method = "GET", .target = "/00ff/", .host = "evil.example:80"}));
    CHECK(Access::parse_path("/00ff/save.exr?slot=1") == "save.exr");
    CHECK(Access::parse_path("/00ff/") == "");
    CHECK(Access::parse_query("/00ff/save.exr?slot=1") == "slot=1");
}

TEST_CASE("the ticket opens the page once, and to our own names only", "[live_view]")
{
    Access access("00ff", "beef", "127.0.0.1");
    const RequestHead ticket{.method = "GET", .target = "/beef", .host = "127.0.0.1:80"};
    CHECK(access.refusal(ticket));
    CHECK_FALSE(access.redeem({.method = "GET", .target = "/beee", .host = "127.0.0.1:80"}));
    CHECK_FALSE(access.redeem({.method = "GET", .target = "/beef", .host = "evil.example"}));
    CHECK(access.redeem(ticket));
    CHECK_FALSE(access.redeem(ticket));
}

TEST_CASE("where to listen is a host, and perhaps a port", "[live_view]")
{
    CHECK(app::parse_listen_address("127.0.0.1") ==
          NetworkAddress{.host = "127.0.0.1", .port = "0"});
    CHECK(app::parse_listen_address("127.0.0.1:0") ==
          NetworkAddress{.host = "127.0.0.1", .port = "0"});
    CHECK(app::parse_listen_address(":8080") ==
          NetworkAddress{.host = "localhost", .port = "8080"});
    CHECK(app::parse_listen_address("8080") == NetworkAddress{.host = "127.0.0.1", .port = "8080"});
    CHECK(app::parse_listen_address("[::1]:80") == NetworkAddress{.host = "::1", .port = "80"});
    CHECK(app::parse_listen_address("[::1]") == NetworkAddress{.host = "::1", .port = "0"});
    for (const char* wrong : {"", "a:b", "a:70000", "70000", "a b", "[::1", "a:-1"}) {
        CAPTURE(wrong);
        CHECK_FALSE(app::parse_listen_address(wrong));
    }
}

TEST_CASE("the hand turns, shifts and nears what it sees", "[live_view]")
{
    const Pose pose{.from = {0.0f, 0.0f, 4.0f}, .look_at = {0.0f, 0.0f, 0.0f}};
    const float quarter = std::numbers::pi_v<float> / 2.0f;
    // What is in front goes right with the mouse: the camera goes left.
    const Pose turned = moved(pose, {.orbit = {quarter, 0.0f}}, 1.0f);
    CHECK(turned.from.x == Approx(-4.0f));
    CHECK(turned.from.z == Approx(0.0f).margin(1e-5));
    const Pose raised = moved(pose, {.orbit = {0.0f, 0.5f}}, 1.0f);
    CHECK(raised.from.y == Approx(4.0f * std::sin(0.5f)));
    // Never over the top, where the camera has no right hand.
    const Pose top = moved(pose, {.orbit = {0.0f, 100.0f}}, 1.0f);
    CHECK(top.from.y < 4.0f);
    CHECK(top.from.z > 0.0f);
    const Pose panned = moved(pose, {.pan = {0.5f, 0.25f}}, 1.0f);
    CHECK(panned.look_at.x == Approx(-2.0f));  // half of the 4 m that the image is high there
    CHECK(panned.look_at.y == Approx(1.0f));
    CHECK(glm::length(panned.from - panned.look_at) == Approx(4.0f));
    CHECK(moved(pose, {.dolly = 0.5f}, 1.0f).from.z == Approx(2.0f));
    Pose near = pose;
    for (int i = 0; i < 100; ++i) {
        near = moved(near, {.dolly = 1e-3f}, 1.0f);
    }
    CHECK(near.from != near.look_at);
}

TEST_CASE("vertices are drawn where the image shows them", "[live_view]")
{
    CameraDesc camera;
    camera.world_from_camera[3] = Vec4(0.0f, 0.0f, 5.0f, 1.0f);
    camera.vertical_fov = 2.0f * std::atan(0.5f);  // 5 m high at the origin
    const Size size{.width = 200, .height = 100};
    const auto middle = project_point(camera, size, Vec3(0.0f));
    REQUIRE(middle);
    CHECK(middle->x == Approx(100.0f));
    CHECK(middle->y == Approx(50.0f));
    const auto corner = project_point(camera, size, Vec3(5.0f, 2.5f, 0.0f));
    REQUIRE(corner);
    CHECK(corner->x == Approx(200.0f));
    CHECK(corner->y == Approx(0.0f).margin(1e-3));
    CameraDesc shifted = camera;
    shifted.shift = {0.25f, 0.5f};
    shifted.pixel_aspect = 2.0f;
    const auto moved_away = project_point(shifted, size, Vec3(5.0f, 2.5f, 0.0f));
    REQUIRE(moved_away);
    CHECK(moved_away->x == Approx(200.0f * (0.5f - 0.25f) + 50.0f));
    CHECK(moved_away->y == Approx(50.0f));
    CHECK_FALSE(project_point(camera, size, Vec3(0.0f, 0.0f, 6.0f)));
    CHECK(project_direction(camera, size, Vec3(0.0f, 0.0f, -1.0f)));
    camera.projection = Projection::orthographic;
    camera.vertical_extent = 10.0f;
    const auto parallel = project_point(camera, size, Vec3(10.0f, 5.0f, -3.0f));
    REQUIRE(parallel);
    CHECK(parallel->x == Approx(200.0f));
    CHECK(parallel->y == Approx(0.0f).margin(1e-3));
}

TEST_CASE("requests of pages are checked", "[live_view]")
{
    const PageRequest move =
        parse_request(R"({"seq": 5, "move": {"orbit": [0.1, -0.2], "pan": [0, 1], "dolly": 2}})");
    CHECK(move.sequence == 5);
    CHECK(move.changes_picture());
    REQUIRE(move.move);
    CHECK(move.move->orbit == Vec2(0.1f, -0.2f));
    CHECK(move.move->dolly == 2.0f);
    const PageRequest set = parse_request(
        R"({"seq": 6, "set": {"integrator_b": null, "exposure": 1.5, "layer": "noise"}})");
    REQUIRE(set.settings);
    CHECK_FALSE(set.changes_picture());
    CHECK(set.settings->integrator_b == "");
    CHECK(set.settings->options ==
          std::vector<std::pair<std::string, std::string>>{{"--exposure", "1.5"}});
    CHECK(set.settings->layer == ViewLayer::noise);
    CHECK(parse_request(R"({"inspect": [3, 4], "sample": 9})").inspect->index == 9);

    CHECK(message_of("") == "a request must be a JSON object");
    CHECK(message_of("[1]") == "a request must be a JSON object");
    CHECK(message_of(R"({"sew": 1})") == "\"sew\": is not a request");
    for (const char* wrong : {R"({"seq": -1})",
                              R"({"seq": 4294967296})",
                              R"({"move": 3})",
                              R"({"move": {"orbit": [1]}})",
                              R"({"move": {"orbit": [1, "2"]}})",
                              R"({"move": {"dolly": 0}})",
                              R"({"move": {"dolly": 1e300}})",
                              R"({"focus": [1.5, 2]})",
                              R"({"focus": [1, -2]})",
                              R"({"reset": 1})",
                              R"({"set": {"layer": "depth"}})",
                              R"({"set": {"paused": "no"}})",
                              R"({"set": {"intensity": -1}})",
                              R"({"set": {"exposure": "bright"}})",
                              R"({"set": {"environment": 3}})",
                              R"({"set": {"size": 3}})",
                              R"({"set": {"fov": 180}})",
                              R"({"set": {"f_stop": 0}})",
                              R"({"set": {"ground": "shadow"}})",
                              R"({"set": {"time": "1"}})",
                              R"({"set": {"denoise": 1}})",
                              R"({"focus": [1, 2], "turn": 1})",
                              R"({"inspect": [1, 2], "sample": -1})"}) {
        CAPTURE(wrong);
        CHECK_FALSE(message_of(wrong).empty());
    }
}

TEST_CASE("coarse pictures come first, and each is worth its time", "[live_view]")
{
    const Size size{.width = 1280, .height = 720};
    CoarseToFine coarse;
    CHECK_FALSE(coarse.divisor());
    coarse.restart(size);
    REQUIRE(coarse.divisor());
    // A slow scene: 10 us a pixel. After a few pictures the first takes 40 ms at most.
    for (int i = 0; i < 20; ++i) {
        coarse.restart(size);
        CHECK(coarse.is_first());
        const Size first = coarse_size(size, *coarse.divisor());
        coarse.done(1e-5 * first.width * first.height);
    }
    coarse.restart(size);
    CHECK(*coarse.divisor() == 16);
    // What would take longer than a quarter of a second is left to the render.
    coarse.done(1e-5 * 80 * 45);
    CHECK_FALSE(coarse.is_first());
    REQUIRE(coarse.divisor());
    CHECK(*coarse.divisor() == 8);
    coarse.done(1e-5 * 160 * 90);
    CHECK_FALSE(coarse.divisor());
    // A fast one begins with all pixels.
    for (int i = 0; i < 40; ++i) {
        coarse.restart(size);
        const Size first = coarse_size(size, *coarse.divisor());
        coarse.done(1e-9 * first.width * first.height);
    }
    coarse.restart(size);
    CHECK(*coarse.divisor() == 1);
    coarse.done(1e-3);
    CHECK_FALSE(coarse.divisor());
    CHECK(coarse_size({.width = 3, .height = 1}, 16).width == 1);
}

TEST_CASE("files that change are loaded when they rest", "[live_view]")
{
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "a.bin";
    const std::filesystem::path other = folder / "b.bin";
    std::ofstream(file) << "one";
    FileChanges changes;
    changes.watch({file, other});
    CHECK_FALSE(changes.look());
    std::ofstream(file) << "longer";
    CHECK_FALSE(changes.look());  // it may still be written
    CHECK(changes.look());
    CHECK_FALSE(changes.look());
    std::ofstream(other) << "new";
    CHECK_FALSE(changes.look());
    CHECK(changes.look());
    std::filesystem::remove(other);
    std::ofstream(file) << "again";
    CHECK_FALSE(changes.look());
    // What changed while it was loaded is not forgotten when the list of files changes.
    changes.watch({file});
    CHECK_FALSE(changes.look());
    CHECK(changes.look());
}

TEST_CASE("tasks stop passes as far as they are urgent", "[live_view]")
{
    Mailbox mailbox;
    PassStops pass = mailbox.begin_pass(true);
    CHECK_FALSE(pass.soon.stop_requested());
    int done = 0;
    mailbox.post([&] { ++done; }, Urgency::when_idle);
    CHECK_FALSE(pass.soon.stop_requested());
    mailbox.post([&] { ++done; }, Urgency::soon);
    CHECK(pass.soon.stop_requested());
    CHECK_FALSE(pass.now.stop_requested());
    mailbox.post([&] { ++done; }, Urgency::now);
    CHECK(pass.now.stop_requested());
    // A pass that begins before the tasks are done is stopped as well.
    CHECK(mailbox.begin_pass(true).now.stop_requested());
    CHECK(mailbox.work_off(true));
    CHECK(done == 3);
    pass = mailbox.begin_pass(false);
    mailbox.post([&] { ++done; }, Urgency::now);
    CHECK_FALSE(pass.now.stop_requested());  // it is left alone
    mailbox.close();
    CHECK(pass.now.stop_requested());
    CHECK_FALSE(mailbox.work_off(true));
    CHECK(done == 3);
}

TEST_CASE("the page has all its parts", "[live_view]")
{
    const std::string page = view_page();
    CHECK(page.starts_with("<!doctype html>"));
    CHECK(page.find("{{") == std::string::npos);
    CHECK(page.find("class View") != std::string::npos);   // shared with the report of bench
    CHECK(page.find("class Stage") != std::string::npos);  // its own
    CHECK(page.find("src=\"http") == std::string::npos);   // nothing comes from elsewhere
}

}  // namespace
}  // namespace bdpt::view::live_view_parts_test
