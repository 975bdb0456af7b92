#include "integrator/contribution_sink.h"

#include <cmath>

namespace bdpt {
namespace {

/// Returns the estimate of `found` if its strategy were alone; light of a dispersed path counts in
/// one channel.
Rgb compute_unweighted(const SampleContext& sample, const Contribution& found)
{
    return found.dispersed ? found.unweighted * spectral_weight(sample.wavelength)
                           : found.unweighted;
}

}  // namespace

ContributionSink::ContributionSink(const Films& films, const PixelFilter& filter,
                                   PathWeigher* weigher, std::size_t max_splats)
    : films_(films), filter_(filter), weigher_(weigher)
{
    splats_.reserve(max_splats);
}

void ContributionSink::begin_sample(int x, int y, const ScheduledSample& sample)
{
    x_ = x;
    y_ = y;
    index_ = sample.index;
    scale_ = sample.scale;
    begin_joins(0);
    center_ = Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    radiance_ = Rgb(0.0f);
}

void ContributionSink::add(const SampleContext& sample, Strategy strategy,
                           const Contribution& found, float count)
{
    const Rgb unweighted = compute_unweighted(sample, found);
    const Rgb weighted = found.weight / count * unweighted;
    radiance_ += weighted;
    if (!films_.strategies.empty() || films_.on_path) [[unlikely]] {
        report(strategy, center_, scale_.camera * weighted, scale_.camera / count * unweighted,
               found);
    }
}

void ContributionSink::splat(SampleContext& sample, Strategy strategy, const Contribution& found,
                             float count, std::uint32_t dimension)
{
    SplatTarget target{.raster = found.raster};
    if (!filter_.is_pixel()) {
        sample.sampler.start(SampleUse::film, dimension);
        target = filter_.choose_pixel(found.raster, sample.sampler.next_2d());
    }
    const Rgb unweighted = compute_unweighted(sample, found);
    const Rgb weighted = target.weight * found.weight / count * unweighted;
    if (films_.film != nullptr) {
        films_.film->prefetch_splat(target.raster, index_);
    }
    splats_.push_back({.raster = target.raster, .radiance = weighted});
    if (!films_.strategies.empty() || films_.on_path) [[unlikely]] {
        report(strategy, target.raster, scale_.splat * weighted,
               scale_.splat * target.weight / count * unweighted, found);
    }
}

void ContributionSink::report(Strategy strategy, Vec2 raster, Rgb weighted, Rgb unweighted,
                              const Contribution& found)
{
    if (!films_.strategies.empty()) {
        films_.strategies.add(strategy, raster, {.weighted = weighted, .unweighted = unweighted});
    }
    const auto x = static_cast<int>(std::floor(raster.x));
    const auto y = static_cast<int>(std::floor(raster.y));
    if (films_.on_path && holds(x, y)) {
        films_.on_path(
            {.strategy = strategy,
             .merged = merged_,
             .light_path = light_path_,
             .raster = raster,
             .unweighted = unweighted,
             .weight = found.weight,
             .chance = found.chance,
             .scatters_in_body = weigher_ != nullptr && weigher_->scatters_in_body(),
             .shares = weigher_ != nullptr ? weigher_->shares() : std::span<const float>{}});
    }
}

void ContributionSink::end_sample()
{
    if (films_.film != nullptr) {
        if (holds_pixel()) {
            films_.film->add_sample(x_, y_, index_, radiance_, scale_.camera);
        }
        for (const PendingSplat& splat : splats_) {
            films_.film->add_splat(splat.raster, index_, splat.radiance, scale_.splat);
        }
    }
    splats_.clear();
}

}  // namespace bdpt
