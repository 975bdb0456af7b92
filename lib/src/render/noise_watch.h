#pragma once

#include <bdpt/error.h>
#include <bdpt/noise.h>
#include <bdpt/render.h>

#include <algorithm>
#include <cstdint>
#include <optional>

namespace bdpt {

/// Measures the noise of the film at the scheduled sample counts.
class NoiseWatch {
public:
    NoiseWatch(const RenderControl& control, SampleRange wanted)
        : control_(control), wanted_(wanted)
    {
        if (!(control.noise_goal >= 0.0)) {
            throw Error(ErrorCode::usage,
                        "the goal for noise (noise_goal) is negative or no number");
        }
    }

    /// Returns `samples` or less, so that a pass ends where the noise is measured.
    [[nodiscard]] std::int64_t at_most(std::int64_t samples, const RenderResult& part) const
    {
        const std::int64_t done = part.samples.count();
        return decides() ? std::min(samples, next_noise_look(done) - done) : samples;
    }
    void look(const RenderResult& part)
    {
        const std::int64_t count = part.samples.count();
        // A film with gaps is no prefix of the samples: whether it is measured must not depend on
        // how it was rendered.
        const bool due = decides() ? is_noise_look(count) &&
                                         part.samples == SampleSet({.begin = wanted_.begin,
                                                                    .end = wanted_.begin + count})
                                   : control_.on_progress && count >= next_look_;
        if (due && count != samples_) {
            noise_ = estimate_noise(part.film, part.aovs);
            samples_ = count;
            next_look_ = next_noise_look(count);
        }
    }
    [[nodiscard]] bool reached() const
    {
        return decides() && noise_ && *noise_ <= control_.noise_goal;
    }
    [[nodiscard]] std::optional<double> noise() const { return noise_; }
    [[nodiscard]] std::int64_t samples() const { return samples_; }

private:
    [[nodiscard]] bool decides() const { return control_.noise_goal > 0.0; }

    const RenderControl& control_;
    SampleRange wanted_;
    std::optional<double> noise_;
    std::int64_t samples_ = 0;
    std::int64_t next_look_ = next_noise_look(0);
};

}  // namespace bdpt
