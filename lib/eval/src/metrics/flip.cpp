#include <bdpt/eval/metric.h>

#include <oneapi/tbb/parallel_for.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "metrics/metric_parts.h"

// Equations and symbols are those of [Andersson et al. 2020].

namespace bdpt::eval {

namespace {

/// White point D65 as in [Andersson et al. 2020]; CIE XYZ with Y = 1.
constexpr Vec3 white(0.950428545f, 1.0f, 1.088900371f);

/// Converts to CIE XYZ relative to the white point, so that (1, 1, 1) is white: the primaries of
/// sRGB, derived from their chromaticities (0.64, 0.33), (0.30, 0.60), (0.15, 0.06).
Vec3 relative_xyz_from_linear(Rgb c)
{
    const Vec3 xyz(0.4123865627f * c.r + 0.3575914911f * c.g + 0.1804504912f * c.b,
                   0.2126368214f * c.r + 0.7151829821f * c.g + 0.0721801965f * c.b,
                   0.0193306201f * c.r + 0.1191971637f * c.g + 0.9503725872f * c.b);
    return xyz / white;
}

/// Inverts `relative_xyz_from_linear`.
Rgb linear_from_relative_xyz(Vec3 relative)
{
    const Vec3 c = relative * white;
    return {3.2410032373f * c.x - 1.5373989715f * c.y - 0.4986158827f * c.z,
            -0.9692242518f * c.x + 1.8759299830f * c.y + 0.0415542263f * c.z,
            0.0556394198f * c.x - 0.2040112061f * c.y + 1.0571489770f * c.z};
}

// Knee of CIE 1976: below its cube the root is replaced by a line.
constexpr float knee = 6.0f / 29.0f;

float lab_curve(float t)
{
    return t > knee * knee * knee ? std::cbrt(t) : t / (3.0f * knee * knee) + 4.0f / 29.0f;
}

float inverse_lab_curve(float t)
{
    return t > knee ? t * t * t : 3.0f * knee * knee * (t - 4.0f / 29.0f);
}

}  // namespace

Vec3 opponent_from_linear(Rgb linear)
{
    const Vec3 xyz = relative_xyz_from_linear(linear);
    return {116.0f * xyz.y - 16.0f, 500.0f * (xyz.x - xyz.y), 200.0f * (xyz.y - xyz.z)};
}

Rgb linear_from_opponent(Vec3 opponent)
{
    const float y = (opponent.x + 16.0f) / 116.0f;
    return linear_from_relative_xyz({y + opponent.y / 500.0f, y, y - opponent.z / 200.0f});
}

Vec3 lab_from_linear(Rgb linear)
{
    const Vec3 xyz = relative_xyz_from_linear(linear);
    const Vec3 f(lab_curve(xyz.x), lab_curve(xyz.y), lab_curve(xyz.z));
    return {116.0f * f.y - 16.0f, 500.0f * (f.x - f.y), 200.0f * (f.y - f.z)};
}

Rgb linear_from_lab(Vec3 lab)
{
    const float y = (lab.x + 16.0f) / 116.0f;
    return linear_from_relative_xyz({inverse_lab_curve(y + lab.y / 500.0f), inverse_lab_curve(y),
                                     inverse_lab_curve(y - lab.z / 200.0f)});
}

namespace {

/// Returns the row with its first and last value repeated `radius` times.
std::vector<float> padded(std::span<const float> row, std::size_t radius)
{
    std::vector<float> result;
    result.reserve(row.size() + 2 * radius);
    result.insert(result.end(), radius, row.front());
    result.insert(result.end(), row.begin(), row.end());
    result.insert(result.end(), radius, row.back());
    return result;
}

void add_scaled(std::span<float> sums, std::span<const float> values, float factor)
{
    for (std::size_t x = 0; x < sums.size(); ++x) {
        sums[x] += factor * values[x];
    }
}

Plane convolve_rows(const Plane& plane, const Kernel& kernel)
{
    Plane result(plane.width, plane.height);
    oneapi::tbb::parallel_for(0, plane.height, [&](int y) {
        const std::vector<float> source = padded(plane.row(y), kernel.size() / 2);
        const std::span<float> target = result.row(y);
        for (std::size_t k = 0; k < kernel.size(); ++k) {
            add_scaled(target, std::span(source).subspan(k, target.size()), kernel[k]);
        }
    });
    return result;
}

Plane convolve_columns(const Plane& plane, const Kernel& kernel)
{
    Plane result(plane.width, plane.height);
    const int radius = static_cast<int>(kernel.size() / 2);
    oneapi::tbb::parallel_for(0, plane.height, [&](int y) {
        for (int k = -radius; k <= radius; ++k) {
            const int source = std::clamp(y + k, 0, plane.height - 1);
            add_scaled(result.row(y), plane.row(source),
                       kernel[static_cast<std::size_t>(k + radius)]);
        }
    });
    return result;
}

}  // namespace

Plane convolve(const Plane& plane, const Kernel& horizontal, const Kernel& vertical)
{
    return convolve_columns(convolve_rows(plane, horizontal), vertical);
}

FlipExposures flip_exposures(const Image& reference)
{
    constexpr double shown = 0.85;     // display value of the brightest and of the median luminance
    constexpr double least = 0x1p-23;  // minimum median: a screen shows nothing darker
    std::vector<double> luminances;
    luminances.reserve(reference.pixels.size());
    for (const Rgb& pixel : reference.pixels) {
        luminances.push_back(0.2126 * static_cast<double>(pixel.r) +
                             0.7152 * static_cast<double>(pixel.g) +
                             0.0722 * static_cast<double>(pixel.b));
    }
    const double greatest = *std::max_element(luminances.begin(), luminances.end());
    if (!(greatest > 0.0)) {
        return {};
    }
    const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::nth_element(luminances.begin(), middle, luminances.end());
    const double bright = AcesCurve::inverse(shown);
    FlipExposures result;
    result.start = std::log2(bright / greatest);
    result.stop = std::max(result.start, std::log2(bright / std::max(*middle, least)));
    result.count = std::max(2, static_cast<int>(std::ceil(result.stop - result.start)));
    return result;
}

namespace {

constexpr double pi = std::numbers::pi;

/// Contrast sensitivity of the eye in one channel: a sum of two Gaussians in space [eq. 2 and table
/// 1]. b in squared degrees.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity achromatic{1.0, 0.0047, 0.0, 1e-5};
constexpr Sensitivity red_green{1.0, 0.0053, 0.0, 1e-5};
constexpr Sensitivity blue_yellow{34.1, 0.04, 13.5, 0.025};

constexpr double widest_deviation = 0.0450158158079;  // [degrees] sqrt(0.04 / (2 pi^2))
constexpr double feature_size = 0.082;  // [degrees] w of an edge or a point [sec. 4.2]

constexpr double q_color = 0.7;  // compresses large colour differences [sec. 4.1.3]
constexpr double p_color = 0.4;  // fraction of the greatest difference that maps to p_shown
constexpr double p_shown = 0.95;
constexpr double q_feature = 0.5;

int radius_for(double deviation_in_pixels)
{
    return static_cast<int>(std::ceil(3.0 * deviation_in_pixels));
}

/// Returns `weight(x)` for x from -radius to radius.
template <typename Weight>
std::vector<double> sample(int radius, Weight weight)
{
    std::vector<double> result;
    for (int x = -radius; x <= radius; ++x) {
        result.push_back(weight(static_cast<double>(x)));
    }
    return result;
}

Kernel scaled(const std::vector<double>& weights, double factor)
{
    Kernel result;
    for (const double weight : weights) {
        result.push_back(static_cast<float>(weight * factor));
    }
    return result;
}

/// A Gaussian of one channel's sensitivity, and its share of the total.
struct Blur {
    Kernel kernel;  // sums to 1
    double share;
};

std::vector<Blur> make_blurs(const Sensitivity& s, double pixels_per_degree)
{
    const int radius = radius_for(widest_deviation * pixels_per_degree);
    std::vector<Blur> blurs;
    double total = 0.0;
    for (const auto& [a, b] : {std::pair{s.a1, s.b1}, std::pair{s.a2, s.b2}}) {
        if (a == 0.0) {
            continue;
        }
        const std::vector<double> weights = sample(radius, [b = b, pixels_per_degree](double x) {
            const double degrees = x / pixels_per_degree;
            return std::exp(-pi * pi * degrees * degrees / b);
        });
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        // A 2D Gaussian is the product of two 1D ones, so its weight has the square of their sum.
        const double share = a * std::sqrt(pi / b) * sum * sum;
        blurs.push_back({scaled(weights, 1.0 / sum), share});
        total += share;
    }
    for (Blur& blur : blurs) {
        blur.share /= total;
    }
    return blurs;
}

Plane blurred(const Plane& plane, const std::vector<Blur>& blurs)
{
    Plane result(plane.width, plane.height);
    for (const Blur& blur : blurs) {
        const Plane part = convolve(plane, blur.kernel, blur.kernel);
        for (std::size_t i = 0; i < result.values.size(); ++i) {
            result.values[i] += static_cast<float>(blur.share) * part.values[i];
        }
    }
    return result;
}

/// Scales the positive weights to a sum of 1 and the negative ones to -1.
Kernel balanced(std::vector<double> weights)
{
    double positive = 0.0;
    double negative = 0.0;
    for (const double weight : weights) {
        (weight > 0.0 ? positive : negative) += weight;
    }
    for (double& weight : weights) {
        weight /= weight > 0.0 ? positive : -negative;
    }
    return scaled(weights, 1.0);
}

/// Detectors of edges and points [sec. 4.2]: derivatives of a Gaussian along one axis.
struct Detectors {
    Kernel gaussian;
    Kernel edge;
    Kernel point;
};

Detectors make_detectors(double pixels_per_degree)
{
    const double deviation = 0.5 * feature_size * pixels_per_degree;
    const int radius = radius_for(deviation);
    const auto gaussian = [deviation](double x) {
        return std::exp(-x * x / (2.0 * deviation * deviation));
    };
    const std::vector<double> plain = sample(radius, gaussian);
    return {.gaussian = scaled(plain, 1.0 / std::accumulate(plain.begin(), plain.end(), 0.0)),
            .edge = balanced(sample(radius, [&](double x) { return -x * gaussian(x); })),
            .point = balanced(sample(radius, [&](double x) {
                return (x * x / (deviation * deviation) - 1.0) * gaussian(x);
            }))};
}

/// Returns the length of the vector of the responses along both axes.
Plane detect(const Plane& luminance, const Kernel& detector, const Kernel& gaussian)
{
    Plane result = convolve(luminance, detector, gaussian);
    const Plane along_y = convolve(luminance, gaussian, detector);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        result.values[i] = std::hypot(result.values[i], along_y.values[i]);
    }
    return result;
}

/// Converts to L*a*b*, with less colour in the dark [Hunt 1952; sec. 4.1.2].
Vec3 hunt_lab(Rgb linear)
{
    const Vec3 lab = lab_from_linear(linear);
    return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

/// Returns the HyAB distance [Abasi et al. 2020]: city-block distance between lightness and colour.
double hyab(Vec3 a, Vec3 b)
{
    return static_cast<double>(std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z));
}

/// Maps a difference to [0, 1]: most of the range for the smaller differences [sec. 4.1.3].
double redistributed(double difference, double greatest)
{
    const double knee = p_color * greatest;
    return difference < knee ? p_shown * difference / knee
                             : p_shown + (difference - knee) / (greatest - knee) * (1.0 - p_shown);
}

/// Perception of an image: its colours after blurring, and its features.
struct Percept {
    std::vector<Vec3> colors;  // by hunt_lab
    Plane edges;
    Plane points;
};

class Eye {
public:
    explicit Eye(double pixels_per_degree)
        : achromatic_(make_blurs(achromatic, pixels_per_degree)),
          red_green_(make_blurs(red_green, pixels_per_degree)),
          blue_yellow_(make_blurs(blue_yellow, pixels_per_degree)),
          detectors_(make_detectors(pixels_per_degree))
    {}

