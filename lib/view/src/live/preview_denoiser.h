#pragma once

#include <bdpt/image.h>
#include <bdpt/io/denoise.h>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "live/live_render.h"
#include "output/image_files.h"

namespace bdpt::view {

/// A denoised picture for pages.
struct DenoisedPicture {
    std::size_t slot = 0;
    std::int64_t samples = 0;
    Cleaned clean{};         ///< without an image: the denoiser failed
    std::stop_token stop{};  ///< a request means that the picture is obsolete
};

/// Denoises pictures for pages, on a thread of its own, one at a time. It takes half of the
/// threads, and gives up at once what is obsolete, so that the picture follows the mouse.
class PreviewDenoiser {
public:
    using Done = std::function<void(std::shared_ptr<const DenoisedPicture>)>;

    /// `done` is called on the denoiser's thread.
    PreviewDenoiser(io::Denoiser denoiser, Done done);
    ~PreviewDenoiser();
    PreviewDenoiser(const PreviewDenoiser&) = delete;
    PreviewDenoiser& operator=(const PreviewDenoiser&) = delete;

    /// Starts to denoise the picture of `render`, which has samples and guides, for `slot`.
    void start(const LiveRender& render, std::size_t slot);
    /// Tests whether it works on a picture, from `start()` to `finish()` or `cancel()`.
    [[nodiscard]] bool is_busy() const { return is_busy_; }
    void finish() { is_busy_ = false; }
    void cancel();

private:
    struct Task {
        std::shared_ptr<DenoisedPicture> picture;
        Image noisy;
        Matte matte;
        ImageFileOptions options;
    };

    void run(const std::stop_token& finished);

    io::Denoiser denoiser_;
    Done done_;
    bool is_busy_ = false;
    std::stop_source stop_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::optional<Task> task_;  // the next one; guarded by the mutex
    std::jthread thread_;       // last: uses all of the above
};

/// Returns a denoiser for previews of what `arguments` render; null if there is no library, or if
/// their pictures are not denoised. Throws `Error` if the library that was asked for cannot be
/// opened.
[[nodiscard]] std::unique_ptr<PreviewDenoiser> open_preview_denoiser(
    const RenderArguments& arguments, PreviewDenoiser::Done done);

}  // namespace bdpt::view
