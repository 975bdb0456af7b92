#include "render/ground/ground_lamps.h"

#include "math/random_numbers.h"
#include "math/rgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bdpt {
namespace {

constexpr Vec3 straight_up(0.0f, 1.0f, 0.0f);

/// Generates numbers in [0, 1), the same in every run.
class FixedNumbers {
public:
    explicit FixedNumbers(std::uint64_t seed) : state_(split_mix(seed)) {}
    float next()
    {
        state_ += golden_ratio_64;
        return static_cast<float>(split_mix(state_) >> 40U) * 0x1p-24f;
    }

private:
    std::uint64_t state_;
};

/// Returns a rough estimate of the luminance of the irradiance.
float light_at(const LightSet& lights, const GroundOccluders& occluders, std::size_t place,
               float height)
{
    constexpr int samples = 16;
    FixedNumbers numbers(place);
    float sum = 0.0f;
    for (int i = 0; i < samples; ++i) {
        const Vec2 within(numbers.next(), numbers.next());
        const Vec2 at = occluders.point(place, within);
        const LightSampleContext receiver{.p = {at.x, height, at.y}, .normal = straight_up};
        const float u_light = numbers.next();
        const Vec2 u(numbers.next(), numbers.next());
        const float time = numbers.next();
        const auto choice = lights.choose_placed(receiver, static_cast<double>(u_light));
        if (!choice) {
            continue;
        }
        const auto light =
            lights[choice->id].sample_incident(receiver, u, EnvironmentSampling::plain, time);
        const float found = light && light->wi.y > 0.0f
                                ? luminance(light->wi.y / choice->probability * light->weight)
                                : 0.0f;
        sum += std::isfinite(found) ? found : 0.0f;
    }
    return sum / static_cast<float>(samples);
}

}  // namespace

GroundLamps::GroundLamps(const LightSet& lights, const GroundOccluders& occluders, float height,
                         float elsewhere)
{
    if (!(elsewhere > 0.0f) || occluders.empty()) {
        return;
    }
    std::vector<float> shares(occluders.place_count());
    tbb::parallel_for(std::size_t{0}, shares.size(), [&](std::size_t place) {
        const float lamps = light_at(lights, occluders, place, height);
        shares[place] = lamps / (lamps + elsewhere);
    });
    // The greatest share around each place, for the estimate of one may have missed a lamp.
    constexpr float min_chance = 1.0f / 128.0f;
    constexpr float certain_share = 0.25f;
    constexpr std::size_t side = GroundOccluders::side;
    chances_.resize(shares.size());
    for (std::size_t z = 0; z < side; ++z) {
        for (std::size_t x = 0; x < side; ++x) {
            float most = 0.0f;
            for (std::size_t j = z - std::min<std::size_t>(z, 1); j <= std::min(z + 1, side - 1);
                 ++j) {
                for (std::size_t i = x - std::min<std::size_t>(x, 1);
                     i <= std::min(x + 1, side - 1); ++i) {
                    most = std::max(most, shares[j * side + i]);
                }
            }
            chances_[z * side + x] = std::clamp(most / certain_share, min_chance, 1.0f);
        }
    }
}

}  // namespace bdpt
