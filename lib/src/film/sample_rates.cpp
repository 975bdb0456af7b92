#include <bdpt/error.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render_options.h>

#include <algorithm>
#include <string>
#include <utility>

namespace bdpt {
namespace {

/// Returns the mean rate; in quarters nothing is rounded.
double compute_mean(const std::vector<std::int8_t>& exponents)
{
    std::int64_t quarters = 0;
    for (const std::int8_t exponent : exponents) {
        quarters += std::int64_t{1} << (exponent - SampleRates::min_exponent);
    }
    return static_cast<double>(quarters) /
           static_cast<double>(exponents.size() << -SampleRates::min_exponent);
}

}  // namespace

SampleRates::SampleRates(int width, int height, std::vector<std::int8_t> exponents)
    : width_(width), height_(height), exponents_(std::move(exponents))
{
    const auto pixels = static_cast<std::size_t>(std::max(width, 0)) *
                        static_cast<std::size_t>(std::max(height, 0));
    if (pixels == 0 || exponents_.size() != pixels) {
        throw Error(ErrorCode::usage,
                    std::to_string(exponents_.size()) + " rates of samples for an image of " +
                        std::to_string(width) + "x" + std::to_string(height) + " pixels");
    }
    for (const std::int8_t exponent : exponents_) {
        if (exponent < min_exponent || exponent > max_exponent) {
            throw Error(ErrorCode::usage, "a rate of samples is 2^" + std::to_string(exponent) +
                                              ", not from 1/4 to 4");
        }
    }
    mean_ = compute_mean(exponents_);
}

bool SampleRates::fit(const SampleRange& samples)
{
    return samples.begin % group == 0 && samples.end % group == 0 && samples.end <= max_rounds;
}

float SampleRates::least() const
{
    return to_rate(*std::min_element(exponents_.begin(), exponents_.end()));
}

float SampleRates::greatest() const
{
    return to_rate(*std::max_element(exponents_.begin(), exponents_.end()));
}

}  // namespace bdpt
