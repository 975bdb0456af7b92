#include "live/live_render.h"

#include <bdpt/noise.h>
#include <bdpt/part/sample_rates.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "options/output_files.h"
#include "output/image_files.h"
#include "output/render_report.h"
#include "stage/prepared_scene.h"

namespace bdpt::view {

namespace {

double pixels(const Size& size)
{
    return static_cast<double>(size.width) * size.height;
}

}  // namespace

Size coarse_size(const Size& size, int divisor)
{
    return {.width = std::max(1, (size.width + divisor - 1) / divisor),
            .height = std::max(1, (size.height + divisor - 1) / divisor)};
}

double CoarseToFine::seconds(int divisor) const
{
    return seconds_a_pixel_ * pixels(coarse_size(size_, divisor));
}

void CoarseToFine::restart(const Size& size)
{
    constexpr int coarsest = 16;
    size_ = size;
    int divisor = 1;
    while (divisor < coarsest && seconds(divisor) > first_seconds) {
        divisor *= 2;
    }
    divisor_ = divisor;
    is_first_ = true;
}

std::optional<int> CoarseToFine::divisor() const
{
    return divisor_;
}

void CoarseToFine::done(double seconds_taken)
{
    const double measured = seconds_taken / pixels(coarse_size(size_, *divisor_));
    // Moving average with weight 1/2, as one picture may have been delayed.
    seconds_a_pixel_ += 0.5 * (measured - seconds_a_pixel_);
    is_first_ = false;
    const int next = *divisor_ / 2;
    if (next > 1 && seconds(next) <= max_seconds) {
        divisor_ = next;
    } else {
        divisor_.reset();
    }
}

LiveRender::LiveRender(RenderArguments arguments, const PreparedScene& stage)
    : arguments_(adds_ground(arguments, stage) ? with_screen_aov(std::move(arguments), Aov::shadow)
                                               : std::move(arguments)),
      renderer_(stage.scene, stage.camera, arguments_.options),
      noise_(std::numeric_limits<double>::infinity())
{
    if (meters_light(arguments_, stage)) {
        arguments_.light_exposure = metered_exposure(stage, arguments_);
    }
}

bool LiveRender::is_done() const
{
    return renderer_.samples() >= arguments_.samples.end ||
           (arguments_.goal.noise && noise_ <= *arguments_.goal.noise);
}

bool LiveRender::advance(const PassStops& stops)
{
    constexpr double longest = 0.5;  // [s]
    const std::int64_t unit = arguments_.options.sampling.rates ? SampleRates::group : 1;
    const std::int64_t before = renderer_.samples();
    std::int64_t count = std::max(before, unit);  // twice as many as there are
    if (seconds_a_sample_ > 0.0) {
        count = std::min(count, static_cast<std::int64_t>(longest / seconds_a_sample_));
    }
    count = std::min(std::max(count, unit) / unit * unit, arguments_.samples.end - before);
    const double seconds = renderer_.seconds();
    RenderControl control;
    control.stop = stops.soon;
    control.abandon = stops.now;
    control.noise_goal = arguments_.goal.noise.value_or(0.0);
    renderer_.render(count, control);
    if (stops.now.stop_requested()) {
        return false;
    }
    const std::int64_t rendered = renderer_.samples() - before;
    if (rendered > 0) {
        seconds_a_sample_ = (renderer_.seconds() - seconds) / static_cast<double>(rendered);
    }
    // Measuring noise takes as long as a sample, so it is done as rarely as in renders.
    const std::int64_t there = renderer_.samples();
    if (there < next_noise_look(0) || is_noise_look(there) || there >= arguments_.samples.end) {
        noise_ = renderer_.noise();
    }
    return true;
}

RenderArguments with_guides(RenderArguments arguments, const PreparedScene& stage)
{
    io::MemoryBudget memory = stage.memory;  // a copy: renders of the view replace each other
    if (const std::optional<std::vector<Aov>> guides = spend_guides(memory, arguments)) {
        for (const Aov guide : *guides) {
            arguments = with_screen_aov(std::move(arguments), guide);
        }
    }
    return arguments;
}

Matte shown_matte(const RenderArguments& arguments, const RenderResult& part)
{
    return arguments.display.backdrop ? find_matte(part.aovs.develop(part.film)) : Matte{};
}

Image shown_image(const RenderArguments& arguments, const RenderResult& part)
{
    const bool has_shadow =
        !arguments.display.backdrop && arguments.options.film.aovs.contains(Aov::shadow);
    return has_shadow ? with_shadow(part.image(), find_matte(part.aovs.develop(part.film)).shadow)
                      : part.image();
}

std::optional<CoarsePicture> coarse_picture(const RenderArguments& arguments,
                                            const PreparedScene& stage, const Size& size,
                                            const std::stop_token& now)
{
    RenderOptions options = arguments.options;
    options.integrator = IntegratorKind::mis;
    options.bidirectional = {};
    options.film.width = size.width;
    options.film.height = size.height;
    options.film.crop.reset();
    options.film.aovs = {};
    if (arguments.display.backdrop) {
        options.film.aovs = {Aov::alpha};
    }
    options.sampling.rates.reset();
    if (options.sampling.environment == EnvironmentSampling::learned) {
        // A pilot would take as long as the picture.
        options.sampling.environment = EnvironmentSampling::compensated;
    }
    options.sampling.samples = {.begin = 0, .end = 1};
    RenderControl control;
    control.abandon = now;
    const RenderResult result = render(stage.scene, stage.camera, options, control);
    if (now.stop_requested()) {
        return std::nullopt;
    }
    CoarsePicture picture{.image = result.image()};
    if (arguments.display.backdrop) {
        picture.matte = find_matte(result.aovs.develop(result.film));
    }
    return picture;
}

namespace {

io::ImageMetadata metadata(const LiveRender& render, const PreparedScene& stage)
{
    nlohmann::ordered_json settings = make_settings(render.arguments(), stage);
    return completed(make_metadata(render.arguments(), stage, settings),
                     render.renderer().samples(), render.renderer().seconds());
}

}  // namespace

Download saved_image(const LiveRender& render, const PreparedScene& stage,
                     std::string_view extension)
{
    const TemporaryFolder folder;
    const RenderArguments& arguments = render.arguments();
    const std::string name = fmt::format("{}{}", arguments.file.stem().string(), extension);
    const std::array files{folder.file(fmt::format("image{}", extension))};
    const std::optional<io::Denoiser> denoiser =
        open_denoiser(arguments.denoise, files, arguments.options.system.threads);
    ImageFileOptions options =
        image_file_options(render.renderer().result(), metadata(render, stage), arguments.exr,
                           arguments.display, denoiser ? &*denoiser : nullptr, arguments.denoise);
    options.screen_aovs = arguments.screen_aovs;
    Attempts attempts;
    static_cast<void>(
        write_image_files(files, render.renderer().image(), std::move(options), attempts));
    attempts.finish();
    std::ifstream file(files.front(), std::ios::binary);
    return {.type = extension == ".png" ? "image/png" : "image/x-exr",
            .name = name,
            .content = {std::istreambuf_iterator<char>(file), {}}};
}

float compute_exposure(const LiveRender& render, const PreparedScene& stage, const Image& image)
{
    return shown_exposure(render.arguments().display.exposure, metadata(render, stage), image);
}

}  // namespace bdpt::view
