#pragma once

#include "catch.hpp"
#include "material/bsdf_model.h"
#include "math/frame.h"
#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

namespace bdpt::test {

// Bins of the sphere of directions: each hemisphere has rings about the axis where its lobe stands,
// cut by azimuth. The angle from the axis is pi t^3, so that lobes of a thousandth of a radian
// spread over several bins.
inline constexpr int rings = 14;
inline constexpr int sectors = 10;
inline constexpr int bins_per_side = rings * sectors;
inline constexpr double exact_pi = 3.14159265358979323846;

struct Axes {
    Frame reflection;  ///< on the side of wo
    Frame transmission;
    bool wo_above;
};

/// `ior` is that of a solid body, if light is refracted.
[[nodiscard]] inline Axes axes_of(std::optional<float> ior, Vec3 wo)
{
    Vec3 through = -wo;
    if (ior) {
        const float eta = wo.z > 0.0f ? 1.0f / *ior : *ior;
        const float sin2 = eta * eta * (1.0f - wo.z * wo.z);
        if (sin2 < 1.0f) {
            through = {-eta * wo.x, -eta * wo.y, std::copysign(std::sqrt(1.0f - sin2), -wo.z)};
        }
    }
    return {Frame::from_normal({-wo.x, -wo.y, wo.z}), Frame::from_normal(normalize(through)),
            wo.z > 0.0f};
}

[[nodiscard]] inline std::size_t bin_of(const Axes& axes, Vec3 wi)
{
    const bool reflected = (wi.z > 0.0f) == axes.wo_above;
    const Vec3 local = (reflected ? axes.reflection : axes.transmission).to_local(wi);
    const double sine = std::hypot(static_cast<double>(local.x), static_cast<double>(local.y));
    const double angle = std::atan2(sine, static_cast<double>(local.z));
    const double turn = std::atan2(static_cast<double>(local.y), static_cast<double>(local.x));
    const auto ring = std::min(rings - 1, static_cast<int>(std::cbrt(angle / exact_pi) * rings));
    const auto sector =
        std::min(sectors - 1, static_cast<int>((turn / (2.0 * exact_pi) + 0.5) * sectors));
    return static_cast<std::size_t>((reflected ? 0 : bins_per_side) + ring * sectors + sector);
}

/// Integral of the density over each bin by midpoints, and in the last one what is left: delta
/// lobes and no sample at all.
template <typename Scattering>
[[nodiscard]] std::vector<double> bin_probabilities(const Scattering& bsdf, const Axes& axes,
                                                    Vec3 wo)
{
    constexpr int fine = 16;  // midpoints along each side of a bin
    std::vector<double> result(2 * bins_per_side + 1);
    for (int side = 0; side < 2; ++side) {
        const Frame& frame = side == 0 ? axes.reflection : axes.transmission;
        for (int i = 0; i < rings * fine; ++i) {
            const double t = (i + 0.5) / (rings * fine);
            const double angle = exact_pi * t * t * t;
            const double solid_angle = std::sin(angle) * 3.0 * exact_pi * t * t / (rings * fine) *
                                       2.0 * exact_pi / (sectors * fine);
            for (int j = 0; j < sectors * fine; ++j) {
                const double turn = ((j + 0.5) / (sectors * fine) - 0.5) * 2.0 * exact_pi;
                const Vec3 wi =
                    frame.to_world(Vec3(std::sin(angle) * std::cos(turn),
                                        std::sin(angle) * std::sin(turn), std::cos(angle)));
                if (((wi.z > 0.0f) == axes.wo_above) != (side == 0)) {
                    continue;
                }
                const float pdf = bsdf.eval(wo, wi, TransportMode::radiance).pdf_fwd.value;
                result[static_cast<std::size_t>(side * bins_per_side + i / fine * sectors +
                                                j / fine)] +=
                    static_cast<double>(pdf) * solid_angle;
            }
        }
    }
    const double rest = 1.0 - std::accumulate(result.begin(), result.end(), 0.0);
    REQUIRE(rest > -0.005);
    result.back() = rest;
    // A corner of the lobe that lies between the midpoints must not look impossible.
    constexpr double least = 1e-7;
    for (double& probability : result) {
        probability = std::max(probability, least);
    }
    return result;
}

/// Where `samples` directions of a walk from wo went, by bins; the last one as above.
template <typename Scattering>
[[nodiscard]] std::vector<double> bin_counts(const Scattering& bsdf, const Axes& axes, Vec3 wo,
                                             int samples)
{
    std::vector<double> counts(2 * bins_per_side + 1);
    Random random(29);
    for (int i = 0; i < samples; ++i) {
        const float u_lobe = random.next();
        const auto sampled = bsdf.sample(wo, u_lobe, random.next_2d(), TransportMode::radiance);
        const bool in_density = sampled && !sampled->delta;
        counts[in_density ? bin_of(axes, sampled->wi) : counts.size() - 1] += 1.0;
    }
    return counts;
}

}  // namespace bdpt::test
