#include "pilot/pilot_errors.h"

#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace bdpt::test::pilot_errors_test {
namespace {

constexpr float radiance = 3.0f;

PathContribution path_of(Strategy strategy, const std::vector<float>& shares)
{
    return {.strategy = strategy,
            .raster = Vec2(0.5f),
            .unweighted = Rgb(radiance),
            .weight = 1.0f,
            .chance = static_cast<float>(PathShares::pilot_rays),  // its only connection
            .shares = shares};
}

/// Camera paths of one sample find two lights each, by next-event estimation alone; those of the
/// other sample find nothing.
class TwoLights final : public Integrator {
public:
    explicit TwoLights(int edges, bool in_body = false)
        : edges_(edges), in_body_(in_body), shares_(static_cast<std::size_t>(edges) + 2)
    {
        shares_[1] = 1.0f;
    }
    RenderStats render_tile(const Tile& /*tile*/, SampleRange samples,
                            const Films& films) const override
    {
        for (int i = 0; i < 2 && samples.begin == 0; ++i) {
            PathContribution path = path_of({.s = 1, .t = edges_}, shares_);
            path.scatters_in_body = in_body_;
            films.on_path(path);
        }
        return {};
    }

private:
    int edges_;
    bool in_body_;
    std::vector<float> shares_;
};

/// Each camera path finds a light that light paths find as often, by splats.
class SplattedLight final : public Integrator {
public:
    RenderStats render_tile(const Tile& /*tile*/, SampleRange /*samples*/,
                            const Films& films) const override
    {
        films.on_path(path_of({.s = 1, .t = 3}, shares_));
        return {};
    }

private:
    std::vector<float> shares_{0.0f, 0.5f, 0.0f, 0.5f, 0.0f};
};

/// Each camera path finds a light by next-event estimation. The first ones also find one by
/// connections, which next-event estimation would do only once in 10,000 times.
class Glints final : public Integrator {
public:
    explicit Glints(int count) : count_(count) {}
    RenderStats render_tile(const Tile& /*tile*/, SampleRange /*samples*/,
                            const Films& films) const override
    {
        films.on_path(path_of({.s = 1, .t = 3}, by_next_event_));
        if (found_ < count_) {
            ++found_;
            films.on_path(path_of({.s = 2, .t = 2}, by_connections_));
        }
        return {};
    }

private:
    int count_;
    mutable int found_ = 0;
    std::vector<float> by_next_event_{0.0f, 1.0f, 0.0f, 0.0f, 0.0f};
    std::vector<float> by_connections_{0.0f, 1e-4f, 0.9999f, 0.0f, 0.0f};
};

/// Each camera path finds two lights by connections: one that is chosen with a small chance, and
/// one that always is. It also finds one by next-event estimation, which connections find as often.
class ConnectedLights final : public Integrator {
public:
    static constexpr double small_chance = 0.05;  // of one connection, by one ray
    RenderStats render_tile(const Tile& /*tile*/, SampleRange /*samples*/,
                            const Films& films) const override
    {
        PathContribution path = path_of({.s = 2, .t = 2}, shares_);
        films.on_path(path);
        path.chance *= static_cast<float>(small_chance);
        films.on_path(path);
        films.on_path(path_of({.s = 1, .t = 3}, shares_));
        return {};
    }

private:
    std::vector<float> shares_{0.0f, 0.5f, 0.5f, 0.0f, 0.0f};
};

/// One sample's camera paths find a number of lights by connections that are chosen with a small
/// chance, those of the other one by a connection that always is.
class ManyConnections final : public Integrator {
public:
    explicit ManyConnections(int count) : count_(count) {}
    RenderStats render_tile(const Tile& /*tile*/, SampleRange samples,
                            const Films& films) const override
    {
        PathContribution path = path_of({.s = 2, .t = 2}, shares_);
        if (samples.begin == 1) {
            films.on_path(path);
            return {};
        }
        path.chance *= static_cast<float>(ConnectedLights::small_chance);
        for (int i = 0; i < count_; ++i) {
            films.on_path(path);
        }
        return {};
    }

private:
    int count_;
    std::vector<float> shares_{0.0f, 0.5f, 0.5f, 0.0f, 0.0f};
};

/// Each camera path merges with equal light paths, of which each found one stands for several.
/// `share` is the share of s = 0 in each; if it is 0, only merging finds that light, and each
/// camera path finds another one by next-event estimation.
class EqualMerges final : public Integrator {
public:
    EqualMerges(int found, double chance, float share = 0.001f)
        : found_(found), chance_(chance), shares_{share, 0.0f, 0.0f, 0.0f, 0.0f}
    {}
    RenderStats render_tile(const Tile& /*tile*/, SampleRange /*samples*/,
                            const Films& films) const override
    {
        for (int i = 0; i < found_; ++i) {
            PathContribution path = path_of({.s = 2, .t = 3}, shares_);
            path.merged = true;
            path.chance = static_cast<float>(chance_);
            path.unweighted *= 1.0f / path.chance;
            films.on_path(path);
        }
        if (shares_[0] == 0.0f) {
            films.on_path(path_of({.s = 1, .t = 3}, {0.0f, 1.0f, 0.0f, 0.0f, 0.0f}));
        }
        return {};
    }

private:
    int found_;
    double chance_;
    std::vector<float> shares_;
};

/// One of some camera paths finds a light by next-event estimation.
class RareLight final : public Integrator {
public:
    RenderStats render_tile(const Tile& tile, SampleRange samples,
                            const Films& films) const override
    {
        if (samples.begin == 0 && tile.x_begin % 5 == 0 && tile.y_begin % 5 == 0) {
            films.on_path(path_of({.s = 1, .t = 3}, shares_));
        }
        return {};
    }

private:
    std::vector<float> shares_{0.0f, 1.0f, 0.0f, 0.0f, 0.0f};
};

PilotContributions contributions_of(const Integrator& lights, PilotGrid grid)
{
    PilotContributions contributions{
        .grid = grid,
        .light_paths = 1.0,
        .rows = std::vector<PilotRow>(static_cast<std::size_t>(grid.rows())),
        .parts = {}};
    for (int index = 0; index < PilotRow::samples_of_cell; ++index) {
        for (int row = 0; row < grid.rows(); ++row) {
            contributions.rows[static_cast<std::size_t>(row)].render(
                lights, grid, Heuristic::power, row, index, contributions.light_paths);
        }
    }
    return contributions;
}

PilotErrors prediction_with_glints(int count)
{
    const PilotContributions contributions = contributions_of(Glints(count), PilotGrid(200, 100));
    return predict_errors(contributions, PilotBrightness(contributions));
}

std::size_t one_light_path()
{
    const auto found = std::find(candidates.begin(), candidates.end(), Candidate{1.0, 1.0});
    return static_cast<std::size_t>(found - candidates.begin());
}

/// Returns the standard error of the prediction.
double noise_of(const PilotErrors& errors, std::size_t candidate)
{
    return std::sqrt(errors.covariances[candidate][candidate]);
}

/// What the choice of connections adds for paths that no connection found, of which these have
/// none.
constexpr PerCandidate<double> no_choice{};

PerCandidate<double> errors_with_glints(int count)
{
    return prediction_with_glints(count).of_image;
}

}  // namespace

