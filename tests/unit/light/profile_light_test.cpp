
#include "catch.hpp"
#include "even_bins.h"
#include "light/delta_lights.h"
#include "math/elementary.h"
#include "scene_builder.h"
#include "statistics.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <vector>

namespace bdpt::profile_light_test {
namespace {

constexpr double full_sphere = 12.566370614359172;

/// The same in all directions, on the coarsest grid there is.
LightProfile even(float intensity)
{
    return {.polar_angles = {0.0f, pi}, .azimuths = {0.0f}, .intensities = {intensity, intensity}};
}

/// Uneven steps, bright and dark corners, no symmetry.
LightProfile lopsided()
{
    LightProfile profile{.polar_angles = {0.0f, 0.1f, 0.4f, 0.9f, 1.7f, 2.4f, pi},
                         .azimuths = {0.0f, 0.03f, 0.05f, 0.8f, 2.0f, 3.5f, 5.0f, 2.0f * pi},
                         .intensities = {}};
    for (int column = 0; column < 8; ++column) {
        for (int row = 0; row < 7; ++row) {
            const int spread = (3 * (column % 7) + 5 * row) % 7;
            profile.intensities.push_back(spread < 2 ? 0.0f : static_cast<float>(spread * spread));
        }
    }
    return profile;
}

/// A part of the turn only, which begins below 0; it is dark above, and so is one of its corners.
LightProfile wedge()
{
    return {.polar_angles = {0.5f, 1.0f, 1.2f},
            .azimuths = {-0.7f, 0.2f, 1.9f},
            .intensities = {1.0f, 2.0f, 3.0f, 8.0f, 0.5f, 0.0f, 0.0f, 4.0f, 0.0f}};
}

/// Fine all around, but with two polar angles only, so that there is one row of cells.
LightProfile striped()
{
    LightProfile profile{.polar_angles = {0.0f, pi}, .azimuths = {}, .intensities = {}};
    constexpr int columns = 150000;
    for (int column = 0; column <= columns; ++column) {
        const int phase = column % columns;
        profile.azimuths.push_back(2.0f * pi * static_cast<float>(column) / columns);
        const float bright = std::abs(static_cast<float>(phase) / columns - 0.5f);
        profile.intensities.insert(profile.intensities.end(), {bright, 2.0f * bright});
    }
    return profile;
}

/// A searchlight of half a degree.
LightProfile narrow()
{
    return {.polar_angles = {0.0f, 0.002f, 0.00873f},
            .azimuths = {0.0f},
            .intensities = {1e6f, 4e5f, 0.0f}};
}

Vec3 direction_of(double polar_angle, double azimuth)
{
    const double sine = std::sin(polar_angle);
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), -std::cos(polar_angle)};
}

Mat3 some_rotation()
{
    return Mat3(glm::rotate(Mat4(1.0f), 0.8f, Vec3(0.0f, 0.6f, 0.8f)));
}

}  // namespace

TEST_CASE("profile light: the same in all directions it is a point light", "[light]")
{
    const Rgb intensity(3.0f, 2.0f, 0.5f);
    const Vec3 position(0.3f, 1.0f, -2.0f);
    const IntensityProfile profile(even(1.0f));
    const ProfileLight light(
        {.position = position, .world_from_light = some_rotation(), .scale = intensity}, profile);
    const PunctualLight point(PointLightDesc{.position = position, .intensity = intensity});
    const auto same = [](Rgb a, Rgb b) {
        return glm::distance(a, b) < 1e-5f * std::max(glm::length(a), glm::length(b));
    };
    CHECK(same(light.power(), point.power()));
    test::Random random(51);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 receiver = position + random.direction() * (0.1f + 5.0f * random.next());
        const auto incident =
            light.sample_incident({.p = receiver}, {}, EnvironmentSampling::plain, 0.0f);
        const auto expected =
            point.sample_incident({.p = receiver}, {}, EnvironmentSampling::plain, 0.0f);
        REQUIRE(incident.has_value());
        REQUIRE(same(incident->weight, expected->weight));
        REQUIRE(incident->wi == expected->wi);
        const auto emitted = light.sample_emission({}, random.next_2d(), 0.0f);
        REQUIRE(emitted.has_value());
        REQUIRE(emitted->end.p == position);
        REQUIRE(glm::length(emitted->direction) == Approx(1.0f).epsilon(1e-6));
        // Rows of cells near the axis have few digits in their solid angle.
        REQUIRE(emitted->pdf_direction.value == Approx(0.25f * inv_pi).epsilon(1e-3));
        REQUIRE(same(emitted->weight * emitted->pdf_direction.value, intensity));
        REQUIRE(light.pdf_direction({}, emitted->direction, 0.0f).value ==
                Approx(0.25f * inv_pi).epsilon(1e-3));
    }
}

