#include "options/groups/camera_arguments.h"

#include <bdpt/thin_lens.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "options/arguments.h"
#include "options/values/value_types.h"

namespace bdpt::app {
namespace {

constexpr std::array<std::string_view, 3> framing_options{"--view", "--margin", "--ortho"};

double radians(double degrees)
{
    return degrees * std::numbers::pi / 180.0;
}

ValueType<float> field_of_view()
{
    const auto parse = [](const std::string& text) -> std::optional<float> {
        const std::optional<double> degrees = decimal_number(text);
        if (!degrees || !(*degrees > 0.0 && *degrees < 180.0)) {
            return std::nullopt;
        }
        return static_cast<float>(radians(*degrees));
    };
    return {.parse = parse,
            .expected = "degrees between 0 and 180",
            .info = {.json = JsonType::number, .range = {.low = 0, .low_is_excluded = true}}};
}

/// Accepts a focal length in millimetres, as the vertical field of view.
ValueType<float> focal_length()
{
    constexpr double shortest = 1.0;
    constexpr double longest = 10'000.0;
    const auto parse = [](const std::string& text) -> std::optional<float> {
        const std::optional<double> length = decimal_number(text);
        if (!length || !(*length >= shortest && *length <= longest)) {
            return std::nullopt;
        }
        return static_cast<float>(compute_vertical_fov(1e-3 * *length));
    };
    return {.parse = parse,
            .expected = "millimetres from 1 to 10000",
            .info = {.json = JsonType::number, .range = {.low = shortest, .high = longest}}};
}

ValueType<ViewDirection> view_direction()
{
    static constexpr float quarter = std::numbers::pi_v<float> / 2.0f;
    static constexpr std::array<std::pair<std::string_view, ViewDirection>, 7> named{{
        {"front", {0.0f, 0.0f}},
        {"right", {quarter, 0.0f}},
        {"back", {2.0f * quarter, 0.0f}},
        {"left", {-quarter, 0.0f}},
        {"top", {0.0f, quarter}},
        {"bottom", {0.0f, -quarter}},
        {"three-quarter", three_quarter_view},
    }};
    const auto parse = [](const std::string& given) -> std::optional<ViewDirection> {
        const std::string text = lower_case(given);
        for (const auto& [name, direction] : named) {
            if (text == name) {
                return direction;
            }
        }
        const std::size_t comma = text.find(',');
        if (comma == std::string::npos) {
            return std::nullopt;
        }
        const auto azimuth = decimal_number(text.substr(0, comma));
        const auto elevation = decimal_number(text.substr(comma + 1));
        if (!azimuth || !elevation || !(std::abs(*azimuth) <= 360.0) ||
            !(std::abs(*elevation) <= 90.0)) {
            return std::nullopt;
        }
        return ViewDirection{.azimuth = static_cast<float>(radians(*azimuth)),
                             .elevation = static_cast<float>(radians(*elevation))};
    };
    ValueType<ViewDirection> type{
        .parse = parse,
        .expected =
            "front, right, back, left, top, bottom, three-quarter, or AZIMUTH,ELEVATION "
            "in degrees with an azimuth from -360 to 360 and an elevation from -90 to 90",
        .info = {}};
    return type;
}

ValueType<float> margin()
{
    constexpr double widest = 45.0;
    const auto parse = [](const std::string& text) -> std::optional<float> {
        const std::optional<double> percent =
            decimal_number(text.ends_with('%') ? text.substr(0, text.size() - 1) : text);
        if (!percent || !(*percent >= 0.0 && *percent <= widest)) {
            return std::nullopt;
        }
        return static_cast<float>(*percent / 100.0);
    };
    return {.parse = parse, .expected = "percent from 0 to 45, like 10%", .info = {}};
}

}  // namespace

void add_camera_options(OptionList& options, std::optional<std::string>& camera,
                        ViewOverrides& view)
{
    options.add("--camera", "NAME|INDEX|auto",
                "Camera of the scene, or auto to frame all of it. Default: the first", camera,
                any_text());
    options.add("--view", "SIDE|AZIMUTH,ELEVATION",
                "Frame the whole scene from the front (+z), right (+x), back, left, top, bottom or "
                "three-quarter, or by angles [degrees]: azimuth from the front to the right, "
                "elevation upwards",
                view.direction, view_direction());
    options.add("--margin", "M%",
                "Frame the whole scene with this margin on each side, relative to width and "
                "height. Default: 10%",
                view.margin, margin());
    const Choices<Projection> projections{
        {{"true", Projection::orthographic}, {"false", Projection::perspective}}};
    options.add_flag("--ortho", "Frame the whole scene with an orthographic camera",
                     view.projection, projections.type());
    options.add("--from", "X,Y,Z", "Position of the camera [m]", view.from, point());
    options.add("--look-at", "X,Y,Z", "Point that the camera looks at [m]", view.look_at, point());
    options.add("--fov", "DEG", "Vertical field of view [degrees]", view.vertical_fov,
                field_of_view());
    options.add("--focal-length", "MM",
                "Field of view by focal length, for a sensor 24 mm high [mm]",
                view.vertical_fov, focal_length());
}

void check_camera_options(const OptionList& options, const std::optional<std::string>& camera)
{
    static constexpr std::array conflicts{Conflict{"--focal-length", "--fov"},
                                          Conflict{"--ortho", "--fov"},
                                          Conflict{"--ortho", "--focal-length"}};
    check(conflicts, options);
    for (const std::string_view framing : framing_options) {
        const std::array others{Conflict{framing, "--from"}, Conflict{framing, "--look-at"},
                                Conflict{framing, "--cameras"}};
        check(others, options);
        if (options.given(framing) && camera && *camera != "auto") {
            throw OptionError(fmt::format(
                "{} frames the whole scene and cannot be combined with --camera \"{}\"", framing,
                *camera));
        }
    }
}

}  // namespace bdpt::app
