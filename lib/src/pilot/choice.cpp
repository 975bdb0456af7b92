#include "pilot/pilot.h"

#include "rates/rate_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace bdpt {
namespace {

/// Returns whether the candidate is taken only for a gain that exceeds the noise of the prediction:
/// the choice of connections is predicted less well than all of them, and more light paths take
/// time from camera paths, whose rarest contributions no pilot finds.
bool needs_sure_gain(const Candidate& candidate)
{
    return candidate.connection_rays > 0.0 || candidate.light_paths > 1.0;
}

/// A candidate's product of error and cost, by which it is judged.
class Product {
public:
    Product(const PilotMeasurements& pilot, const Candidate& numbers, std::size_t candidate,
            const ChoiceConstants& constants)
        : candidate_(candidate),
          sure_(constants.sure_standard_errors),
          covariances_(&pilot.covariances)
    {
        // Path tracing has to hit lights that are directly visible.
        const double visible_lights =
            numbers.light_paths > 0.0 ? pilot.visible_lights.by_both : pilot.visible_lights.by_hits;
        const double error =
            std::max(constants.min_error, pilot.errors[candidate] + visible_lights);
        // The square root: usual renders show few of these paths, and long ones more.
        const double by_fireflies = std::sqrt(1.0 + pilot.fireflies[candidate] / error);
        const bool splats_alone = numbers.light_paths > 0.0 && numbers.connections == 0.0;
        const double penalty =
            by_fireflies *
            (splats_alone && numbers.light_paths <= 1.0 ? constants.margin_of_connections : 1.0);
        per_error_ = penalty * pilot.costs[candidate];
        value_ = error * per_error_;
    }

    [[nodiscard]] std::size_t candidate() const { return candidate_; }
    [[nodiscard]] bool operator<(const Product& other) const { return value_ < other.value_; }
    /// Returns whether this product is less than another by more than so many standard errors of
    /// the difference.
    [[nodiscard]] bool surely_less(const Product& other) const
    {
        const std::size_t a = candidate_;
        const std::size_t b = other.candidate_;
        const PerCandidate<PerCandidate<double>>& covariances = *covariances_;
        const double variance = per_error_ * per_error_ * covariances[a][a] -
                                2.0 * per_error_ * other.per_error_ * covariances[a][b] +
                                other.per_error_ * other.per_error_ * covariances[b][b];
        return value_ + sure_ * std::sqrt(std::max(0.0, variance)) < other.value_;
    }

private:
    std::size_t candidate_;
    double sure_;  ///< standard errors
    const PerCandidate<PerCandidate<double>>* covariances_;
    double per_error_ = 0.0;
    double value_ = 0.0;
};

}  // namespace

std::size_t choose(const PilotMeasurements& pilot, const PerCandidate<Candidate>& among,
                   const ChoiceConstants& constants)
{
    std::optional<Product> usual;  // the least of those that need no sure gain
    for (std::size_t k = 0; k < among.size(); ++k) {
        const Product product(pilot, among[k], k, constants);
        if (!needs_sure_gain(among[k]) && !pilot.ruled_out[k] && (!usual || product < *usual)) {
            usual = product;
        }
    }
    Product best = *usual;
    for (std::size_t k = 0; k < among.size(); ++k) {
        const Product product(pilot, among[k], k, constants);
        if (needs_sure_gain(among[k]) && !pilot.ruled_out[k] && product < best &&
            product.surely_less(*usual)) {
            best = product;
        }
    }
    return best.candidate();
}