    [[nodiscard]] Percept look(const Image& image) const
    {
        Plane y(image.width, image.height);
        Plane x(image.width, image.height);
        Plane z(image.width, image.height);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const Vec3 opponent =
                opponent_from_linear(glm::clamp(image.pixels[i], Rgb(0.0f), Rgb(1.0f)));
            y.values[i] = opponent.x;
            x.values[i] = opponent.y;
            z.values[i] = opponent.z;
        }
        Percept percept{blurred_colors(y, x, z), Plane(0, 0), Plane(0, 0)};
        for (float& value : y.values) {
            value = (value + 16.0f) / 116.0f;  // to [0, 1]
        }
        percept.edges = detect(y, detectors_.edge, detectors_.gaussian);
        percept.points = detect(y, detectors_.point, detectors_.gaussian);
        return percept;
    }

private:
    [[nodiscard]] std::vector<Vec3> blurred_colors(const Plane& y, const Plane& x,
                                                   const Plane& z) const
    {
        const Plane seen_y = blurred(y, achromatic_);
        const Plane seen_x = blurred(x, red_green_);
        const Plane seen_z = blurred(z, blue_yellow_);
        std::vector<Vec3> colors(y.values.size());
        oneapi::tbb::parallel_for(std::size_t{0}, colors.size(), [&](std::size_t i) {
            const Rgb linear =
                linear_from_opponent({seen_y.values[i], seen_x.values[i], seen_z.values[i]});
            colors[i] = hunt_lab(glm::clamp(linear, Rgb(0.0f), Rgb(1.0f)));
        });
        return colors;
    }