TEST_CASE("profile light: intensities are those of the grid, and bilinear in between", "[light]")
{
    const LightProfile grid = lopsided();
    const IntensityProfile profile(grid);
    for (std::size_t column = 0; column < grid.azimuths.size(); ++column) {
        for (std::size_t row = 1; row + 1 < grid.polar_angles.size(); ++row) {
            const auto polar = static_cast<double>(grid.polar_angles[row]);
            const auto azimuth = static_cast<double>(grid.azimuths[column]);
            const float expected = grid.intensities[column * 7 + row];
            CAPTURE(column, row);
            CHECK(profile.intensity(direction_of(polar, azimuth)) == Approx(expected).margin(1e-3));
        }
    }
    const float between =
        0.3f * (0.75f * grid.intensities[21 + 2] + 0.25f * grid.intensities[21 + 3]) +
        0.7f * (0.75f * grid.intensities[28 + 2] + 0.25f * grid.intensities[28 + 3]);
    CHECK(profile.intensity(direction_of(0.75 * 0.4 + 0.25 * 0.9, 0.3 * 0.8 + 0.7 * 2.0)) ==
          Approx(between).epsilon(1e-4));
    CHECK(profile.peak() == 36.0f);
}

TEST_CASE("profile light: beyond its angles it is dark", "[light]")
{
    const IntensityProfile profile(wedge());
    CHECK(profile.intensity(direction_of(1.0, -0.7)) == Approx(2.0f).epsilon(1e-3));
    CHECK(profile.intensity(direction_of(0.5, 0.2)) == Approx(8.0f).epsilon(1e-3));
    CHECK(profile.intensity(direction_of(0.75, 0.2)) == Approx(4.25f).epsilon(1e-3));
    for (const Vec3 dark :
         {direction_of(0.49, 0.2), direction_of(1.21, 0.2), direction_of(1.0, -0.72),
          direction_of(1.0, 1.92), direction_of(1.0, 4.0), Vec3(0, 0, -1), Vec3(0, 0, 1)}) {
        CHECK(profile.intensity(dark) == 0.0f);
        CHECK(profile.pdf(dark).value == 0.0f);
    }
}

TEST_CASE("profile light: a profile without light sends none", "[light]")
{
    const IntensityProfile black(even(0.0f));
    CHECK(black.flux() == 0.0f);
    CHECK_FALSE(black.sample({0.3f, 0.6f}).has_value());
    CHECK(black.pdf({0.0f, 0.0f, -1.0f}).value == 0.0f);
    // Angles too close for single precision.
    const IntensityProfile thin(
        {.polar_angles = {1.5f, 1.50000012f}, .azimuths = {0.0f}, .intensities = {1.0f, 1.0f}});
    CHECK_FALSE(thin.sample({0.3f, 0.6f}).has_value());
}

TEST_CASE("profile light: the flux is the integral of the intensity", "[light][long]")
{
    for (const LightProfile& grid : {lopsided(), wedge(), narrow(), striped()}) {
        const IntensityProfile profile(grid);
        const auto first = static_cast<double>(grid.polar_angles.front());
        const auto range = static_cast<double>(grid.polar_angles.back()) - first;
        constexpr int rows = 1500;
        constexpr int columns = 1500;
        double sum = 0.0;
        double density = 0.0;
        for (int row = 0; row < rows; ++row) {
            const double polar = first + range * (row + 0.5) / rows;
            const double part = std::sin(polar) * range / rows * 6.283185307179586 / columns;
            for (int column = 0; column < columns; ++column) {
                const Vec3 w = direction_of(polar, 6.283185307179586 * (column + 0.5) / columns);
                sum += part * static_cast<double>(profile.intensity(w));
                density += part * static_cast<double>(profile.pdf(w).value);
            }
        }
        CAPTURE(grid.polar_angles.size());
        CHECK(static_cast<double>(profile.flux()) == Approx(sum).epsilon(1e-3));
        CHECK(density == Approx(1.0).epsilon(2e-3));
    }
}

