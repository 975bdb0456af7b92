#include "material/lobes/fresnel.h"

#include "catch.hpp"
#include "math/rgb.h"

#include <cmath>
#include <complex>

namespace bdpt::test::thin_film_test {
namespace {

constexpr double exact_pi = 3.14159265358979323846;

/// Airy's formula at normal incidence for one wavelength [nm]: air, film, base.
double airy(double film, double base, double thickness, double wavelength)
{
    const double r_outer = (1.0 - film) / (1.0 + film);
    const double r_inner = (film - base) / (film + base);
    const std::complex<double> way =
        std::polar(1.0, 4.0 * exact_pi * film * thickness / wavelength);
    return std::norm((r_outer + r_inner * way) / (1.0 + r_outer * r_inner * way));
}

/// The same at an angle, for unpolarised light.
double airy_at(double cosine, double film, double base, double thickness, double wavelength)
{
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const double cos_film = std::sqrt(1.0 - sine * sine / (film * film));
    const double cos_base = std::sqrt(1.0 - sine * sine / (base * base));
    const std::complex<double> way =
        std::polar(1.0, 4.0 * exact_pi * film * thickness * cos_film / wavelength);
    const auto reflected = [&](double outer, double inner) {
        return std::norm((outer + inner * way) / (1.0 + outer * inner * way));
    };
    const double s =
        reflected((cosine - film * cos_film) / (cosine + film * cos_film),
                  (film * cos_film - base * cos_base) / (film * cos_film + base * cos_base));
    const double p =
        reflected((cos_film - film * cosine) / (cos_film + film * cosine),
                  (film * cos_base - base * cos_film) / (film * cos_base + base * cos_film));
    return 0.5 * (s + p);
}

double f0_of(double index)
{
    return (index - 1.0) * (index - 1.0) / ((index + 1.0) * (index + 1.0));
}

}  // namespace

TEST_CASE("a film reflects as Airy's formula says")
{
    // Channels are broad: they see the formula's mean over the wavelengths that they take up. At
    // this thickness the film reflects much of red and little of blue, or the other way round.
    for (const double base : {1.5, 3.0}) {
        for (const double thickness : {80.0, 150.0, 220.0}) {
            CAPTURE(base, thickness);
            const ThinFilm film{1.0f, 2.0f, static_cast<float>(thickness)};
            const Rgb found = film.reflectance(1.0f, Rgb(static_cast<float>(f0_of(base))));
            const double red = airy(2.0, base, thickness, 610.0);
            const double green = airy(2.0, base, thickness, 545.0);
            const double blue = airy(2.0, base, thickness, 455.0);
            CHECK(static_cast<double>(found.r) == Approx(red).margin(0.07));
            CHECK(static_cast<double>(found.g) == Approx(green).margin(0.07));
            CHECK(static_cast<double>(found.b) == Approx(blue).margin(0.07));
            if (std::abs(red - blue) > 0.1) {
                CHECK((found.r > found.b) == (red > blue));
            }
        }
    }
}

TEST_CASE("a thick film loses its colours, one without thickness is not there")
{
    const Rgb f0(0.04f);
    // Incoherent sums over the reflections of both interfaces.
    const double outer = f0_of(2.0);
    const double inner = 0.5 * 0.5 / (3.5 * 3.5);
    const double mean = outer + (1.0 - outer) * (1.0 - outer) * inner / (1.0 - outer * inner);
    const Rgb thick = ThinFilm{1.0f, 2.0f, 1e5f}.reflectance(1.0f, f0);
    CHECK(static_cast<double>(thick.r) == Approx(mean).epsilon(1e-3));
    CHECK(static_cast<double>(thick.b) == Approx(mean).epsilon(1e-3));
    for (const float bare : {0.04f, 0.3f, 0.9f}) {
        const Rgb none = ThinFilm{1.0f, 2.0f, 0.0f}.reflectance(1.0f, Rgb(bare));
        CHECK(none.g == Approx(bare).margin(0.02));
    }
}

TEST_CASE("colours of a film move to shorter waves at an angle")
{
    // 2 n d cos = 550 nm at normal incidence is constructive for green on a denser base (both
    // reflections turn the wave): seen from the side it is blue that comes back.
    const ThinFilm film{1.0f, 1.4f, 550.0f / (2.0f * 1.4f)};
    const Rgb base(static_cast<float>(f0_of(2.5)));
    const Rgb straight = film.reflectance(1.0f, base);
    const Rgb slanted = film.reflectance(0.5f, base);
    CHECK(straight.g > straight.b);
    CHECK(slanted.b > slanted.r);
}

TEST_CASE("at an angle waves differ by their way within the film")
{
    // At 45 degrees the cosine within is 0.93, that outside 0.7. Schlick's approximation stands for
    // Fresnel's equations, so that only the colours are compared: channels over their mean.
    for (const double thickness : {110.0, 150.0}) {
        CAPTURE(thickness);
        const ThinFilm film{1.0f, 2.0f, static_cast<float>(thickness)};
        const Rgb found = film.reflectance(0.7f, Rgb(static_cast<float>(f0_of(1.5))));
        const double red = airy_at(0.7, 2.0, 1.5, thickness, 610.0);
        const double blue = airy_at(0.7, 2.0, 1.5, thickness, 455.0);
        const auto share = [](double a, double b) { return (a - b) / (a + b); };
        CHECK(share(static_cast<double>(found.r), static_cast<double>(found.b)) ==
              Approx(share(red, blue)).margin(0.2));
    }
}

TEST_CASE("a film reflects no more than its bound, and between nothing and everything")
{
    for (const float ior : {1.0f, 1.3f, 1.8f, 2.5f}) {
        for (const float f0 : {0.0f, 0.04f, 0.2f, 0.7f, 1.0f}) {
            for (float cosine = 0.0f; cosine <= 1.0f; cosine += 0.125f) {
                for (float thickness = 0.0f; thickness < 1500.0f; thickness += 17.0f) {
                    const ThinFilm film{1.0f, ior, thickness};
                    const Rgb found = film.reflectance(cosine, Rgb(f0, 0.5f * f0, f0));
                    CAPTURE(ior, f0, cosine, thickness, found.r, found.g, found.b);
                    REQUIRE(is_finite(found));
                    REQUIRE(max_component(found) <= 1.0f);
                    REQUIRE(std::min(found.r, std::min(found.g, found.b)) >= 0.0f);
                    REQUIRE(max_component(found) <=
                            film.greatest(cosine, Rgb(f0, 0.5f * f0, f0)) + 1e-5f);
                }
            }
        }
    }
}

}  // namespace bdpt::test::thin_film_test
