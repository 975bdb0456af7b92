#include "bench/bench_parts.h"

#include <bdpt/eval/drawing.h>
#include <bdpt/eval/page.h>
#include <bdpt/render.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace bdpt::eval {
namespace {

using nlohmann::ordered_json;

constexpr std::uint64_t first_seed = 2'000'000;  // not used by any run or reference
constexpr int batches = 8;          // independent renders that variances are estimated from
constexpr int thumbnail_side = 64;  // maximum [pixels]

/// Moments of images of one kind of one strategy, from several renders.
class ImageMoments {
public:
    void add(const Image& image)
    {
        width_ = image.width;
        height_ = image.height;
        sums_.resize(image.pixels.size(), glm::dvec3(0.0));
        squares_.resize(image.pixels.size(), glm::dvec3(0.0));
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const glm::dvec3 value(image.pixels[i]);
            sums_[i] += value;
            squares_[i] += value * value;
        }
    }

    [[nodiscard]] Image mean() const
    {
        Image result{width_, height_, {}};
        for (const glm::dvec3& sum : sums_) {
            result.pixels.emplace_back(sum / double{batches});
        }
        return result;
    }
    /// Returns the variance of one render over r^2 + e; mean over pixels and channels.
    [[nodiscard]] double relative_variance(const Image& reference, double epsilon) const
    {
        return relative_mean(reference, epsilon, [this](std::size_t i, int c, double /*r*/) {
            const double variance =
                (squares_[i][c] - sums_[i][c] * sums_[i][c] / batches) / (batches - 1);
            return std::max(variance, 0.0);
        });
    }
    /// Returns the mean square over pixels and channels.
    [[nodiscard]] double energy() const
    {
        double result = 0.0;
        for (const glm::dvec3& sum : sums_) {
            result += sum.x + sum.y + sum.z;
        }
        return result / (3.0 * batches * static_cast<double>(sums_.size()));
    }

private:
    int width_ = 0;
    int height_ = 0;
    std::vector<glm::dvec3> sums_;
    std::vector<glm::dvec3> squares_;
};

struct StrategyMoments {
    Strategy strategy;
    ImageMoments weighted;
    ImageMoments unweighted;
};

/// Returns the greatest requested depth of strategy images that fit into memory.
int affordable_depth(RenderOptions options, const CameraDesc& camera, int asked)
{
    for (int depth = std::min(asked, options.transport.max_depth); depth > 0; --depth) {
        options.bidirectional.strategy_depth = depth;
        // The moments take twelve doubles in addition.
        if (2 * strategy_image_bytes(options, camera) <= options.bidirectional.strategy_memory) {
            return depth;
        }
    }
    return 0;
}

ordered_json share_json(const ImageMoments& moments, const Image& reference, double epsilon,
                        double scale)
{
    const Image mean = moments.mean();
    const int side = std::max(mean.width, mean.height);
    const int factor = (side + thumbnail_side - 1) / thumbnail_side;
    return {{"energy", moments.energy()},
            {"variance", moments.relative_variance(reference, epsilon)},
            {"picture", packed_image(shrunk(mean, factor), scale)}};
}

/// Returns the mean length [edges] of the paths that contribute to each pixel, in 32 steps per
/// edge; 0: no light.
std::vector<std::uint8_t> length_map(const std::vector<StrategyMoments>& all)
{
    std::vector<double> light;
    std::vector<double> edges;
    for (const StrategyMoments& one : all) {
        const Image mean = one.weighted.mean();
        light.resize(mean.pixels.size());
        edges.resize(mean.pixels.size());
        for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
            const Rgb& pixel = mean.pixels[i];
            const auto value = static_cast<double>(pixel.r + pixel.g + pixel.b);
            light[i] += value;
            edges[i] += value * (one.strategy.s + one.strategy.t - 1);
        }
    }
    std::vector<std::uint8_t> result;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const double steps = light[i] > 0.0 ? 32.0 * edges[i] / light[i] : 0.0;
        result.push_back(static_cast<std::uint8_t>(std::clamp(steps + 0.5, 0.0, 255.0)));
    }
    return result;
}

}  // namespace

void measure_strategies(const BenchScene& scene, const BenchOptions& options,
                        const BenchFiles& files, const Reference& reference,
                        BenchProgressMeter& meter, const BenchControl& control)
{
    if (read_json(files.strategies())) {
        meter.skip(options.seconds);
        return;
    }
    TrialSetup setup = make_setup(scene, options.render, IntegratorKind::bdpt, first_seed, control);
    setup.options.bidirectional.strategy_depth =
        affordable_depth(setup.options, scene.camera, options.strategy_depth);
    if (setup.options.bidirectional.strategy_depth == 0) {
        if (control.on_note) {
            control.on_note(scene.name + ": no images of strategies: they take too much memory");
        }
        return;
    }
    meter.begin("strategies of bdpt", options.seconds);
    const auto samples = samples_in(setup, options.seconds / batches);
    if (!samples) {
        return;
    }
    setup.options.sampling.samples = {.begin = 0, .end = *samples};
    setup.options.sampling.planned_samples = 0;
    std::vector<StrategyMoments> all;
    for (int batch = 0; batch < batches; ++batch) {
        setup.options.sampling.seed = first_seed + static_cast<std::uint64_t>(batch);
        RenderControl stop;
        stop.stop = control.stop;
        const RenderResult result = render(scene.scene, scene.camera, setup.options, stop);
        if (result.samples.end() < *samples) {
            return;
        }
        const std::vector<Strategy>& strategies = result.strategies.strategies();
        for (std::size_t i = 0; i < strategies.size(); ++i) {
            if (batch == 0) {
                all.push_back({.strategy = strategies[i], .weighted = {}, .unweighted = {}});
            }
            all[i].weighted.add(result.strategies.weighted(strategies[i]));
            all[i].unweighted.add(result.strategies.unweighted(strategies[i]));
        }
        meter.tell((batch + 1.0) / batches);
    }
    meter.end();

    const MetricScale metric = bench_scale(reference.image);
    const double mean_light = metric.epsilon / 0.01;
    const double scale = page_scale(mean_light);
    ordered_json list = ordered_json::array();
    for (const StrategyMoments& one : all) {
        list.push_back(
            {{"s", one.strategy.s},
             {"t", one.strategy.t},
             {"weighted", share_json(one.weighted, reference.image, metric.squared_epsilon, scale)},
             {"unweighted",
              share_json(one.unweighted, reference.image, metric.squared_epsilon, scale)}});
    }
    const int side = std::max(scene.width, scene.height);
    const int factor = (side + thumbnail_side - 1) / thumbnail_side;
    write_json(files.strategies(), {{"samples", *samples},
                                    {"renders", batches},
                                    {"depth", setup.options.bidirectional.strategy_depth},
                                    {"light", mean_light},
                                    {"width", (scene.width + factor - 1) / factor},
                                    {"height", (scene.height + factor - 1) / factor},
                                    {"lengths", packed_bytes(length_map(all))},
                                    {"strategies", std::move(list)}});
}

}  // namespace bdpt::eval
