// Adaptive sampling: what is promised to the bit. Means are compared in tests/statistical.

#include <bdpt/error.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>

#include "catch.hpp"
#include "purity.h"
#include "room.h"
#include "scene_builder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::test::sample_rates_test {
namespace {

constexpr int width = 29;
constexpr int height = 23;

std::shared_ptr<const SampleRates> rates_of(const std::function<int()>& exponent)
{
    std::vector<std::int8_t> exponents;
    for (int i = 0; i < width * height; ++i) {
        exponents.push_back(static_cast<std::int8_t>(exponent()));
    }
    return std::make_shared<const SampleRates>(width, height, std::move(exponents));
}

std::shared_ptr<const SampleRates> random_rates(unsigned seed = 1)
{
    std::mt19937 engine(seed);
    return rates_of([&engine] {
        return std::uniform_int_distribution<int>(SampleRates::min_exponent,
                                                  SampleRates::max_exponent)(engine);
    });
}

RenderOptions options(IntegratorKind kind, double light_paths = 1.0)
{
    RenderOptions result;
    result.integrator = kind;
    result.film.width = width;
    result.film.height = height;
    result.film.aovs = {Aov::sample_count, Aov::alpha, Aov::shadow};
    result.sampling.samples = {.begin = 0, .end = 16};
    result.transport.max_depth = 5;
    result.bidirectional.light_paths = light_paths;
    return result;
}

/// All ways to transport light that rates go with.
std::vector<RenderOptions> kinds()
{
    std::vector<RenderOptions> result{options(IntegratorKind::pt), options(IntegratorKind::nee),
                                      options(IntegratorKind::mis), options(IntegratorKind::bdpt),
                                      options(IntegratorKind::bdpt, 0.3)};
    result.back().bidirectional.connections = 1.5;
    result.push_back(options(IntegratorKind::bdpt, 2.0));
    result.back().bidirectional.strategy_depth = 3;
    result.back().film.clamp = 2.0f;
    return result;
}

RenderOptions with(RenderOptions options, std::shared_ptr<const SampleRates> rates)
{
    options.sampling.rates = std::move(rates);
    return options;
}

RenderResult image_of(const Scene& scene, const RenderOptions& options)
{
    return render(scene, room_camera(), options);
}

std::string refusal(const Scene& scene, const RenderOptions& options)
{
    try {
        static_cast<void>(image_of(scene, options));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
        return error.what();
    }
    return {};
}

}  // namespace

TEST_CASE("rates of one each change no bit", "[rates][long]")
{
    const Scene scene = room();
    for (const RenderOptions& o : kinds()) {
        const RenderResult plain = image_of(scene, o);
        const RenderResult with_ones = image_of(scene, with(o, rates_of([] { return 0; })));
        CHECK(with_ones.film == plain.film);
        CHECK(with_ones.strategies == plain.strategies);
        CHECK(with_ones.stats == plain.stats);
    }
}

TEST_CASE("renders with rates are pure", "[rates][long]")
{
    const Scene scene = room();
    for (const RenderOptions& kind : kinds()) {
        const RenderOptions o = with(kind, random_rates());
        const RenderResult whole = image_of(scene, o);

        RenderOptions other = o;
        other.system.threads = 5;
        other.system.tile_size = 6;
        const RenderResult again = image_of(scene, other);
        CHECK(again.film == whole.film);
        CHECK(again.strategies == whole.strategies);
        CHECK(again.aovs == whole.aovs);
        CHECK(again.stats == whole.stats);

        other = o;
        other.film.crop = PixelRect{5, 3, 24, 20};
        check_region(image_of(scene, other).film.develop(), whole.film.develop(), *other.film.crop);

        RenderResult parts;
        for (const std::int64_t begin : {8, 0}) {
            other = o;
            other.sampling.samples = {.begin = begin, .end = begin + 8};
            RenderResult part = render(scene, room_camera(), other);
            if (begin == 8) {
                parts = std::move(part);
            } else {
                merge(parts, part);
            }
        }
        CHECK(parts.film == whole.film);
        CHECK(parts.aovs == whole.aovs);
        CHECK(parts.strategies == whole.strategies);
    }
}

TEST_CASE("a render with rates stops between groups of rounds, and goes on", "[rates]")
{
    const Scene scene = room();
    for (const RenderOptions& kind : {kinds()[2], kinds()[4]}) {
        RenderOptions o = with(kind, random_rates());
        o.sampling.samples.end = 40;
        RenderControl control;
        control.time_limit = 0.0;  // one pass
        RenderResult part = render(scene, room_camera(), o, control);
        CHECK(part.samples.text() == "0:8");
        part = continue_render(scene, room_camera(), o, std::move(part));
        CHECK(part.samples.text() == "0:40");
        CHECK(part.film == image_of(scene, o).film);
    }
}

TEST_CASE("sampleCount tells how many samples pixels took", "[rates]")
{
    const Scene scene = room();
    for (const RenderOptions& kind : {kinds()[2], kinds()[4]}) {
        const RenderOptions o = with(kind, random_rates());
        const RenderResult result = image_of(scene, o);
        const std::vector<Layer> layers = result.aovs.develop(result.film);
        REQUIRE(layers.size() == 3);
        const auto found = std::find_if(layers.begin(), layers.end(), [](const Layer& layer) {
            return layer.name == "sampleCount";
        });
        REQUIRE(found != layers.end());
        const Layer& counts = *found;
        std::uint64_t sum = 0;
        int wrong = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const float count = counts.values[static_cast<std::size_t>(y * width + x)];
                wrong += count == 16.0f * o.sampling.rates->rate(x, y) ? 0 : 1;
                sum += static_cast<std::uint64_t>(count);
            }
        }
        CHECK(wrong == 0);
        CHECK(result.stats.paths.camera == sum);
    }
}