TEST_CASE(
    "of the variance of sums a part is left, of direct light another than of the rest, and "
    "all of light in bodies",
    "[pilot]")
{
    const bool direct = GENERATE(true, false);
    const bool in_body = GENERATE(true, false);
    CAPTURE(direct, in_body);
    const PilotContributions contributions =
        contributions_of(TwoLights(direct ? 2 : 3, in_body), PilotGrid(1, 1));
    const PilotBrightness brightness(contributions);
    const double scale = brightness.scale(0);
    REQUIRE(contributions.rows[0].joined().size() == 2);
    const RemainingErrors of_one_path =
        remaining_errors(contributions.rows[0].joined()[0].shares, scale, no_choice);
    // Sums of 2 L and of 0: the products of different paths of a sample are 2 L^2 and 0.
    const double variance_of_sums = static_cast<double>(radiance * radiance);
    const double left = pilot_constants.qmc.sums[in_body  ? PathShares::in_body
                                                 : direct ? PathShares::direct
                                                          : PathShares::indirect];
    const double of_sums = left * scale * variance_of_sums;
    const double unseen = 0.2 * (of_one_path.sum(one_light_path()) + of_sums);
    const PilotErrors errors = predict_errors(contributions, brightness);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        CHECK(errors.of_image[k] - unseen == Approx(of_one_path.sum(k) + of_sums));
        for (std::size_t j = 0; j < candidates.size(); ++j) {
            CHECK(errors.covariances[k][j] ==
                  Approx(of_one_path.sum(k) * of_one_path.sum(j) / 2.0));
        }
        // The only cell is the image.
        CHECK(errors.of_cells.camera[0][k] == Approx(of_one_path.camera[k] + of_sums));
        CHECK(errors.of_cells.splats[k] == Approx(of_one_path.splats[k]));
    }
}

