#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "live/frame.h"
#include "live/live_render.h"
#include "live/live_scene.h"
#include "live/preview_denoiser.h"
#include "messages/console.h"
#include "session/view_edits.h"
#include "state/view_state.h"

namespace bdpt::view {

/// Receiver of a session's messages, called on the render thread.
class Audience {
public:
    virtual ~Audience() = default;
    /// Sends the state to all pages, and to those that connect later.
    virtual void tell(std::string state) = 0;
    virtual void show(std::shared_ptr<const Frame> frame) = 0;
    /// Sends an answer to one page.
    virtual void answer(ClientId client, std::string text) = 0;
};

/// The pages of a session. Used on the render thread.
class Clients {
public:
    explicit Clients(Audience& audience) : audience_(audience) {}

    void join(ClientId client) { handled_.emplace(client, 0); }
    void leave(ClientId client) { handled_.erase(client); }
    [[nodiscard]] bool empty() const { return handled_.empty(); }
    /// Notes that a request is handled: pictures from now on reflect it.
    void handle(ClientId client, std::uint32_t sequence);
    void answer(ClientId client, const nlohmann::ordered_json& reply);
    void show(std::shared_ptr<Frame> frame);
    /// Sends the state, now or, if one was sent just before, when `tell` is called again.
    void tell(bool now, const std::function<nlohmann::ordered_json()>& state);
    /// Tests whether a state was not sent.
    [[nodiscard]] bool is_untold() const { return is_untold_; }

private:
    Audience& audience_;
    std::map<ClientId, std::uint32_t> handled_;  // last request of each
    std::chrono::steady_clock::time_point told_{};
    bool is_untold_ = false;
};

/// Pictures as files have them, or for pages only.
enum class PictureKind : std::uint8_t { rendered, denoised };

/// The session of `bdpt view`: one scene, one camera, rendered by one or two integrators, for all
/// pages.
class Session {
public:
    Session(const ViewWords& words, Audience& audience, Console& console);

    /// Loads the scene, then renders and answers until `stop`, on this thread. Throws `Error` if
    /// the scene cannot be loaded.
    void run();

    // Thread-safe:
    void join(ClientId client);
    void leave(ClientId client);
    /// Handles a message of a page.
    void ask(ClientId client, const std::string& message);
    /// Saves "save.png", "save.exr" or "save.json"; `done` is called on the render thread.
    void save(const std::string& name, int slot, std::function<void(Download)> done);
    /// Lights the scene by the file `name` in `folder`, which a page gave; `done` is called on the
    /// render thread with an empty file, or with the reason why it is refused.
    void take_environment(const std::string& name, std::shared_ptr<const TemporaryFolder> folder,
                          std::function<void(Download)> done);
    void stop() { mailbox_.close(); }

private:
    void answer(ClientId client, const PageRequest& request);
    /// Throws `Error` for invalid settings.
    void check(const ViewSettings& settings) const;
    void change_settings(const ViewSettings& settings);
    [[nodiscard]] std::string inspected(const PixelSample& pixel);
    [[nodiscard]] Download saved(const std::string& name, int slot);
    /// Loads the scene for the first time. Throws `Error` if it cannot be loaded, unless an open
    /// page can show why.
    void load_first();
    void load();
    /// Applies the changes requested since the last restart, and starts rendering again.
    void restart();
    /// Renders the next pass. Returns false if there is nothing to do.
    [[nodiscard]] bool step();
    [[nodiscard]] bool preview();
    [[nodiscard]] bool advance(std::optional<LiveRender>& render, std::size_t slot);
    [[nodiscard]] bool advance_pictures();
    [[nodiscard]] bool advance_strategies();
    void begin_strategies();
    [[nodiscard]] std::vector<Strategy> known_strategies() const;
    [[nodiscard]] ViewWords words_of_slot(std::size_t slot) const;
    void drop_renders();
    void drop_render(std::size_t slot);

    /// Sends the picture of the current layer of a slot.
    void show(std::size_t slot);
    void show_all();
    /// Tests whether pages see a denoised picture of the slot.
    [[nodiscard]] bool shows_denoised(std::size_t slot) const;
    /// Starts the denoiser on a picture that has twice the samples of the denoised one, or will
    /// have no more.
    void denoise_if_due();
    void take_denoised(std::shared_ptr<const DenoisedPicture> picture);
    void send(std::size_t slot, const Image& image, const Cover& cover, const Size& grid,
              const PixelRect& region, std::int64_t samples,
              PictureKind kind = PictureKind::rendered);
    void tell(bool now);
    /// Returns the state for pages: all but pixels. Before a scene is loaded it has no picture.
    [[nodiscard]] nlohmann::ordered_json state();
    /// Returns the state of one of the pictures side by side.
    [[nodiscard]] nlohmann::ordered_json slot_state(std::size_t slot) const;
    void meter(const Image& image, const LiveRender* render);

    Clients clients_;
    Console& console_;
    Console quiet_;  ///< for messages that would be repeated
    Mailbox mailbox_;
    ViewEdits edits_;
    ViewWords shown_words_;  ///< words of the scene as last shown
    LiveScene scene_;
    std::array<std::optional<LiveRender>, 2> renders_;
    std::optional<LiveRender> strategies_;
    std::array<std::int64_t, 2> shown_samples_{};  ///< samples of each slot in the last frame sent
    /// The last denoised pictures of `renders_`.
    std::array<std::shared_ptr<const DenoisedPicture>, 2> denoised_;
    CoarseToFine coarse_;
    std::string integrator_b_;
    ViewLayer layer_ = ViewLayer::picture;
    Strategy strategy_{.s = 1, .t = 2};
    bool is_paused_ = false;
    bool denoises_ = true;        ///< pages want denoised pictures
    bool is_stale_ = false;       ///< words have changed
    bool files_changed_ = false;  ///< on disk
    std::string message_;         ///< reason why the last change was refused
    std::string file_message_;    ///< reason why the file was not reloaded
    float automatic_exposure_ = 0.0f;
    bool is_metered_ = false;  ///< `automatic_exposure_` belongs to this scene
    std::uint32_t generation_ = 0;
    // Last: their threads use the mailbox.
    SceneWatch watch_;
    std::unique_ptr<PreviewDenoiser> denoiser_;  ///< null: pictures are not denoised
};

}  // namespace bdpt::view
