#include "render/check_options.h"

#include <bdpt/error.h>
#include <bdpt/options/option_fields.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <functional>
#include <limits>
#include <string>
#include <type_traits>

namespace bdpt::check_options_test {
namespace {

std::string message_of(const std::function<void()>& action, ErrorCode expected)
{
    try {
        action();
    } catch (const Error& error) {
        CHECK(error.code() == expected);
        return error.what();
    }
    return "";
}

std::string refusal(const std::function<void(RenderOptions&)>& change)
{
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    change(options);
    return message_of([&] { check_options(options); }, ErrorCode::usage);
}

/// In which 0 light paths and no tiles are the only numbers that others forbid.
RenderOptions fresh_options()
{
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    return options;
}

}  // namespace

TEST_CASE("options out of range are refused by name and value", "[render]")
{
    check_options(RenderOptions{});
    CHECK(refusal([](auto& o) { o.film.width = 0; }) == "width is 0, not in [1, 65536]");
    CHECK(refusal([](auto& o) { o.film.height = -3; }) == "height is -3, not in [1, 65536]");
    CHECK(refusal([](auto& o) { o.transport.max_depth = 0; }).find("max_depth") !=
          std::string::npos);
    CHECK(refusal([](auto& o) {
              o.sampling.samples = {.begin = 4, .end = 4};
          }).find("samples is 0") != std::string::npos);
    CHECK(refusal([](auto& o) { o.sampling.samples = {.begin = -1, .end = 4}; }).find("-1") !=
          std::string::npos);
    for (const PixelRect crop :
         {PixelRect{-1, 0, 4, 4}, PixelRect{0, 0, 1281, 4}, PixelRect{0, 0, 4, 721},
          PixelRect{0, -2, 4, 4}, PixelRect{7, 0, 7, 4}, PixelRect{0, 8, 4, 5}}) {
        CHECK(refusal([&](auto& o) { o.film.crop = crop; }).find("crop ") == 0);
    }
    CHECK(refusal([](auto& o) {
              o.film.crop = PixelRect{9, 8, 7, 6};
          }) == "crop 9,8,7,6 is empty or outside of the image of 1280x720 pixels");
    CHECK(refusal([](auto& o) { o.film.crop = PixelRect{0, 0, 1280, 720}; }).empty());
    for (const float radius : {0.0f, -1.0f, 17.0f, std::numeric_limits<float>::quiet_NaN()}) {
        CHECK(refusal([&](auto& o) { o.film.filter.radius = radius; }).find("filter radius is ") ==
              0);
    }
    for (const float clamp : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
        CHECK(refusal([&](auto& o) { o.film.clamp = clamp; }).find("clamp is ") == 0);
    }
    CHECK(refusal([](auto& o) { o.film.clamp = 1e-9f; }).empty());
    CHECK(refusal([](auto& o) { o.bidirectional.light_paths = -0.5; }) ==
          "light_paths is -0.5, not in [0, 4096]");
    CHECK(refusal([](auto& o) {
              o.bidirectional.light_paths = std::numeric_limits<double>::quiet_NaN();
          }).find("light_paths is ") == 0);
    CHECK(refusal([](auto& o) {
              o.bidirectional.connections = 1.5;
              o.bidirectional.connection_rays = 2.0;
          }) == "connection_rays is 2, but connections is 1.5, not a whole number above 0");
    CHECK(refusal([](auto& o) { o.bidirectional.connection_rays = -1.0; }) ==
          "connection_rays is -1, not in [0, 4096]");
    CHECK(refusal([](auto& o) { o.bidirectional.connections = 4097.0; }) ==
          "connections is 4097, not in [0, 4096]");
    CHECK(refusal([](auto& o) {
              o.bidirectional.light_paths = 0.0;
              o.bidirectional.connections = 1.0;
          }).find("connections is 1, but light_paths is 0") == 0);
    CHECK(refusal([](auto& o) {
              o.bidirectional.light_paths = 0.0;
              o.integrator = IntegratorKind::lt;
          }).find("light_paths is 0, but lt") == 0);
    CHECK(refusal([](auto& o) { o.bidirectional.light_paths = 0.0; }).empty());
    const std::string too_many = refusal([](auto& o) {
        o.bidirectional.light_paths = 2.5;
        o.bidirectional.light_path_memory = 1'000'000;
    });
    CHECK(too_many.find("2.5 shared light paths for each camera path (light_paths) may take") == 0);
    CHECK(too_many.find("(light_path_memory) of 1 MB") != std::string::npos);
    CHECK(refusal([](auto& o) {
              // So many that their bytes do not fit into 64 bits.
              o.film.width = 65536;
              o.film.height = 65536;
              o.transport.max_depth = 4096;
              o.bidirectional.light_paths = 4095.5;
          }).find("more than the limit (light_path_memory)") != std::string::npos);
    CHECK(refusal([](auto& o) {
              o.bidirectional.light_paths = 3.0;  // not shared
              o.bidirectional.light_path_memory = 1'000'000;
          }).empty());
    const auto vcm_refusal = [](const auto& change) {
        return refusal([&](auto& o) {
            o.integrator = IntegratorKind::vcm;
            o.film.width = 64;
            o.film.height = 64;
            change(o);
        });
    };
    CHECK(vcm_refusal([](auto&) {}).empty());
    CHECK(vcm_refusal([](auto& o) { o.bidirectional.merge_radius = -0.5; }) ==
          "merge_radius is -0.5, not in [0, 1]");
    CHECK(vcm_refusal([](auto& o) {
              o.bidirectional.merge_radius = std::numeric_limits<double>::quiet_NaN();
          }).find("merge_radius is ") == 0);
    for (const double alpha : {0.0, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
        CHECK(vcm_refusal([&](auto& o) {
                  o.bidirectional.merge_alpha = alpha;
              }).find("merge_alpha is ") == 0);
    }
    CHECK(vcm_refusal([](auto& o) { o.bidirectional.max_merges = -1; }).find("max_merges is -1") ==
          0);
    CHECK(vcm_refusal([](auto& o) { o.bidirectional.light_paths = 0.0; }) ==
          "light_paths is 0, but vcm needs light paths");
    for (const Heuristic heuristic : {Heuristic::cutoff, Heuristic::maximum, Heuristic::uniform}) {
        CHECK(vcm_refusal([&](auto& o) { o.transport.heuristic = heuristic; }) ==
              "vcm needs the heuristic power or balance");
    }
    CHECK(vcm_refusal([](auto& o) {
              o.bidirectional.light_path_memory = 1'000'000;
          }).find("1 shared light paths for each camera path") == 0);
    CHECK(refusal([](auto& o) { o.bidirectional.merge_radius = 7.0; }) ==  // also of bdpt
          "merge_radius is 7, not in [0, 1]");
    for (const float survival : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN()}) {
        CHECK(refusal([&](auto& o) {
                  o.transport.rr_survival = survival;
              }).find("rr_survival is ") == 0);
    }
    CHECK(refusal([](auto& o) { o.transport.rr_survival = 1.0f; }).empty());
    CHECK(refusal([](auto& o) { o.system.tile_size = 0; }).find("tile_size is 0") == 0);
    CHECK(refusal([](auto& o) { o.system.threads = -1; }).find("threads is -1") !=
          std::string::npos);
}

TEST_CASE("each number of the list of options is refused beyond its range, and taken at its ends",
          "[render]")
{
    int numbers = 0;
    const RenderOptions fresh = fresh_options();
    for_each_option(fresh, [&](const auto& option, const auto& value) {
        using T = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_arithmetic_v<T>) {
            const Range& range = option.info.range;
            const std::string name(option.name);
            const auto refused = [&](double number) {
                RenderOptions options = fresh_options();
                for_each_option(options, [&](const auto& other, auto& its) {
                    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(its)>, T>) {
                        its = other.name == name ? static_cast<T>(number) : its;
                    }
                });
                return message_of([&] { check_options(options); }, ErrorCode::usage);
            };
            CAPTURE(name);
            if (range.low > std::numeric_limits<int>::min()) {
                ++numbers;
                CHECK(refused(range.low - 1.0).starts_with(name + " is "));
                CHECK(refused(range.low).empty() == !range.low_is_excluded);
            }
            if (range.high < std::numeric_limits<int>::max()) {
                CHECK(refused(range.high + 1.0).starts_with(name + " is "));
            }
        }
    });
    CHECK(numbers >= 15);
}