    std::vector<Blur> achromatic_;
    std::vector<Blur> red_green_;
    std::vector<Blur> blue_yellow_;
    Detectors detectors_;
};

double feature_difference(const Percept& a, const Percept& b, std::size_t i)
{
    const double edges = std::abs(static_cast<double>(a.edges.values[i] - b.edges.values[i]));
    const double points = std::abs(static_cast<double>(a.points.values[i] - b.points.values[i]));
    return std::pow(std::max(edges, points) / std::numbers::sqrt2, q_feature);
}

/// Combines colour and feature differences [eq. 8]: features amplify a colour difference.
ErrorMap difference(const Percept& a, const Percept& b, int width, int height)
{
    // The two colours of sRGB with the greatest distance [sec. 4.1.3].
    const double greatest =
        std::pow(hyab(hunt_lab({0.0f, 1.0f, 0.0f}), hunt_lab({0.0f, 0.0f, 1.0f})), q_color);
    ErrorMap map{width, height, std::vector<double>(a.colors.size())};
    oneapi::tbb::parallel_for(std::size_t{0}, map.values.size(), [&](std::size_t i) {
        const double color =
            redistributed(std::pow(hyab(a.colors[i], b.colors[i]), q_color), greatest);
        map.values[i] = std::pow(color, 1.0 - feature_difference(a, b, i));
    });
    return map;
}

