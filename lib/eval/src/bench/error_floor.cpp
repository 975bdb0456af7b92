#include <bdpt/eval/bench.h>
#include <bdpt/eval/bench_report.h>
#include <bdpt/eval/statistics.h>

#include <cstddef>

namespace bdpt::eval {
namespace {

constexpr double min_share = 0.1;  // least share of the error; a smaller floor is negligible
constexpr double min_errors = 3.0;

/// Returns the mean of (a - r) (b - r) / (r^2 + e).
double product(const Image& a, const Image& b, const Image& reference, double epsilon)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double r = static_cast<double>(reference.pixels[i][c]);
            sum += (static_cast<double>(a.pixels[i][c]) - r) *
                   (static_cast<double>(b.pixels[i][c]) - r) / (r * r + epsilon);
        }
    }
    return sum / (3.0 * static_cast<double>(reference.pixels.size()));
}

}  // namespace

std::optional<double> error_floor(std::span<const Image> images, const Image& reference,
                                  double noise)
{
    const double epsilon = bench_scale(reference).squared_epsilon;
    Moments own;     // relMSE of each image
    Moments common;  // product of the errors of each pair of images
    for (std::size_t i = 0; i < images.size(); ++i) {
        own.add(product(images[i], images[i], reference, epsilon));
        for (std::size_t j = 0; j < i; ++j) {
            common.add(product(images[i], images[j], reference, epsilon));
        }
    }
    const double floor = common.mean() - noise;
    const bool matters = floor > min_share * own.mean() && floor > noise;
    const bool sure = common.count() < 2 || floor > min_errors * common.standard_error();
    return matters && sure ? std::optional(floor) : std::nullopt;
}

}  // namespace bdpt::eval