TEST_CASE("the ends of ranges of floats are taken", "[render]")
{
    for (const float radius : {0.01f, 16.0f}) {
        CAPTURE(radius);
        CHECK(refusal([&](auto& o) { o.film.filter.radius = radius; }).empty());
    }
    for (const float height : {-1e15f, 1e15f}) {
        CHECK(refusal([&](auto& o) { o.film.ground_height = height; }).empty());
    }
}

TEST_CASE("cameras without a view are refused by name", "[render]")
{
    CameraDesc camera = test::room_camera();
    camera.name = "eye";
    check_camera(camera);
    CameraDesc flat = camera;
    flat.world_from_camera[2] = Vec4(0.0f);
    CHECK(
        message_of([&] { check_camera(flat); }, ErrorCode::invalid_input).find("camera \"eye\"") ==
        0);
    CameraDesc wide = camera;
    wide.vertical_fov = 3.2f;
    CHECK(message_of([&] { check_camera(wide); }, ErrorCode::invalid_input).find("3.2") !=
          std::string::npos);
    CameraDesc shifted = camera;
    shifted.shift.y = 101.0f;
    CHECK(message_of([&] { check_camera(shifted); }, ErrorCode::invalid_input) ==
          "camera \"eye\": shift is 101, not in [-100, 100]");
    CameraDesc oblong = camera;
    oblong.pixel_aspect = 0.0f;
    CHECK(message_of([&] { check_camera(oblong); }, ErrorCode::invalid_input) ==
          "camera \"eye\": pixel aspect is 0, not in [0.001, 1000]");
    CameraDesc far = camera;
    far.world_from_camera[3][1] = -2e15f;
    CHECK(message_of([&] { check_camera(far); }, ErrorCode::invalid_input)
              .find("beyond what rays reach") != std::string::npos);
    CameraDesc broken = camera;
    broken.world_from_camera[3][0] = std::numeric_limits<float>::quiet_NaN();
    CHECK(message_of([&] { check_camera(broken); }, ErrorCode::invalid_input).find("finite") !=
          std::string::npos);
}

}  // namespace bdpt::check_options_test