Image shown(const Image& image, double exposure)
{
    Image result = image;
    const double factor = std::exp2(exposure);
    for (Rgb& pixel : result.pixels) {
        for (int c = 0; c < 3; ++c) {
            pixel[c] = AcesCurve::apply(factor * static_cast<double>(pixel[c]));
        }
    }
    return result;
}

}  // namespace

ErrorMap flip(const Image& image, const Image& reference, double pixels_per_degree)
{
    const Eye eye(pixels_per_degree);
    return difference(eye.look(image), eye.look(reference), image.width, image.height);
}

ErrorMap hdr_flip(const Image& image, const Image& reference, const FlipExposures& exposures,
                  double pixels_per_degree)
{
    const Eye eye(pixels_per_degree);
    ErrorMap result{image.width, image.height, std::vector<double>(image.pixels.size(), 0.0)};
    for (int i = 0; i < exposures.count; ++i) {
        const double exposure = exposures.at(i);
        const ErrorMap map =
            difference(eye.look(shown(image, exposure)), eye.look(shown(reference, exposure)),
                       image.width, image.height);
        for (std::size_t k = 0; k < map.values.size(); ++k) {
            result.values[k] = std::max(result.values[k], map.values[k]);
        }
    }
    return result;
}

}  // namespace bdpt::eval
