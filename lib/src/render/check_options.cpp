#include "render/check_options.h"

#include "geometry/coordinate_limit.h"
#include "math/elementary.h"
#include "render/check_light_paths.h"

#include <bdpt/error.h>
#include <bdpt/integrators.h>
#include <bdpt/motion.h>
#include <bdpt/part/sample_rates.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>

namespace bdpt {
namespace {

constexpr int max_film_side = 1 << 16;
constexpr int max_threads = 4096;
constexpr int max_path_edges = 4096;

void check_range(const char* what, std::int64_t value, std::int64_t low, std::int64_t high)
{
    if (value < low || value > high) {
        throw Error(ErrorCode::usage, std::string(what) + " is " + std::to_string(value) +
                                          ", not in [" + std::to_string(low) + ", " +
                                          std::to_string(high) + "]");
    }
}

void check_crop(const PixelRect& crop, int width, int height)
{
    const bool inside = crop.x0 >= 0 && crop.y0 >= 0 && crop.x1 <= width && crop.y1 <= height;
    if (!inside || crop.x0 >= crop.x1 || crop.y0 >= crop.y1) {
        throw Error(ErrorCode::usage,
                    "crop " + std::to_string(crop.x0) + "," + std::to_string(crop.y0) + "," +
                        std::to_string(crop.x1) + "," + std::to_string(crop.y1) +
                        " is empty or not inside of the image of " + std::to_string(width) + "x" +
                        std::to_string(height) + " pixels");
    }
}

void check_rates(const RenderOptions& options)
{
    const SampleRates* rates = options.sampling.rates.get();
    if (rates == nullptr) {
        return;
    }
    if (rates->width() != options.film.width || rates->height() != options.film.height) {
        throw Error(ErrorCode::usage, "rates of samples are those of an image of " +
                                          std::to_string(rates->width()) + "x" +
                                          std::to_string(rates->height()) + " pixels, not of " +
                                          std::to_string(options.film.width) + "x" +
                                          std::to_string(options.film.height));
    }
    check_takes_rates(options.integrator);
    const SampleRange& samples = options.sampling.samples;
    check_range("last round with rates of samples", samples.end, 1,
                std::int64_t{1} << (32 - SampleRates::greatest_exponent));
    for (const std::int64_t border : {samples.begin, samples.end}) {
        if (border % SampleRates::group != 0) {
            throw Error(
                ErrorCode::usage,
                "samples begin or end at " + std::to_string(border) +
                    ", but with rates of samples (adaptive sampling) only at multiples of " +
                    std::to_string(SampleRates::group));
        }
    }
}

void check_filter(const FilterOptions& filter)
{
    constexpr float least = 0.01f;
    constexpr float most = 16.0f;
    const float radius = filter.radius.value_or(default_radius(filter.kind));
    if (!(radius >= least && radius <= most)) {
        throw Error(ErrorCode::usage,
                    "filter radius is " + std::to_string(radius) + " pixels, not in [0.01, 16]");
    }
}

void check_within_limit(const std::string& item, const char* what, float value)
{
    if (!(std::abs(value) <= greatest_coordinate)) {
        throw Error(ErrorCode::invalid_input, item + ": " + what + " is " + std::to_string(value) +
                                                  " m, beyond what rays reach");
    }
}

/// Of a camera called `item`.
void check_pose(const std::string& item, const Mat4& world_from_camera)
{
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(world_from_camera[column][row])) {
                throw Error(ErrorCode::invalid_input, item + ": transform is not finite");
            }
        }
    }
    for (int row = 0; row < 3; ++row) {
        check_within_limit(item, "position", world_from_camera[3][row]);
    }
    const Vec3 side = cross(Vec3(world_from_camera[1]), Vec3(world_from_camera[2]));
    if (!(dot(side, side) > 0.0f)) {
        throw Error(ErrorCode::invalid_input, item + ": transform has no inverse");
    }
}

void check_motion(const std::string& item, const CameraDesc& camera)
{
    if (camera.motion.size() > most_time_steps) {
        throw Error(ErrorCode::invalid_input,
                    item + ": motion of " + std::to_string(camera.motion.size()) + " steps, but " +
                        std::to_string(most_time_steps) + " is the most");
    }
    for (std::size_t i = 0; i < camera.motion.size(); ++i) {
        const std::string step = item + ": motion, step " + std::to_string(i);
        check_pose(step, camera.motion[i]);
        if (!can_move(i == 0 ? camera.world_from_camera : camera.motion[i - 1], camera.motion[i])) {
            throw Error(ErrorCode::invalid_input,
                        step + ": on the way to it some transform has no inverse; give more steps");
        }
    }
}

std::string label(const CameraDesc& camera)
{
    return camera.name.empty() ? std::string("camera") : "camera \"" + camera.name + "\"";
}

}  // namespace

