#include "equal_means.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace bdpt::test {
namespace {

constexpr double ninety_percent = 1.2816;  // quantile of the normal distribution

/// Two-sided quantile of the normal distribution at tail probability `p`, by bisection.
double critical_value(double p)
{
    double low = 0.0;
    double high = 20.0;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::sqrt(2.0)) > p ? low : high) = middle;
    }
    return low;
}

/// What is compared in one cell.
struct Cell {
    double difference;
    double error;  // standard error of the difference
    double size;   // what a relative bias refers to
};

MeanComparison compare_cells(const std::function<Cell(std::size_t)>& cell,
                             const Sharpness& sharpness)
{
    const double each = 1.0 - std::pow(1.0 - sharpness.false_alarm, 1.0 / TileMeans::cells);
    MeanComparison result;
    result.critical_z = critical_value(each);
    std::size_t black = 0;
    for (std::size_t i = 0; i < TileMeans::cells; ++i) {
        const Cell c = cell(i);
        if (!(c.size > 0.0)) {
            ++black;
            continue;
        }
        result.greatest_bias = std::max(result.greatest_bias, std::abs(c.difference) / c.size);
        if (c.error == 0.0 && c.difference == 0.0) {
            continue;
        }
        const double z = std::abs(c.difference) / std::max(c.error, 1e-7 * c.size);
        if (z > result.critical_z) {
            result.found_bias = std::max(result.found_bias, std::abs(c.difference) / c.size);
        }
        if (z > result.worst_z) {
            result.worst_z = z;
            result.worst_bias = c.difference / c.size;
        }
        result.detectable_bias = std::max(result.detectable_bias,
                                          (result.critical_z + ninety_percent) * c.error / c.size);
    }
    if (black == TileMeans::cells) {
        result.detectable_bias = std::max(result.detectable_bias, 1.0);  // nothing can be found
    }
    result.equal = result.worst_z <= result.critical_z;
    result.sharp_enough = result.detectable_bias <= sharpness.detectable_bias;
    return result;
}

MeanComparison refine_until_sharp(const std::function<MeanComparison()>& compare,
                                  const std::function<int(int)>& refine, const Sharpness& sharpness)
{
    int batches = refine(32);
    for (;;) {
        MeanComparison result = compare();
        result.batches = batches;
        if (result.sharp_enough || batches >= sharpness.max_batches) {
            return result;
        }
        // The error falls with the root of the number of batches; a little more than that needs.
        const double ratio = result.detectable_bias / sharpness.detectable_bias;
        const int wanted = static_cast<int>(1.1 * ratio * ratio * batches) + 1;
        batches =
            refine(std::clamp(wanted, batches + 8, std::min(4 * batches, sharpness.max_batches)) -
                   batches);
    }
}

}  // namespace

std::string MeanComparison::text() const
{
    std::ostringstream out;
    out << "worst tile differs by " << 100.0 * worst_bias << " % (z = " << worst_z << ", critical "
        << critical_z << "); detectable bias " << 100.0 * detectable_bias << " % after " << batches
        << " batches";
    return out.str();
}

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
        options.sampling.seed = options_.sampling.seed << 32U | static_cast<std::uint32_t>(batch);
    } else {
        options.sampling.samples = {.begin = batch, .end = batch + 1};
    }
    return options;
}

void TileMeans::refine(int batches)
{
    for (int batch = 0; batch < batches; ++batch, ++batches_) {
        const Image image = render(scene_, camera_, options_of_batch(batches_)).film.develop();
        std::array<double, cells> sums{};
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const int tile = y * grid / side * grid + x * grid / side;
                const Rgb& pixel = image.at(x, y);
                sums[static_cast<std::size_t>(tile)] +=
                    static_cast<double>(pixel.r + pixel.g + pixel.b) / 3.0;
            }
        }
        constexpr double pixels = static_cast<double>(side * side) / (grid * grid);
        for (std::size_t i = 0; i < cells; ++i) {
            moments_[i].add(sums[i] / pixels);
        }
    }
}

MeanComparison compare_means(TileMeans& a, TileMeans& b, const Sharpness& sharpness)
{
    const auto compare = [&] {
        return compare_cells(
            [&](std::size_t i) {
                const Moments& x = a.cell_moments()[i];
                const Moments& y = b.cell_moments()[i];
                return Cell{.difference = y.mean() - x.mean(),
                            .error = std::hypot(x.standard_error(), y.standard_error()),
                            .size = 0.5 * (x.mean() + y.mean())};
            },
            sharpness);
    };
    const auto refine = [&](int batches) {
        a.refine(batches);
        b.refine(batches);
        return std::min(a.batches(), b.batches());
    };
    return refine_until_sharp(compare, refine, sharpness);
}

MeanComparison compare_means(TileMeans& a, double expected, const Sharpness& sharpness)
{
    const auto compare = [&] {
        return compare_cells(
            [&](std::size_t i) {
                const Moments& x = a.cell_moments()[i];
                return Cell{.difference = x.mean() - expected,
                            .error = x.standard_error(),
                            .size = expected};
            },
            sharpness);
    };
    const auto refine = [&](int batches) {
        a.refine(batches);
        return a.batches();
    };
    return refine_until_sharp(compare, refine, sharpness);
}

}  // namespace bdpt::test