TEST_CASE("errors of cells are apart from those of splats, which rates do not change", "[pilot]")
{
    const PilotContributions contributions = contributions_of(SplattedLight(), PilotGrid(200, 100));
    const PilotErrors errors = predict_errors(contributions, PilotBrightness(contributions));
    const double unseen = 2.0 * noise_of(errors, one_light_path());
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        CAPTURE(k);
        double camera = 0.0;
        for (const PerCandidate<double>& cell : errors.of_cells.camera) {
            camera += cell[k] / static_cast<double>(errors.of_cells.camera.size());
        }
        CHECK((errors.of_cells.splats[k] > 0.0) == (candidates[k].light_paths > 0.0));
        CHECK(errors.of_image[k] - unseen ==
              Approx(camera + errors.of_cells.splats[k]).margin(1e-5));
    }
}

TEST_CASE("a merged path counts like all those for which it stands", "[pilot]")
{
    struct Prediction {
        double brightness;
        double error;  ///< without what is added for rare paths
        PilotErrors errors;
    };
    const auto predicted = [](int found, double chance) {
        const PilotContributions contributions =
            contributions_of(EqualMerges(found, chance), PilotGrid(40, 40));
        const PilotBrightness brightness(contributions);
        const PilotErrors errors = predict_errors(contributions, brightness);
        return Prediction{.brightness = brightness.average(),
                          .error = errors.of_image[0] - 2.0 * noise_of(errors, one_light_path()),
                          .errors = errors};
    };
    // Of 64 some are kept; of 4 all are, and each stands for twice as many.
    const Prediction all = predicted(64, 1.0);
    CHECK(all.error > 0.0);
    for (const auto& [some, number] :
         {std::pair(predicted(4, 0.0625), 2.0), std::pair(predicted(32, 0.5), 1.0)}) {
        CHECK(some.brightness == Approx(all.brightness));
        CHECK(some.error == Approx(all.error).epsilon(1e-3));  // but for the first few paths
        CHECK(some.errors.of_cells.camera[3][0] == Approx(all.errors.of_cells.camera[3][0]));
        CHECK(some.errors.covariances[0][0] ==
              Approx(number * all.errors.covariances[0][0]).epsilon(1e-3));
    }
}

TEST_CASE("a merged path is findable if a render finds one of those it stands for", "[pilot]")
{
    const auto findable = [](double chance) {
        const PilotContributions contributions =
            contributions_of(EqualMerges(8, chance), PilotGrid(1, 1));
        return findable_merged_paths(contributions, PilotBrightness(contributions)).size();
    };
    // A usual render has 64 paths in the pixel, each merge stands for a thousandth of one.
    CHECK(findable(1.0) == 0);
    CHECK(findable(0.125) > 0);
}