namespace {

constexpr const RateConstants& rate_constants = pilot_constants.rates;

/// Limits the errors of the brightest cells.
void clamp_fireflies(Plane& errors)
{
    const auto fireflies = static_cast<std::size_t>(rate_constants.share_of_fireflies *
                                                    static_cast<double>(errors.size()));
    Plane sorted = errors;
    const auto limit = sorted.end() - 1 - static_cast<std::ptrdiff_t>(fireflies);
    std::nth_element(sorted.begin(), limit, sorted.end());
    for (double& error : errors) {
        error = std::min(error, *limit);
    }
}

/// Errors and costs of the cells for one candidate, averaged over neighbours.
struct Evidence {
    Plane errors;
    Plane costs;
    double splats;
};

Evidence evidence_for(std::size_t candidate, const PilotGrid& grid, const CellErrors& cells)
{
    const PlaneSize size{.width = grid.columns(), .height = grid.rows()};
    Plane errors;
    Plane costs;
    for (std::size_t i = 0; i < grid.cells(); ++i) {
        errors.push_back(cells.camera[i][candidate]);
        costs.push_back(cells.costs[i][candidate]);
    }
    clamp_fireflies(errors);
    const double unseen =
        rate_constants.unseen_share * std::max(0.0, mean_of(errors)) + cells.fireflies[candidate];
    errors = local_mean(errors, size, rate_constants.mean_radius);
    Plane shares = local_mean(cells.scattering, size, rate_constants.mean_radius);
    for (double& share : shares) {
        share = std::max(share, rate_constants.share_of_background);
    }
    const double mean_share = mean_of(shares);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        errors[i] = std::max(0.0, errors[i]) + unseen * shares[i] / mean_share;
    }
    return {.errors = std::move(errors),
            .costs = local_mean(costs, size, rate_constants.mean_radius),
            .splats = cells.splats[candidate]};
}

/// Exponents that have a mean rate of at most 1, and of more; they differ in few cells, or in many
/// that want the same.
struct WholeExponents {
    Plane low;
    Plane high;
    double share_of_high;  ///< of the cells that differ, for a mean rate of 1
};

/// Returns the wanted exponents of the cells, as whole numbers: rates between powers of two are
/// mixtures, which gain less.
WholeExponents whole_exponents(const Evidence& evidence)
{
    Plane octaves(evidence.errors.size());
    for (std::size_t i = 0; i < octaves.size(); ++i) {
        octaves[i] = 0.5 * octaves_of(evidence.errors[i] / evidence.costs[i]);
    }
    const auto moved = [&](double shift) {
        Plane exponents(octaves.size());
        for (std::size_t i = 0; i < octaves.size(); ++i) {
            exponents[i] = std::clamp(std::round(octaves[i] + shift),
                                      static_cast<double>(rate_constants.min_exponent),
                                      static_cast<double>(rate_constants.max_exponent));
        }
        return exponents;
    };
    const auto mean_rate = [](const Plane& exponents) {
        double sum = 0.0;
        for (const double exponent : exponents) {
            sum += static_cast<double>(SampleRates::to_rate(static_cast<int>(exponent)));
        }
        return sum / static_cast<double>(exponents.size());
    };
    double low = -200.0;
    double high = 200.0;
    for (int i = 0; i < 40; ++i) {
        const double shift = 0.5 * (low + high);
        (mean_rate(moved(shift)) <= 1.0 ? low : high) = shift;
    }
    WholeExponents result{.low = moved(low), .high = moved(high), .share_of_high = 0.0};
    const double least = mean_rate(result.low);
    result.share_of_high = (1.0 - least) / (mean_rate(result.high) - least);
    return result;
}

/// Returns exponents without small islands, which are chance, and without steps: they change slowly
/// but for the border of the background, which is known.
Plane smooth_exponents(const Evidence& evidence, const PilotGrid& grid, const Plane& scattering)
{
    const PlaneSize size{.width = grid.columns(), .height = grid.rows()};
    const double side = std::sqrt(grid.pixels() / static_cast<double>(grid.cells()));
    const int radius =
        std::max(1, static_cast<int>(std::lround(rate_constants.smooth_pixels / side)));
    const auto without_islands = [&](Plane exponents, const Plane& weights) {
        for (int pass = 0; pass < 2; ++pass) {
            exponents = local_mean(exponents, weights, size, rate_constants.island_radius);
            for (double& exponent : exponents) {
                exponent = std::round(exponent);
            }
        }
        return exponents;
    };
    const WholeExponents wanted = whole_exponents(evidence);
    const auto smooth = [&](const Plane& weights) {
        Plane exponents = without_islands(wanted.low, weights);
        const Plane high = without_islands(wanted.high, weights);
        for (std::size_t i = 0; i < exponents.size(); ++i) {
            exponents[i] = std::lerp(exponents[i], high[i], wanted.share_of_high);
        }
        for (int pass = 0; pass < 2; ++pass) {  // nearly a Gaussian
            exponents = local_mean(exponents, weights, size, radius);
        }
        return exponents;
    };
    Plane background(scattering.size());
    std::transform(scattering.begin(), scattering.end(), background.begin(),
                   [](double share) { return 1.0 - share; });
    Plane result = smooth(scattering);
    const Plane of_background = smooth(background);
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = scattering[i] > 0.0 ? result[i] : of_background[i];
    }
    return result;
}

