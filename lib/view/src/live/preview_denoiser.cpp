#include "live/preview_denoiser.h"

#include <bdpt/error.h>
#include <bdpt/thread_limit.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

namespace bdpt::view {

PreviewDenoiser::PreviewDenoiser(io::Denoiser denoiser, Done done)
    : denoiser_(std::move(denoiser)),
      done_(std::move(done)),
      thread_([this](const std::stop_token& finished) { run(finished); })
{}

PreviewDenoiser::~PreviewDenoiser()
{
    stop_.request_stop();
    thread_.request_stop();
    wake_.notify_all();
}

void PreviewDenoiser::start(const LiveRender& render, std::size_t slot)
{
    cancel();
    stop_ = {};
    is_busy_ = true;
    const RenderArguments& arguments = render.arguments();
    const RenderResult& part = render.renderer().result();
    Task task{.picture = std::make_shared<DenoisedPicture>(),
              .noisy = shown_image(arguments, part),
              .matte = {},
              .options = image_file_options(part, {}, arguments.exr, arguments.display, &denoiser_,
                                            arguments.denoise)};
    task.picture->slot = slot;
    task.picture->samples = render.renderer().samples();
    task.picture->stop = stop_.get_token();
    task.matte = find_matte(task.options.layers);
    task.options.denoising = Denoising::automatic;  // a failure is no error
    task.options.denoise_control = {.mode = io::DenoiserMode::preview, .stop = stop_.get_token()};
    const std::lock_guard lock(mutex_);
    task_ = std::move(task);
    wake_.notify_all();
}

void PreviewDenoiser::cancel()
{
    stop_.request_stop();
    is_busy_ = false;
}

void PreviewDenoiser::run(const std::stop_token& finished)
{
    std::unique_lock lock(mutex_);
    while (wake_.wait(lock, finished, [this] { return task_.has_value(); })) {
        const Task task = std::move(*task_);
        task_.reset();
        lock.unlock();
        if (!task.picture->stop.stop_requested()) {
            task.picture->clean = cleaned(task.noisy, task.matte, task.options);
            done_(task.picture);
        }
        lock.lock();
    }
}

std::unique_ptr<PreviewDenoiser> open_preview_denoiser(const RenderArguments& arguments,
                                                       PreviewDenoiser::Done done)
{
    DenoiseArguments asked = arguments.denoise;
    const int threads = limit_threads(arguments.options.system.threads).allowed;
    std::optional<io::Denoiser> denoiser = open_denoiser(
        asked, std::array{std::filesystem::path("view.png")}, std::max(threads / 2, 1));
    return denoiser ? std::make_unique<PreviewDenoiser>(std::move(*denoiser), std::move(done))
                    : nullptr;
}

}  // namespace bdpt::view
