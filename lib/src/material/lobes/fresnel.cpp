#include "material/lobes/fresnel.h"

#include "math/elementary.h"
#include "math/rgb.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

[[nodiscard]] float squared(float x)
{
    return x * x;
}

[[nodiscard]] float schlick(float f0, float cosine)
{
    return f0 + (1.0f - f0) * schlick_weight(cosine);
}

/// Returns the index relative to air that reflects f0; finite for a perfect mirror.
[[nodiscard]] float to_ior(float f0)
{
    const float root = std::sqrt(std::clamp(f0, 0.0f, 0.9999f));
    return (1.0f + root) / (1.0f - root);
}

/// Returns the sensors' response to a cosine in wave numbers: Gaussians map to Gaussians [Belcour
/// and Barla 2017, sec. 4; numbers of KHR_materials_iridescence]. Linear Rec. 709 with white 1;
/// `path` is the optical path difference [nm]; `shift` [rad].
[[nodiscard]] Rgb sensitivity(float path, float shift)
{
    constexpr float norm = 1.0685e-7f;
    const float phase = 2.0f * pi * path * 1e-9f;
    const auto gaussian = [&](float value, float position, float variance) {
        return value / norm * std::sqrt(2.0f * pi * variance) *
               sin_cos(position * phase + shift).cos * exp_exact(-variance * phase * phase);
    };
    const float x =
        gaussian(5.4856e-13f, 1.6810e6f, 4.3278e9f) + gaussian(9.7470e-14f, 2.2399e6f, 4.5282e9f);
    const float y = gaussian(4.4201e-13f, 1.7953e6f, 9.3046e9f);
    const float z = gaussian(5.2481e-13f, 2.2084e6f, 6.6121e9f);
    return {3.2404542f * x - 1.5371385f * y - 0.4985314f * z,
            -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
            0.0556434f * x - 0.2040259f * y + 1.0572252f * z};
}

/// Upper bound of the magnitude of `sensitivity` in all channels (the maximum, of red, is 1.785).
constexpr float max_sensitivity = 1.8f;

/// Reflection of a film's two interfaces, in one channel: sums over all paths by the number of
/// passages through the film.
struct Interfaces {
    float mean;      ///< without interference
    float first;     ///< amplitude of paths that differ by one round trip
    float quotient;  ///< ratio of successive amplitudes
};

/// Computes the interfaces of a film of index `film` on a base of index `base`, for the cosines
/// outside and within the film.
[[nodiscard]] Interfaces interfaces(float film, float base, float cosine, float cos_film)
{
    const float outer = schlick(squared((film - 1.0f) / (film + 1.0f)), cosine);
    const float inner = schlick(squared((base - film) / (base + film)), cos_film);
    const float both = std::clamp(outer * inner, 1e-5f, 0.9999f);
    const float transmitted = 1.0f - outer;
    const float base_alone = transmitted * transmitted * inner / (1.0f - both);
    const float root = std::sqrt(both);
    return {outer + base_alone, (base_alone - transmitted) * root, root};
}

[[nodiscard]] float cosine_within(float cosine, float index)
{
    return std::sqrt(std::max(0.0f, 1.0f - (1.0f - cosine * cosine) / (index * index)));
}

/// Returns the effective index of the film; a film much thinner than the wavelength has no index of
/// its own.
[[nodiscard]] float index_of_film(const ThinFilm& film)
{
    const float t = std::clamp(film.thickness / 0.03f, 0.0f, 1.0f);
    return 1.0f + (film.ior - 1.0f) * t * t * (3.0f - 2.0f * t);
}

}  // namespace

Rgb ThinFilm::over(Rgb bare, Rgb f0, float cosine) const noexcept
{
    return factor == 0.0f ? bare : bare + factor * (reflectance(cosine, f0) - bare);
}

float ThinFilm::bound(float bare, float split_f0, float split_f90) const noexcept
{
    const float filmed = f0_bound * split_f0 + split_f90;
    return glm::mix(bare, std::max(bare, filmed), factor);
}

float ThinFilm::max_albedo_over(float bare, float cosine, Rgb f0) const noexcept
{
    return factor > 0.0f ? bare + factor * std::max(0.0f, greatest(cosine, f0) - bare) : bare;
}

Rgb ThinFilm::reflectance(float cosine, Rgb f0) const noexcept
{
    const float index = index_of_film(*this);
    const float cos_film = cosine_within(cosine, index);
    const float path = 2.0f * index * thickness * cos_film;
    // The film is denser than air: no phase shift outside, half a wave within; and another half
    // wave at the base if the base is less dense than the film.
    const Rgb once = sensitivity(path, pi);
    const Rgb twice = sensitivity(2.0f * path, 2.0f * pi);
    Rgb result;
    for (int c = 0; c < 3; ++c) {
        const float base = to_ior(f0[c]);
        const Interfaces sum = interfaces(index, base, cosine, cos_film);
        const float sign = base < index ? -1.0f : 1.0f;  // cos(x + pi) = -cos(x)
        result[c] = sum.mean + 2.0f * sum.first * (sign * once[c] + sum.quotient * twice[c]);
    }
    return clamp(result, 0.0f, 1.0f);
}

float ThinFilm::greatest(float cosine, Rgb f0) const noexcept
{
    const float index = index_of_film(*this);
    const float cos_film = cosine_within(cosine, index);
    float greatest = 0.0f;
    for (int c = 0; c < 3; ++c) {
        const Interfaces sum = interfaces(index, to_ior(f0[c]), cosine, cos_film);
        const float waves = std::abs(sum.first) * (1.0f + sum.quotient);
        greatest = std::max(greatest, sum.mean + 2.0f * max_sensitivity * waves);
    }
    return std::min(greatest, 1.0f);
}

}  // namespace bdpt
