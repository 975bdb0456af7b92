#include "session/session.h"

#include <bdpt/error.h>
#include <bdpt/inspect.h>
#include <bdpt/options/option_fields.h>
#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "messages/text.h"
#include "output/values.h"
#include "stage/prepared_scene.h"
#include "state/view_state.h"

namespace bdpt::view {
namespace {

/// Calls `work()`; returns its failure as a line.
template <typename Work>
std::optional<std::string> catch_failure(const Work& work)
{
    try {
        work();
        return std::nullopt;
    } catch (const Error& error) {
        return one_line(error.what());
    } catch (const std::bad_alloc&) {
        return "out of memory";
    }
}

}  // namespace

Session::Session(const ViewWords& words, Audience& audience, Console& console)
    : clients_(audience),
      console_(console),
      edits_(words),
      shown_words_(words),
      scene_(console, [this] { drop_renders(); }),
      watch_([this] { mailbox_.post([this] { files_changed_ = true; }, Urgency::soon); }),
      denoiser_(open_preview_denoiser(
          words.arguments(), [this](std::shared_ptr<const DenoisedPicture> picture) {
              mailbox_.post([this, picture] { take_denoised(picture); }, Urgency::soon);
          }))
{}

void Session::run()
{
    tell(true);
    watch_.watch({edits_.words().text("file")});
    load_first();
    tell(true);
    bool busy = true;
    while (mailbox_.work_off(!busy)) {
        if (!clients_.empty() && files_changed_) {
            load();
        }
        if (is_stale_) {
            restart();
        }
        busy = step();
        if (clients_.is_untold()) {
            tell(!busy);
        }
    }
}

void Session::load_first()
{
    try {
        scene_.load(edits_.words());
    } catch (const Error& error) {
        static_cast<void>(mailbox_.work_off(false));  // handles pages that were opened meanwhile
        if (clients_.empty()) {
            throw;
        }
        file_message_ = one_line(error.what());
        console_.warning(file_message_, Repeat::always);
        return;
    }
    watch_.watch(scene_.files());
    coarse_.restart(scene_.stage().size);
    ++generation_;
    for (const Note& note : scene_.stage().notes) {
        console_.note(note);
    }
    for (const std::string& warning : scene_.stage().warnings) {
        console_.warning(warning);
    }
}

void Session::join(ClientId client)
{
    mailbox_.post([this, client] { clients_.join(client); }, Urgency::when_idle);
}

void Session::leave(ClientId client)
{
    mailbox_.post([this, client] { clients_.leave(client); }, Urgency::soon);
}

void Session::ask(ClientId client, const std::string& message)
{
    PageRequest request;
    std::optional<std::string> wrong = catch_failure([&] { request = parse_request(message); });
    // A focus point may be refused, so the current picture is kept.
    const bool gives_up = request.changes_picture() && !request.focus;
    const Urgency urgency = gives_up ? Urgency::now : Urgency::soon;
    mailbox_.post(
        [this, client, request, wrong, sequence = wrong ? parse_sequence(message) : std::nullopt] {
            if (wrong) {
                nlohmann::ordered_json reply{{"error", *wrong}};
                if (sequence) {
                    reply["ack"] = *sequence;
                }
                clients_.answer(client, reply);
            } else {
                answer(client, request);
            }
        },
        wrong ? Urgency::when_idle : urgency);
}

void Session::save(const std::string& name, int slot, std::function<void(Download)> done)
{
    mailbox_.post(
        [this, name, slot, done = std::move(done)] {
            Download file;
            if (const auto wrong = catch_failure([&] { file = saved(name, slot); })) {
                file = {.status = 500, .type = "text/plain", .name = "", .content = *wrong};
            }
            done(std::move(file));
        },
        Urgency::soon);
}

void Session::take_environment(const std::string& name,
                               std::shared_ptr<const TemporaryFolder> folder,
                               std::function<void(Download)> done)
{
    mailbox_.post(
        [this, name, folder = std::move(folder), done = std::move(done)] {
            Download answer{.type = "text/plain", .name = "", .content = ""};
            if (!scene_.is_there()) {
                answer.content = "the scene is not loaded yet";
            } else {
                edits_.choose_given(name, folder->file(name));
                restart();
                answer.content = message_;
            }
            if (answer.content.empty()) {
                edits_.keep_given(name, folder);
            } else {
                answer.status = 400;
            }
            done(std::move(answer));
        },
        Urgency::now);
}

void Session::answer(ClientId client, const PageRequest& request)
{
    nlohmann::ordered_json reply{{"ack", request.sequence}};
    const ViewEdits before = edits_;
    const auto wrong = catch_failure([&] {
        if (!scene_.is_there()) {
            throw Error(ErrorCode::usage, "the scene is not loaded yet");
        }
        if (request.reset) {
            edits_.reset_camera();
        }
        if (request.move || request.focus) {
            if (is_stale_ && (request.focus || !edits_.pose())) {
                restart();  // pixels refer to the current picture
            }
            edits_.move_camera(request, scene_);
        }
        if (request.settings) {
            change_settings(*request.settings);
        }
        if (edits_.words() != before.words()) {
            static_cast<void>(edits_.words().arguments());  // throws
        }
        if (request.inspect) {
            reply["inspect"] = nlohmann::ordered_json::parse(inspected(*request.inspect));
        }
    });
    if (wrong) {
        edits_ = before;
        reply["error"] = *wrong;
    }
    is_stale_ = is_stale_ || edits_.words() != shown_words_;
    clients_.handle(client, request.sequence);
    if (request.changes_picture() && !is_stale_) {
        show_all();  // the page waits for a picture with its number
    }
    clients_.answer(client, reply);
    tell(false);
}

void Session::check(const ViewSettings& settings) const
{
    if (settings.integrator_b && !settings.integrator_b->empty()) {
        ViewWords words = edits_.words();
        words.set("--integrator", *settings.integrator_b);
        static_cast<void>(words.arguments());  // throws
    }
    if (settings.denoises.value_or(false) && !denoiser_) {
        throw Error(ErrorCode::usage, "\"denoise\": there is no Open Image Denoise");
    }
    if (settings.layer == ViewLayer::rates && !scene_.arguments().rates) {
        throw Error(ErrorCode::usage, "\"layer\": rates of samples need --adaptive or --rates");
    }
    const std::vector<Strategy> there = known_strategies();
    if (settings.strategy && !is_among(there, *settings.strategy)) {
        throw Error(ErrorCode::usage,
                    fmt::format("\"strategy\": there is no image of s = {}, t = {}",
                                settings.strategy->s, settings.strategy->t));
    }
}

void Session::change_settings(const ViewSettings& settings)
{
    check(settings);
    edits_.change(settings.options, scene_);
    static_cast<void>(edits_.words().arguments());  // throws, before anything else is changed
    if (settings.integrator_b && *settings.integrator_b != integrator_b_) {
        drop_render(1);
        integrator_b_ = *settings.integrator_b;
    }
    if (settings.paused) {
        is_paused_ = *settings.paused;
    }
    const bool changes_layer = (settings.layer && *settings.layer != layer_) ||
                               (settings.strategy && *settings.strategy != strategy_) ||
                               (settings.denoises && *settings.denoises != denoises_);
    denoises_ = settings.denoises.value_or(denoises_);
    layer_ = settings.layer.value_or(layer_);
    strategy_ = settings.strategy.value_or(strategy_);
    if (changes_layer) {
        tell(true);
        show_all();
    }
    denoise_if_due();
}

std::string Session::inspected(const PixelSample& pixel)
{
    if (is_stale_) {
        restart();
    }
    const RenderArguments& arguments = renders_[0] ? renders_[0]->arguments() : scene_.arguments();
    return inspected_text(scene_.stage(), arguments.options, pixel);
}

Download Session::saved(const std::string& name, int slot)
{
    const auto place = static_cast<std::size_t>(slot);
    const bool is_there = place < renders_.size() && renders_[place] &&
                          renders_[place]->renderer().samples() > 0 && !is_stale_;
    if (name == "save.json") {
        return {.type = "application/json",
                .name = fmt::format("{}.json", scene_.arguments().file.stem().string()),
                .content = words_of_slot(place).final_job()};
    }
    if (!is_there) {
        return {.status = 503,
                .type = "text/plain",
                .name = "",
                .content = "there is no sample yet: try again"};
    }
    return saved_image(*renders_[place], scene_.stage(), name == "save.png" ? ".png" : ".exr");
}

void Session::load()
{
    files_changed_ = false;
    if (const auto wrong = catch_failure([&] { scene_.load(edits_.words()); })) {
        file_message_ = *wrong;
        console_.warning(*wrong, Repeat::always);
    } else {
        file_message_.clear();
        message_.clear();
        watch_.watch(scene_.files());
        console_.note(fmt::format("{}: loaded again", edits_.words().text("file")));
        shown_words_ = edits_.words();
        is_stale_ = false;
        edits_.set_pose(std::nullopt);
        is_metered_ = false;
        coarse_.restart(scene_.stage().size);
        ++generation_;
    }
    tell(true);
}

void Session::restart()
{
    is_stale_ = false;
    const ViewWords before = std::exchange(shown_words_, edits_.words());
    const bool look_only = [&] {  // options that change no pixel
        ViewWords a = before;
        ViewWords b = edits_.words();
        for (const char* option : {"--exposure", "--tone-map"}) {
            a.remove(option);
            b.remove(option);
        }
        const PreparedScene& stage = scene_.stage();
        return a == b && meters_light(before.arguments(), stage) ==
                             meters_light(edits_.words().arguments(), stage);
    }();
    if (look_only) {
        for (std::optional<LiveRender>& render : renders_) {
            if (render) {
                render->set_display(edits_.words().arguments().display);
            }
        }
        if (renders_[0] && renders_[0]->renderer().samples() > 0) {
            meter(shown_image(renders_[0]->arguments(), renders_[0]->renderer().result()),
                  &*renders_[0]);
        }
        scene_.show(edits_.words());
        tell(false);
        return;
    }
    drop_renders();
    if (const auto wrong = catch_failure([&] { scene_.show(edits_.words()); })) {
        message_ = edits_.words().with_own_names(*wrong);
        edits_.give_up(before);
        shown_words_ = before;
    } else {
        message_.clear();
        watch_.watch(scene_.files());
    }
    ++generation_;
    if (scene_.is_there()) {
        coarse_.restart(scene_.stage().size);
    }
    tell(false);
}

void Session::drop_renders()
{
    drop_render(0);
    drop_render(1);
    strategies_.reset();
    shown_samples_ = {};
}

void Session::drop_render(std::size_t slot)
{
    if (denoiser_) {
        denoiser_->cancel();
    }
    denoised_.at(slot).reset();
    renders_.at(slot).reset();
}

bool Session::step()
{
    if (!scene_.is_there()) {
        return false;
    }
    // The first picture is rendered even before a page connects.
    const bool shown_before = renders_[0] && renders_[0]->renderer().samples() > 0;
    if ((clients_.empty() && shown_before) || (is_paused_ && shown_before)) {
        return false;
    }
    bool busy = false;
    const auto wrong = catch_failure([&] {
        if (coarse_.divisor() && layer_ == ViewLayer::picture) {
            busy = preview();
        } else {
            busy = (layer_ == ViewLayer::strategy && advance_strategies()) || advance_pictures();
        }
    });
    if (wrong) {
        message_ = *wrong;
        drop_renders();
        is_paused_ = true;  // otherwise it would fail again and again
        tell(true);
        return false;
    }
    return busy;
}

bool Session::preview()
{
    const Size size = coarse_size(scene_.stage().size, *coarse_.divisor());
    const PassStops stops = mailbox_.begin_pass(!coarse_.is_first());
    const auto start = std::chrono::steady_clock::now();
    const std::optional<CoarsePicture> picture =
        coarse_picture(scene_.arguments(), scene_.stage(), size, stops.now);
    if (!picture) {
        coarse_.skip();  // a restart follows
        return true;
    }
    coarse_.done(seconds_since(start));
    if (!is_metered_) {
        meter(picture->image, nullptr);
    }
    tell(generation_ == 1);
    const PixelRect whole{.x0 = 0, .y0 = 0, .x1 = size.width, .y1 = size.height};
    for (std::size_t slot = 0; slot < (integrator_b_.empty() ? 1U : 2U); ++slot) {
        send(slot, picture->image, {.alpha = picture->matte.alpha}, size, whole, 1);
    }
    return true;
}

bool Session::advance(std::optional<LiveRender>& render, std::size_t slot)
{
    const PassStops stops = mailbox_.begin_pass(true);
    if (stops.now.stop_requested()) {
        return true;
    }
    if (!render) {
        // A continuing motion would have to wait for a pass that starts now.
        constexpr std::chrono::milliseconds rest{150};
        if (generation_ > 1 && mailbox_.wait_for(rest)) {
            return true;
        }
        RenderArguments asked = words_of_slot(slot).arguments();
        if (denoiser_) {
            asked = with_guides(std::move(asked), scene_.stage());
        }
        RenderArguments arguments =
            with_choice(std::move(asked), scene_.stage(), quiet_, stops.now);
        if (stops.now.stop_requested()) {
            return true;
        }
        render.emplace(std::move(arguments), scene_.stage());
    }
    // If stopped at once, the picture is obsolete.
    if (render->advance(stops) && !stops.now.stop_requested()) {
        if (!shows_denoised(slot)) {  // between denoised pictures a noisy one would flicker
            show(slot);
        }
        denoise_if_due();
        tell(true);
    }
    return true;
}

bool Session::advance_pictures()
{
    std::size_t slot = 0;
    if (!integrator_b_.empty() && renders_[0]) {
        // Advances the slot with less render time, or the one that is not done.
        const bool b_is_behind =
            !renders_[1] || renders_[0]->is_done() ||
            renders_[1]->renderer().seconds() < renders_[0]->renderer().seconds();
        slot = b_is_behind && !(renders_[1] && renders_[1]->is_done()) ? 1 : 0;
    }
    if (renders_[slot] && renders_[slot]->is_done()) {
        return false;
    }
    return advance(renders_[slot], slot);
}

bool Session::advance_strategies()
{
    if (!strategies_) {
        const auto wrong = catch_failure([&] { begin_strategies(); });
        if (wrong) {
            message_ = *wrong;
            layer_ = ViewLayer::picture;
            tell(true);
            show_all();
            return false;
        }
        tell(true);
    }
    return !strategies_->is_done() && advance(strategies_, 0);
}

ViewWords Session::words_of_slot(std::size_t slot) const
{
    ViewWords words = shown_words_;
    if (slot == 1 && !integrator_b_.empty()) {
        words.set("--integrator", integrator_b_);
    }
    return words;
}

}  // namespace bdpt::view
