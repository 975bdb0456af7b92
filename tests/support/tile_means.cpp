#include "tile_means.h"

#include <bdpt/options/integrators.h>

#include <algorithm>

namespace bdpt::test {
namespace {

CellBatches batches_of_cells(const RenderOptions& options)
{
    return info(options.integrator).traces_light_paths ? CellBatches::common
                                                       : CellBatches::separate;
}

PixelRect find_pixels(std::size_t cell)
{
    constexpr int size = TileMeans::side / TileMeans::grid;
    const int x = static_cast<int>(cell) % TileMeans::grid * size;
    const int y = static_cast<int>(cell) / TileMeans::grid * size;
    return {.x0 = x, .y0 = y, .x1 = x + size, .y1 = y + size};
}

/// Returns the mean of the pixels `rect` in an image whose first pixel is at (`x0`, `y0`).
double compute_mean(const Image& image, const PixelRect& rect, int x0, int y0)
{
    double sum = 0.0;
    for (int y = rect.y0; y < rect.y1; ++y) {
        for (int x = rect.x0; x < rect.x1; ++x) {
            const Rgb& pixel = image.at(x - x0, y - y0);
            sum += static_cast<double>(pixel.r + pixel.g + pixel.b) / 3.0;
        }
    }
    return sum / (rect.width() * rect.height());
}

}  // namespace

TileMeans::TileMeans(const Scene& scene, const CameraDesc& camera, RenderOptions options,
                     SamplerKind sampler)
    : scene_(scene), camera_(camera), options_(options)
{
    options_.sampling.sampler = sampler;
    options_.film.width = side;
    options_.film.height = side;
}

RenderOptions TileMeans::options_of_batch(int batch) const
{
    RenderOptions options = options_;
    if (options_.sampling.sampler == SamplerKind::sobol) {
        options.sampling.samples = {.begin = 0, .end = 8};
        options.sampling.planned_samples = 64;  // enough for pilots to learn where light is
        options.sampling.seed = options_.sampling.seed << 32U | static_cast<std::uint32_t>(batch);
    } else {
        options.sampling.samples = {.begin = batch, .end = batch + 1};
    }
    return options;
}

int TileMeans::batches() const
{
    std::int64_t least = moments_.front().count();
    for (const Moments& cell : moments_) {
        least = std::min(least, cell.count());
    }
    return static_cast<int>(least);
}

void TileMeans::refine_to(const std::array<int, cells>& batches)
{
    for (std::size_t i = 0; i < cells; ++i) {
        while (moments_[i].count() < batches[i]) {
            add_batch(i);
        }
    }
}

void TileMeans::refine_to(int batches)
{
    std::array<int, cells> all{};
    all.fill(batches);
    refine_to(all);
}

void TileMeans::add_batch(std::size_t cell)
{
    RenderOptions options = options_of_batch(static_cast<int>(moments_[cell].count()));
    const bool alone = batches_of_cells(options) == CellBatches::separate;
    const PixelRect rendered =
        alone ? find_pixels(cell) : PixelRect{.x0 = 0, .y0 = 0, .x1 = side, .y1 = side};
    options.film.crop = rendered;
    const RenderResult result = render(scene_, camera_, options);
    rays_ += result.stats.rays.total();
    const Image image = result.film.develop();
    for (std::size_t i = 0; i < cells; ++i) {
        if (!alone || i == cell) {
            moments_[i].add(compute_mean(image, find_pixels(i), rendered.x0, rendered.y0));
        }
    }
}

BatchEvidence TileMeans::evidence(const std::array<double, cells>& means) const
{
    BatchEvidence result{
        .variance = {}, .batches = {}, .work = 0.0, .cells = batches_of_cells(options_)};
    std::int64_t batches = 0;
    for (std::size_t i = 0; i < cells; ++i) {
        result.batches[i] = static_cast<int>(moments_[i].count());
        batches += moments_[i].count();
        result.variance[i] = means[i] > 0.0 ? moments_[i].variance() / (means[i] * means[i]) : 0.0;
    }
    result.work = static_cast<double>(rays_) * cells / static_cast<double>(batches);
    return result;
}

}  // namespace bdpt::test
