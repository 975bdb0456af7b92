#include "stage/render_preparation.h"

#include <bdpt/error.h>
#include <bdpt/io/rates_file.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "options/values/film_memory.h"
#include "options/values/strategy_depth.h"

namespace bdpt::app {
namespace {

/// What the film takes of --max-memory; 0 without a limit.
std::uint64_t reserved_bytes(const RenderArguments& arguments)
{
    if (!arguments.max_memory) {
        return 0;
    }
    // Without --size, as large as it can be.
    const Size size = arguments.size.value_or(default_size(std::nullopt));
    const std::uint64_t bytes = film_bytes(arguments.options, size);
    if (bytes >= *arguments.max_memory) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("the film of {}x{} pixels takes {} bytes, but the limit is {} "
                                "(--max-memory); a smaller --size, --crop or fewer layers of --aov "
                                "take less",
                                size.width, size.height, bytes, *arguments.max_memory));
    }
    return bytes;
}

/// `arguments`, whose loading shows on the console how far it is.
RenderArguments with_progress(RenderArguments arguments, Console& console)
{
    const auto start = std::chrono::steady_clock::now();
    arguments.scene.on_progress = [&console, start](const io::LoadProgress& progress) {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        constexpr double report_threshold = 1.0;  // [s]
        if (passed.count() < report_threshold) {
            return;
        }
        const double done =
            static_cast<double>(progress.images_done) / static_cast<double>(progress.images_total);
        console.task({.fraction = done,
                      .seconds = passed.count(),
                      .seconds_left = passed.count() * (1.0 - done) / done,
                      .activity = fmt::format("loading textures, {}/{}", progress.images_done,
                                              progress.images_total)});
    };
    return arguments;
}

RenderOptions options_for(const RenderArguments& arguments, const PreparedScene& stage,
                          Console& console)
{
    RenderOptions options = arguments.options;
    options.film.width = stage.size.width;
    options.film.height = stage.size.height;
    options.sampling.samples = arguments.samples;
    if (arguments.max_memory) {
        options.bidirectional.strategy_memory =
            std::min(options.bidirectional.strategy_memory,
                     *arguments.max_memory - reserved_bytes(arguments));
        options.bidirectional.light_path_memory =
            std::min(options.bidirectional.light_path_memory,
                     *arguments.max_memory - reserved_bytes(arguments));
    }
    if (arguments.strategies) {
        const StrategyDepth depth = strategy_depth(*arguments.strategies, options, stage.camera);
        options.bidirectional.strategy_depth = depth.edges;
        if (depth.warning) {
            console.warning(*depth.warning);
        }
    }
    return options;
}

std::shared_ptr<const SampleRates> rates_of(const RenderArguments& arguments,
                                            const PreparedScene& stage, Console& console)
{
    if (!arguments.rates->file) {
        const auto start = std::chrono::steady_clock::now();
        auto rates = std::make_shared<const SampleRates>(
            sample_rates(stage.scene, stage.camera, arguments.options));
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        console.note(fmt::format(
            "adaptive: {} to {} samples per pixel and round, {:.3f} in the mean, by a test render "
            "of {} samples in {:.1f} s",
            rates->least(), rates->greatest(), rates->mean(), rate_pilot_samples, passed.count()));
        return rates;
    }
    const std::filesystem::path& file = *arguments.rates->file;
    auto rates = std::make_shared<const SampleRates>(io::read_rates(file));
    if (rates->width() != stage.size.width || rates->height() != stage.size.height) {
        throw Error(
            ErrorCode::invalid_input,
            fmt::format("{}: rates of {}x{} pixels, but the image has {}x{}", file.string(),
                        rates->width(), rates->height(), stage.size.width, stage.size.height));
    }
    return rates;
}

}  // namespace

std::uint64_t image_cache_bytes(const RenderArguments& arguments)
{
    constexpr std::uint64_t without_limit = std::uint64_t{2} << 30U;
    return arguments.max_memory ? *arguments.max_memory / 4 : without_limit;
}

PreparedScene prepare_within_memory(const RenderArguments& asked, Console& console)
{
    RenderArguments arguments = with_progress(asked, console);
    const std::uint64_t film = reserved_bytes(arguments);
    if (film == 0) {
        return prepare_scene(arguments);
    }
    const std::uint64_t kept = arguments.scene.images ? image_cache_bytes(arguments) : 0;
    const std::uint64_t left = *arguments.max_memory - film;
    arguments.scene.limits = io::limits_within(left - std::min(left - 1, kept));
    try {
        return prepare_scene(arguments);
    } catch (const Error& error) {
        const std::string message = error.what();
        if (message.find("limit is") == std::string::npos &&
            message.find("of memory in all") == std::string::npos) {
            throw;
        }
        throw Error(
            error.code(),
            fmt::format("{} (--max-memory {} less {} for the film{})", message,
                        *arguments.max_memory, film,
                        kept > 0 ? fmt::format(" and {} for images of other frames", kept) : ""));
    }
}

RenderArguments with_choice(RenderArguments arguments, const PreparedScene& stage, Console& console)
{
    const IntegratorChoice choice =
        choose_integrator(stage.scene, stage.camera, options_for(arguments, stage, console));
    constexpr double worth_telling = 0.01;
    if (choice.unseen_light >= worth_telling) {
        console.warning(fmt::format(
            "about {:.2g} % of the light is missing: only --integrator vcm finds it "
            "(caustics of the sun or of point lights, seen in mirrors or through glass)",
            100.0 * choice.unseen_light));
    }
    arguments.options = choice.options;
    if (arguments.rates && !arguments.options.sampling.rates) {
        arguments.options.sampling.rates = rates_of(arguments, stage, console);
    }
    return arguments;
}

}  // namespace bdpt::app