/// Interpolates the values of cells between their centres.
class Interpolation {
public:
    Interpolation(const PilotGrid& grid, const Plane& cells) : grid_(grid), cells_(cells) {}

    [[nodiscard]] double operator()(int x, int y) const
    {
        const Place across = place(x, grid_.columns(), grid_.width());
        const Place down = place(y, grid_.rows(), grid_.height());
        const auto row = [&](int at) {
            return std::lerp(cells_[grid_.index(across.first, at)],
                             cells_[grid_.index(across.second, at)], across.fraction);
        };
        return std::lerp(row(down.first), row(down.second), down.fraction);
    }

private:
    struct Place {
        int first;
        int second;
        double fraction;
    };
    [[nodiscard]] static Place place(int pixel, int cells, int pixels)
    {
        const double at = std::clamp((pixel + 0.5) * cells / pixels - 0.5, 0.0, cells - 1.0);
        const int first = std::min(static_cast<int>(at), cells - 1);
        return {.first = first, .second = std::min(first + 1, cells - 1), .fraction = at - first};
    }

    const PilotGrid& grid_;
    const Plane& cells_;
};

/// Returns error times cost with the rates over that without.
double product_of(const Evidence& evidence, const SampleRates& rates, const PilotGrid& grid)
{
    const std::vector<int> columns = grid.columns_of_pixels();
    const std::vector<int> rows = grid.rows_of_pixels();
    double error = 0.0;
    double error_of_equal = 0.0;
    double cost = 0.0;
    double cost_of_equal = 0.0;
    for (int y = 0; y < grid.height(); ++y) {
        for (int x = 0; x < grid.width(); ++x) {
            const std::size_t cell =
                grid.index(columns[static_cast<std::size_t>(x)], rows[static_cast<std::size_t>(y)]);
            const auto rate = static_cast<double>(rates.rate(x, y));
            error += evidence.errors[cell] / rate + evidence.splats;
            error_of_equal += evidence.errors[cell] + evidence.splats;
            cost += evidence.costs[cell] * rate;
            cost_of_equal += evidence.costs[cell];
        }
    }
    return error / error_of_equal * (cost / cost_of_equal);
}

}  // namespace

std::shared_ptr<const SampleRates> choose_rates(const PilotMeasurements& pilot,
                                                std::size_t candidate)
{
    if (pilot.light_is_rare) {
        return nullptr;
    }
    const PilotGrid& grid = pilot.grid;
    const CellErrors& cells = pilot.cells;
    const Evidence evidence = evidence_for(candidate, grid, cells);
    const double mean = mean_of(evidence.errors);
    if (!(mean > 0.0) || !std::isfinite(mean)) {
        return nullptr;  // no noise, or noise that the candidate cannot reduce
    }
    const Plane exponents = smooth_exponents(evidence, grid, cells.scattering);
    auto rates = std::make_shared<const SampleRates>(dithered_rates(
        {.width = grid.width(), .height = grid.height()}, Interpolation(grid, exponents),
        {.min = rate_constants.min_exponent, .max = rate_constants.max_exponent}));
    return product_of(evidence, *rates, grid) <= rate_constants.worthwhile ? rates : nullptr;
}

}  // namespace bdpt