TEST_CASE("observers and images of strategies get what counts", "[rates]")
{
    const Scene scene = room();
    for (const double light_paths : {1.0, 0.3}) {
        RenderOptions o = with(options(IntegratorKind::bdpt, light_paths), random_rates());
        o.transport.max_depth = 3;
        o.bidirectional.strategy_depth = 3;
        std::mutex mutex;
        double seen = 0.0;
        RenderControl control;
        control.on_path = [&](const PathContribution& path) {
            const std::scoped_lock lock(mutex);
            seen += static_cast<double>(path.weight * path.unweighted.g);
        };
        const RenderResult result = render(scene, room_camera(), o, control);
        double image = 0.0;
        for (const Rgb& pixel : result.film.develop().pixels) {
            image += static_cast<double>(pixel.g);
        }
        double strategies = 0.0;
        for (const Strategy strategy : result.strategies.strategies()) {
            for (const Rgb& pixel : result.strategies.weighted(strategy).pixels) {
                strategies += static_cast<double>(pixel.g);
            }
        }
        CHECK(seen / 16.0 == Approx(image).epsilon(1e-5));
        CHECK(strategies == Approx(image).epsilon(1e-5));
    }
}

TEST_CASE("parts with other rates are refused by name", "[rates]")
{
    const Scene scene = room();
    const RenderOptions plain = options(IntegratorKind::mis);
    const RenderOptions o = with(plain, random_rates(1));
    const RenderResult part = render(scene, room_camera(), o);
    for (const RenderOptions& other : {with(plain, random_rates(2)), plain}) {
        RenderResult others = render(scene, room_camera(), other);
        try {
            merge(others, part);
            FAIL("merged");
        } catch (const Error& error) {
            CHECK(std::string(error.what()).find("option: rates") != std::string::npos);
        }
    }
    CHECK(identity(scene, room_camera(), plain).components.size() + 1 ==
          identity(scene, room_camera(), o).components.size());
}

TEST_CASE("what rates do not go with is refused", "[rates]")
{
    const Scene scene = room();
    const RenderOptions o = with(options(IntegratorKind::bdpt), random_rates());
    RenderOptions other = o;
    other.sampling.samples = {.begin = 0, .end = 12};
    CHECK(refusal(scene, other).find("end at 12") != std::string::npos);
    other.sampling.samples = {.begin = 4, .end = 16};
    CHECK(refusal(scene, other).find("end at 4,") != std::string::npos);
    other.sampling.samples = {.begin = 0, .end = (std::int64_t{1} << 30) + 8};
    CHECK(refusal(scene, other).find("1073741832, not in [1, 1073741824]") != std::string::npos);
    other = o;
    other.film.width = width + 1;
    CHECK(refusal(scene, other).find("29x23 pixels, not of 30x23") != std::string::npos);
    for (const IntegratorKind kind : {IntegratorKind::lt, IntegratorKind::vcm}) {
        other = o;
        other.integrator = kind;
        CHECK(refusal(scene, other).find("cannot be combined with the integrator") !=
              std::string::npos);
        other.sampling.rates.reset();
        CHECK_THROWS_AS(sample_rates(scene, room_camera(), other), Error);
    }
}

TEST_CASE("auto chooses as it does without rates", "[rates]")
{
    const Scene scene = room();
    const RenderOptions o = options(IntegratorKind::automatic);
    const RenderOptions plain = chosen_options(scene, room_camera(), o);
    const RenderOptions chosen = chosen_options(scene, room_camera(), with(o, random_rates()));
    CHECK(chosen.integrator == plain.integrator);
    CHECK(chosen.bidirectional.light_paths == plain.bidirectional.light_paths);
    CHECK(chosen.bidirectional.connections == plain.bidirectional.connections);
    CHECK(chosen.sampling.rates != nullptr);
}

TEST_CASE("rates are a pure function of scene, camera and options", "[rates]")
{
    const Scene scene = room();
    for (RenderOptions o : {kinds()[2], kinds()[3], kinds()[4]}) {
        const SampleRates rates = sample_rates(scene, room_camera(), o);
        CHECK(rates.mean() <= 1.0);
        CHECK(rates.mean() > 0.99);
        CHECK(rates.least() < rates.greatest());
        o.sampling.seed = 77;
        o.sampling.samples = {.begin = 3, .end = 5};
        o.sampling.rates = random_rates();
        o.film.crop = PixelRect{5, 3, 24, 20};
        o.film.aovs = {};
        o.system.threads = 5;
        o.system.tile_size = 7;
        o.sampling.rates.reset();
        CHECK(sample_rates(scene, room_camera(), o) == rates);
    }
}

TEST_CASE("any image has rates", "[rates]")
{
    const Scene scene = room();
    for (const auto& [columns, rows] : {std::pair(1, 1), std::pair(1, 9), std::pair(3, 2)}) {
        RenderOptions o = options(IntegratorKind::bdpt);
        o.film.width = columns;
        o.film.height = rows;
        const auto rates = std::make_shared<SampleRates>(sample_rates(scene, room_camera(), o));
        CHECK(rates->mean() <= 1.0);
        CHECK(rates->mean() >= 0.75);
        o.sampling.rates = rates;
        CHECK(image_of(scene, o).samples.end() == 16);
    }
    // All black.
    const SampleRates none =
        sample_rates(Scene(SceneDesc{}), room_camera(), options(IntegratorKind::mis));
    CHECK(none.least() == 1.0f);
    CHECK(none.greatest() == 1.0f);
}

}  // namespace bdpt::test::sample_rates_test