TEST_CASE("light that merging alone finds is that of all paths for which the found ones stand",
          "[pilot]")
{
    const auto share = [](int found, double chance) {
        const PilotContributions contributions =
            contributions_of(EqualMerges(found, chance, 0.0f), PilotGrid(4, 4));
        return share_of_merging_alone(contributions, PilotBrightness(contributions));
    };
    // Beside one path that next-event estimation finds.
    CHECK(share(16, 1.0) == Approx(16.0 / 17.0));
    CHECK(share(4, 0.25) == Approx(16.0 / 17.0));
}

TEST_CASE("rare paths are expected where the error of the paths found is noisy", "[pilot]")
{
    // Of many equal paths the error is certain; of few it is not. Then a fifth is added.
    const auto unseen = [](PilotGrid grid) {
        const PilotContributions contributions = contributions_of(TwoLights(3), grid);
        const PilotBrightness brightness(contributions);
        const double left = pilot_constants.qmc.sums[PathShares::indirect] *
                            static_cast<double>(radiance * radiance);
        const double scale = brightness.scale(0);
        const RemainingErrors of_one_path =
            remaining_errors(contributions.rows[0].joined()[0].shares, scale, no_choice);
        const double found = of_one_path.sum(one_light_path()) + left * scale;
        return predict_errors(contributions, brightness).of_image[one_light_path()] / found - 1.0;
    };
    CHECK(unseen(PilotGrid(1, 1)) == Approx(0.2).epsilon(0.001));
    CHECK(unseen(PilotGrid(800, 800)) < 0.05);
    CHECK(unseen(PilotGrid(800, 800)) > 0.0);
}

TEST_CASE("where light is rare in the whole image, nothing is added for noise of the prediction",
          "[pilot]")
{
    const PilotContributions contributions = contributions_of(RareLight(), PilotGrid(25, 20));
    const PilotBrightness brightness(contributions);
    const PilotErrors errors = predict_errors(contributions, brightness);
    CHECK(errors.light_is_rare);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        CAPTURE(k);
        double camera = 0.0;
        for (const PerCandidate<double>& cell : errors.of_cells.camera) {
            camera += cell[k] / static_cast<double>(errors.of_cells.camera.size());
        }
        CHECK(errors.of_image[k] == Approx(camera - errors.of_cells.fireflies[k]));
    }
    CHECK_FALSE(prediction_with_glints(20).light_is_rare);
}

TEST_CASE("what the choice of connections adds is measured where connections find paths", "[pilot]")
{
    const PilotContributions contributions = contributions_of(ConnectedLights(), PilotGrid(8, 8));
    const PilotBrightness brightness(contributions);
    const PerCandidate<double> choice = measure_choice(contributions, brightness);
    const std::vector<PilotContribution>& joined = contributions.rows[0].joined();
    REQUIRE(joined.size() >= 3);
    const double scale = brightness.scale(joined[2].cell);
    REQUIRE_FALSE(joined[2].shares.choice_is_known());
    const RemainingErrors with_choice = remaining_errors(joined[2].shares, scale, choice);
    const RemainingErrors without = remaining_errors(joined[2].shares, scale, no_choice);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const Candidate& numbers = candidates[k];
        CAPTURE(numbers.light_paths, numbers.connections, numbers.connection_rays);
        const double chance = ConnectedLights::small_chance * numbers.connection_rays *
                              PathShares::pilot_connections / std::max(1.0, numbers.connections);
        const bool chooses = numbers.connection_rays > 0.0;
        // One of two equal connections is chosen so rarely.
        CHECK(choice[k] == Approx(chooses ? 0.5 * (1.0 / chance - 1.0) : 0.0));
        CHECK((with_choice.camera[k] > without.camera[k]) == chooses);
        // Of paths that a connection found, the own chance counts.
        CHECK(remaining_errors(joined[0].shares, scale, choice).camera[k] ==
              remaining_errors(joined[0].shares, scale, no_choice).camera[k]);
    }
}