TEST_CASE("profile light: light leaves by its densities, which follow the intensity", "[light]")
{
    constexpr int samples = 200000;
    constexpr int steps = 8;
    for (const LightProfile& grid : {lopsided(), wedge()}) {
        const IntensityProfile profile(grid);
        const ProfileLight light({.world_from_light = some_rotation(), .scale = Rgb(2.0f)},
                                 profile);
        const auto bin_of_direction = [](Vec3 w) {
            return test::find_bin<2>(
                {0.5 + 0.5 * static_cast<double>(w.z),
                 test::turn(static_cast<double>(w.x), static_cast<double>(w.y))},
                steps);
        };
        std::vector<double> expected(steps * steps);
        constexpr int fine = 1536;
        double sum = 0.0;
        for (int i = 0; i < fine; ++i) {
            const double z = 2.0 * (i + 0.5) / fine - 1.0;
            for (int j = 0; j < fine; ++j) {
                const double phi = 6.283185307179586 * (j + 0.5) / fine;
                const double r = std::sqrt(1.0 - z * z);
                const Vec3 w(r * std::cos(phi), r * std::sin(phi), z);
                const double part = static_cast<double>(light.pdf_direction({}, w, 0.0f).value) *
                                    (full_sphere / (fine * fine));
                expected[bin_of_direction(w)] += part;
                sum += part;
            }
        }
        CHECK(sum == Approx(1.0).epsilon(3e-3));
        for (double& probability : expected) {
            probability /= sum;
        }
        test::Random random(52);
        std::vector<double> counts(expected.size());
        double heaviest = 0.0;
        int mismatches = 0;
        for (int i = 0; i < samples; ++i) {
            const auto emitted = light.sample_emission({}, random.next_2d(), 0.0f);
            REQUIRE(emitted.has_value());
            const float pdf = light.pdf_direction({}, emitted->direction, 0.0f).value;
            // Rounding takes a few directions over the edge of their cell.
            mismatches += std::abs(pdf / emitted->pdf_direction.value - 1.0f) < 1e-2f ? 0 : 1;
            counts[bin_of_direction(emitted->direction)] += 1.0;
            heaviest = std::max(heaviest, static_cast<double>(emitted->weight.r));
        }
        CHECK(mismatches < samples / 2000);
        test::check_counts(counts, expected);
        // Within a cell intensities differ, but no sample counts much more than the mean.
        CHECK(heaviest < 2.5 * 2.0 * static_cast<double>(profile.flux()));
    }
}

TEST_CASE("profile light: a narrow beam keeps its shape", "[light]")
{
    const IntensityProfile profile(narrow());
    test::Random random(53);
    test::Moments inside;
    for (int i = 0; i < 20000; ++i) {
        const auto sample = profile.sample(random.next_2d());
        REQUIRE(sample.has_value());
        const auto angle = std::atan2(std::hypot(static_cast<double>(sample->direction.x),
                                                 static_cast<double>(sample->direction.y)),
                                      -static_cast<double>(sample->direction.z));
        REQUIRE(angle < 0.008731);
        const double expected =
            angle < 0.002 ? 1e6 - angle / 0.002 * 6e5 : 4e5 * (0.00873 - angle) / (0.00873 - 0.002);
        REQUIRE(static_cast<double>(sample->intensity) == Approx(expected).epsilon(2e-3).margin(5));
        inside.add(static_cast<double>(sample->intensity / sample->pdf.value));
    }
    CHECK(std::abs(inside.mean() - static_cast<double>(profile.flux())) <
          4.0 * inside.standard_error());
    CHECK(inside.standard_error() < 0.01 * inside.mean());
}

TEST_CASE("profile light: the node turns it, and mirrors it", "[light]")
{
    const IntensityProfile profile(wedge());
    const Vec3 bright = direction_of(0.5, 0.2);
    for (const float mirror : {1.0f, -1.0f}) {
        Mat3 turned = some_rotation();
        turned[1] *= mirror;
        const ProfileLight light({.position = Vec3(1.0f), .world_from_light = turned}, profile);
        const auto lit = light.sample_incident({.p = Vec3(1.0f) + 2.0f * (turned * bright)}, {},
                                               EnvironmentSampling::plain, 0.0f);
        REQUIRE(lit.has_value());
        CHECK(lit->weight.r == Approx(2.0f).epsilon(2e-3));
        CHECK_FALSE(light
                        .sample_incident({.p = Vec3(1.0f) - 2.0f * (turned * bright)}, {},
                                         EnvironmentSampling::plain, 0.0f)
                        .has_value());
        CHECK(light.pdf_direction({}, turned * bright, 0.0f).value > 0.0f);
        test::Random random(54);
        for (int i = 0; i < 1000; ++i) {
            const auto emitted = light.sample_emission({}, random.next_2d(), 0.0f);
            REQUIRE(emitted.has_value());
            const float local = profile.intensity(transpose(turned) * emitted->direction);
            REQUIRE(emitted->weight.r * emitted->pdf_direction.value ==
                    Approx(local).epsilon(2e-3).margin(1e-3));
        }
    }
}

}  // namespace bdpt::profile_light_test
