#include "ies/ies.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace bdpt::io {

namespace {

// Exporters write angles with a few decimals; less than the smallest step of angles.
constexpr double tolerance = 1e-3;  // [degrees]

bool is(double angle, double wanted)
{
    return std::abs(angle - wanted) <= tolerance;
}

/// Snaps the ends of a range of angles to right angles that they nearly equal.
void snap_ends(std::vector<double>& angles)
{
    for (double* end : {&angles.front(), &angles.back()}) {
        const double right = 90.0 * std::round(*end / 90.0);
        *end = is(*end, right) ? right : *end;
    }
}

/// Intensities over two angles [degrees]; `values[i]` are those of all `across` at `along[i]`.
struct Web {
    std::vector<double> along;
    std::vector<double> across;
    std::vector<std::vector<float>> values;
};

[[noreturn]] void refuse(std::string_view what, const std::vector<double>& angles)
{
    throw Error(ErrorCode::invalid_input, fmt::format("{} angles go from {} to {} degrees", what,
                                                      angles.front(), angles.back()));
}

/// Adds the mirror images of the angles beyond the last one.
void mirror_at_end(std::vector<double>& angles, std::vector<std::vector<float>>& values)
{
    const double last = angles.back();
    for (std::size_t i = angles.size() - 1; i-- > 0;) {
        angles.push_back(2.0 * last - angles[i]);
        values.push_back(values[i]);
    }
}

/// Adds the mirror images of the angles below the first one.
void mirror_at_begin(std::vector<double>& angles, std::vector<std::vector<float>>& values)
{
    std::vector<double> all;
    std::vector<std::vector<float>> all_values;
    for (std::size_t i = angles.size(); i-- > 1;) {
        all.push_back(2.0 * angles.front() - angles[i]);
        all_values.push_back(values[i]);
    }
    all.insert(all.end(), angles.begin(), angles.end());
    all_values.insert(all_values.end(), values.begin(), values.end());
    angles = std::move(all);
    values = std::move(all_values);
}

/// Swaps rows and columns.
Web transposed(const Web& web)
{
    Web result{web.across, web.along, {}};
    result.values.assign(web.across.size(), std::vector<float>(web.along.size()));
    for (std::size_t i = 0; i < web.along.size(); ++i) {
        for (std::size_t k = 0; k < web.across.size(); ++k) {
            result.values[k][i] = web.values[i][k];
        }
    }
    return result;
}

/// Returns the web as stored in the file: along the horizontal angles.
Web make_web(const IesFile& file)
{
    Web web{file.horizontal_angles, file.vertical_angles, {}};
    const auto rows = static_cast<std::ptrdiff_t>(file.vertical_angles.size());
    for (auto row = file.candelas.begin(); row != file.candelas.end(); row += rows) {
        web.values.emplace_back(row, row + rows);
    }
    return web;
}

float to_radians(double degrees)
{
    constexpr double radian = 0.017453292519943295;
    return static_cast<float>(degrees * radian);
}

/// Converts `web`, along azimuths and across polar angles, to a profile.
LightProfile to_profile(const Web& web)
{
    LightProfile profile;
    for (const double angle : web.across) {
        profile.polar_angles.push_back(to_radians(angle));
    }
    for (const double angle : web.along) {
        profile.azimuths.push_back(to_radians(angle));
    }
    for (const std::vector<float>& row : web.values) {
        profile.intensities.insert(profile.intensities.end(), row.begin(), row.end());
    }
    return profile;
}

/// Converts type C: the nadir is -z, and horizontal angles turn from +x to +y, as in a profile.
IesProfile from_type_c(Web web, const std::string& place, Warnings& warnings)
{
    if (web.across.front() < 0.0 || web.across.back() > 180.0) {
        refuse("vertical", web.across);
    }
    const double first = web.along.front();
    const double last = web.along.back();
    if (web.along.size() == 1) {
        return {to_profile(web)};
    }
    const bool quadrant = is(first, 0.0) && is(last, 90.0);
    const bool half = (is(first, 0.0) && is(last, 180.0)) || (is(first, 90.0) && is(last, 270.0));
    if (quadrant || half) {
        mirror_at_end(web.along, web.values);
        if (quadrant) {
            mirror_at_end(web.along, web.values);
        }
    } else if (is(first, 0.0) && last > 180.0 && last < 360.0) {
        warnings.add("horizontal angles of a light profile end below 360 degrees and are closed",
                     fmt::format("{}: the last is {} degrees", place, last));
        web.along.push_back(360.0);
        web.values.push_back(std::vector<float>(web.values.front()));
    } else if (!is(first, 0.0) || !is(last, 360.0)) {
        refuse("horizontal", web.along);
    }
    return {to_profile(web)};
}

/// Checks that angles stay within a quarter of a turn to all sides, and mirrors a range that begins
/// at 0, which is half of a symmetric one.
void complete(std::string_view what, std::vector<double>& angles,
              std::vector<std::vector<float>>& values)
{
    if (angles.size() < 2 || angles.front() < -90.0 || angles.back() > 90.0) {
        refuse(what, angles);
    }
    if (is(angles.front(), 0.0)) {
        mirror_at_begin(angles, values);
    }
}

/// Converts type B: planes through a common horizontal axis. Angles of planes turn from -z to +x,
/// angles within planes point to -y: they grow clockwise, as seen from above.
IesProfile from_type_b(Web web)
{
    complete("horizontal", web.along, web.values);
    Web planes = transposed(web);
    complete("vertical", planes.along, planes.values);
    for (double& angle : planes.across) {
        angle += 90.0;
    }
    return {to_profile(planes), Mat3(Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, -1, 0))};
}

/// Converts type A: planes through a common vertical axis, +x. Angles of planes turn from -z to -y.
IesProfile from_type_a(Web web)
{
    complete("horizontal", web.along, web.values);
    Web rows = transposed(web);
    complete("vertical", rows.along, rows.values);
    // Polar angles go down from the top.
    Web turned{web.along, {}, {}};
    std::vector<std::vector<float>> downwards(rows.values.rbegin(), rows.values.rend());
    for (auto angle = rows.along.rbegin(); angle != rows.along.rend(); ++angle) {
        turned.across.push_back(90.0 - *angle);
    }
    turned.values = transposed({turned.across, turned.along, std::move(downwards)}).values;
    return {to_profile(turned), Mat3(Vec3(0, 0, -1), Vec3(0, -1, 0), Vec3(-1, 0, 0))};
}

}  // namespace

IesProfile make_profile(const IesFile& file, const std::string& place, Warnings& warnings)
{
    Web web = make_web(file);
    snap_ends(web.along);
    snap_ends(web.across);
    switch (file.photometry) {
        case Photometry::b:
            return from_type_b(std::move(web));
        case Photometry::a:
            return from_type_a(std::move(web));
        case Photometry::c:
            break;
    }
    return from_type_c(std::move(web), place, warnings);
}

}  // namespace bdpt::io