TEST_CASE("connections count for all those for which they stand", "[pilot]")
{
    constexpr int count = 32;
    const PilotContributions contributions =
        contributions_of(ManyConnections(count), PilotGrid(8, 8));
    REQUIRE(contributions.rows[0].joined().size() < 8 * (count + 1) / 2);
    const PerCandidate<double> choice =
        measure_choice(contributions, PilotBrightness(contributions));
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double chance = ConnectedLights::small_chance * candidates[k].connection_rays *
                              PathShares::pilot_connections /
                              std::max(1.0, candidates[k].connections);
        CHECK(choice[k] ==
              Approx(chance > 0.0 ? count / (count + 1.0) * (1.0 / chance - 1.0) : 0.0));
    }
}

TEST_CASE(
    "in bodies that scatter light, the variance of camera paths is that of independent samples",
    "[pilot][media]")
{
    std::vector<float> shares{0.0f, 0.2f, 0.3f, 0.5f, 0.0f};  // own, connection, splat
    PathContribution contribution = path_of({.s = 2, .t = 2}, shares);
    const PathShares outside(contribution, Heuristic::power, 1.0);
    contribution.scatters_in_body = true;
    const PathShares inside(contribution, Heuristic::power, 1.0);
    constexpr double scale = 0.01;
    const PathShares::SecondMoments moments = inside.second_moments();
    const RemainingErrors in_body = remaining_errors(inside, scale, no_choice);
    const RemainingErrors elsewhere = remaining_errors(outside, scale, no_choice);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (candidates[k].connection_rays == 0.0) {
            CHECK(in_body.camera[k] == Approx(scale * (moments.own[k] + moments.connections[k])));
        }
        CHECK(elsewhere.camera[k] < 0.5 * in_body.camera[k]);
        CHECK(elsewhere.splats[k] == in_body.splats[k]);
    }
}

TEST_CASE("a path that a usual render hardly finds does not count, but many of them do", "[pilot]")
{
    const PerCandidate<double> none = errors_with_glints(0);
    const PerCandidate<double> one = errors_with_glints(1);
    const PerCandidate<double> many = errors_with_glints(2000);
    REQUIRE(candidates[0].light_paths == 0.0);
    CHECK(one[0] == Approx(none[0]).epsilon(0.02));
    CHECK(many[0] > 100.0 * none[0]);
    // Of one, the choice of rates knows that it is somewhere.
    const PilotErrors of_one = prediction_with_glints(1);
    CHECK(of_one.of_cells.fireflies[0] > 10.0 * none[0]);
    CHECK(of_one.of_cells.fireflies[0] < many[0]);
    CHECK(noise_of(of_one, 0) > 10.0 * noise_of(prediction_with_glints(0), 0));
    CHECK(prediction_with_glints(0).of_cells.fireflies[0] < 0.1 * none[0]);
    // One may be chance, several are not.
    CHECK(of_one.sure_fireflies[0] == 0.0);
    const PilotErrors of_some = prediction_with_glints(20);
    CHECK(of_some.sure_fireflies[0] > 0.5 * of_some.of_cells.fireflies[0]);
    CHECK(of_some.of_cells.fireflies[0] > 10.0 * none[0]);
    // A usual render has three of these, in 20,000 pixels, but with too much light to be left out.
    CHECK(errors_with_glints(100)[0] > 10.0 * none[0]);
    // With connections they are like all others.
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (candidates[k].connections >= 1.0) {
            CHECK(one[k] == Approx(none[k]).epsilon(0.02));
            // Two light samples leave so little that `none` may be less than 0.
            const Candidate& numbers = candidates[k];
            const Candidate one_sample{numbers.light_paths, numbers.connections,
                                       numbers.connection_rays};
            const auto usual = std::find(candidates.begin(), candidates.end(), one_sample);
            REQUIRE(usual != candidates.end());
            CHECK(many[k] < 10.0 * none[static_cast<std::size_t>(usual - candidates.begin())]);
        }
    }
}

}  // namespace bdpt::test::pilot_errors_test