void check_options(const RenderOptions& options)
{
    check_range("image width", options.film.width, 1, max_film_side);
    check_range("image height", options.film.height, 1, max_film_side);
    if (options.film.crop) {
        check_crop(*options.film.crop, options.film.width, options.film.height);
    }
    check_filter(options.film.filter);
    if (const auto height = options.film.ground_height;
        height && !(std::abs(*height) <= greatest_coordinate)) {
        throw Error(ErrorCode::usage, "height of the ground is " + std::to_string(*height) +
                                          " m, beyond what rays reach");
    }
    if (!(options.film.clamp > 0.0f)) {
        throw Error(ErrorCode::usage,
                    "clamp is " + std::to_string(options.film.clamp) + " nit, not above 0");
    }
    // Sample indices have 32 bits in the film's record of defects.
    check_range("first sample", options.sampling.samples.begin, 0,
                std::numeric_limits<std::uint32_t>::max());
    check_range("number of samples", options.sampling.samples.end - options.sampling.samples.begin,
                1, std::numeric_limits<std::uint32_t>::max() - options.sampling.samples.begin);
    check_range("longest path (max_depth)", options.transport.max_depth, 1, max_path_edges);
    check_range("shortest path (min_depth)", options.transport.min_depth, 1,
                options.transport.max_depth);
    check_range("longest camera subpath", options.bidirectional.max_camera_depth, 0,
                std::numeric_limits<int>::max());
    check_range("longest light subpath", options.bidirectional.max_light_depth, 0,
                std::numeric_limits<int>::max());
    check_range("start of Russian roulette", options.transport.rr_start, 1,
                std::numeric_limits<int>::max());
    if (!(options.transport.rr_survival >= 0.0f && options.transport.rr_survival <= 1.0f)) {
        throw Error(ErrorCode::usage, "least survival of Russian roulette is " +
                                          std::to_string(options.transport.rr_survival) +
                                          ", not in [0, 1]");
    }
    for (const Strategy& strategy : options.bidirectional.disabled) {
        check_range("disabled strategy's s", strategy.s, 0, max_path_edges + 1);
        check_range("disabled strategy's t", strategy.t, 0, max_path_edges + 1);
    }
    check_range("longest path with images of strategies", options.bidirectional.strategy_depth, 0,
                max_path_edges);
    if (options.bidirectional.strategy_depth > 0 && !info(options.integrator).has_strategies) {
        throw Error(ErrorCode::usage,
                    "images of strategies (strategy_depth) need the integrator bdpt or lt");
    }
    check_range("number of light samples", options.sampling.light_samples, 1, 1024);
    check_range("tile size", options.system.tile_size, 1, max_film_side);
    check_range("number of threads", options.system.threads, 0, max_threads);
    check_light_paths(options);
    check_rates(options);
}

void check_takes_rates(IntegratorKind integrator)
{
    if (integrator == IntegratorKind::lt || integrator == IntegratorKind::vcm) {
        throw Error(ErrorCode::usage, "rates of samples do not go with the integrator " +
                                          std::string(info(integrator).name));
    }
}

void check_camera(const CameraDesc& camera)
{
    const std::string item = label(camera);
    const auto check_coordinates = [&](const char* what, float value) {
        check_within_limit(item, what, value);
    };
    check_pose(item, camera.world_from_camera);
    check_motion(item, camera);
    const auto check_length = [&](const char* what, float value, bool zero_is_fine) {
        if (!(value > 0.0f || (zero_is_fine && value == 0.0f)) || !std::isfinite(value)) {
            throw Error(ErrorCode::invalid_input,
                        item + ": " + what + " is " + std::to_string(value) + " m");
        }
    };
    check_length("lens radius", camera.lens_radius, true);
    check_length("focus distance", camera.focus_distance, false);
    check_length("vertical extent", camera.vertical_extent, false);
    check_coordinates("lens radius", camera.lens_radius);
    check_coordinates("vertical extent", camera.vertical_extent);
    if (!(camera.vertical_fov > 0.0f && camera.vertical_fov < pi)) {
        throw Error(ErrorCode::invalid_input, item + ": vertical field of view is " +
                                                  std::to_string(camera.vertical_fov) +
                                                  " rad, not in (0, pi)");
    }
}

void check_camera_distance(const CameraDesc& camera, float farthest)
{
    const auto check = [&](const Mat4& world_from_camera) {
        const Vec3 position = abs(Vec3(world_from_camera[3]));
        const float distance = std::max({position.x, position.y, position.z});
        if (!(distance <= farthest)) {
            std::ostringstream text;
            text << label(camera) << ": is " << distance << " m from the origin, but " << farthest
                 << " m is the most in this scene, as a mesh that is used more than once or moves "
                    "is "
                    "scaled down very much";
            throw Error(ErrorCode::invalid_input, text.str());
        }
    };
    check(camera.world_from_camera);
    for (const Mat4& later : camera.motion) {
        check(later);
    }
}

}  // namespace bdpt
