#include "session/session.h"

#include <bdpt/error.h>
#include <bdpt/inspect.h>
#include <bdpt/io/display.h>
#include <bdpt/options/option_fields.h>
#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "messages/text.h"
#include "options/groups/camera_arguments.h"
#include "output/values.h"
#include "stage/render_preparation.h"
#include "state/view_camera.h"

namespace bdpt::view {
namespace {

/// Returns a point of the world as a value of --from, in coordinates of the file.
std::string point_text(Vec3 point, const DVec3& origin)
{
    if (origin == DVec3(0.0)) {
        return fmt::format("{},{},{}", point.x, point.y, point.z);
    }
    const DVec3 place = to_file(point, origin);
    return fmt::format("{:.12g},{:.12g},{:.12g}", place.x, place.y, place.z);
}

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

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
    : audience_(audience),
      console_(console),
      first_words_(words),
      words_(words),
      shown_words_(words),
      scene_(console, [this] { drop_renders(); }),
      watch_([this] { mailbox_.post([this] { files_changed_ = true; }, Urgency::soon); })
{}

void Session::run()
{
    tell(true);
    watch_.watch({words_.text("file")});
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
        if (is_untold_) {
            tell(!busy);
        }
    }
}

void Session::load_first()
{
    try {
        scene_.load(words_);
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
    mailbox_.post([this, client] { clients_.emplace(client, 0); }, Urgency::when_idle);
}

void Session::leave(ClientId client)
{
    mailbox_.post([this, client] { clients_.erase(client); }, Urgency::soon);
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
                audience_.answer(
                    client,
                    reply.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
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

void Session::answer(ClientId client, const PageRequest& request)
{
    nlohmann::ordered_json reply{{"ack", request.sequence}};
    const ViewWords before = words_;
    const std::optional<Pose> pose_before = pose_;
    const auto wrong = catch_failure([&] {
        if (!scene_.is_there()) {
            throw Error(ErrorCode::usage, "the scene is not loaded yet");
        }
        change_camera(request);
        if (request.settings) {
            change_settings(*request.settings);
        }
        if (words_ != before) {
            static_cast<void>(words_.arguments());  // throws
        }
        if (request.inspect) {
            reply["inspect"] = nlohmann::ordered_json::parse(inspected(*request.inspect));
        }
    });
    if (wrong) {
        words_ = before;
        pose_ = pose_before;
        reply["error"] = *wrong;
    }
    is_stale_ = is_stale_ || words_ != shown_words_;
    if (const auto found = clients_.find(client); found != clients_.end()) {
        found->second = std::max(found->second, request.sequence);
    }
    if (request.changes_picture() && !is_stale_) {
        show_all();  // the page waits for a picture with its number
    }
    audience_.answer(client,
                     reply.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    tell(false);
}

void Session::change_camera(const PageRequest& request)
{
    if (request.reset) {
        for (const char* option : {"--camera", "--view", "--margin", "--from", "--look-at",
                                   "--ortho", "--fov", "--focal-length", "--focus-distance"}) {
            words_.remove(option);
            if (first_words_.has(option)) {
                words_.set(option, first_words_.text(option));
            }
        }
        pose_.reset();
    }
    if (!request.move && !request.focus) {
        return;
    }
    if (is_stale_ && (request.focus || !pose_)) {
        restart();  // pixels refer to the current picture
    }
    const RenderArguments& arguments = scene_.arguments();
    if (arguments.view.projection == Projection::orthographic) {
        throw Error(ErrorCode::usage, "--ortho frames the whole scene; its camera cannot be moved");
    }
    const CameraDesc& camera = scene_.stage().camera;
    Pose pose = pose_ ? *pose_ : scene_.pose();
    if (request.focus) {
        const auto [x, y] = *request.focus;
        const std::optional<Vec3> target = scene_.picked(x, y);
        if (!target) {
            throw Error(ErrorCode::usage, "there is no surface here");
        }
        pose.look_at = *target;
        if (words_.has("--focus-distance")) {
            words_.set("--focus-distance", fmt::format("{}", glm::length(*target - pose.from)));
        }
    }
    if (request.move) {
        pose =
            moved(pose, *request.move, view_height(camera, glm::length(pose.look_at - pose.from)));
    }
    if (arguments.view.frames()) {
        // Options that frame the scene exclude a camera position.
        words_.remove("--view");
        words_.remove("--margin");
        words_.set("--camera", "auto");
    }
    const bool is_framed = arguments.view.frames() || scene_.stage().is_framed;
    if (is_framed && !words_.has("--fov") && !words_.has("--focal-length")) {
        // With a field of view the view is complete, so the scene need not be framed.
        words_.set("--fov", fmt::format("{}", degrees(camera.vertical_fov)));
    }
    const DVec3& origin = scene_.stage().scene.description().origin;
    words_.set("--from", point_text(pose.from, origin));
    words_.set("--look-at", point_text(pose.look_at, origin));
    pose_ = pose;
}

void Session::check(const ViewSettings& settings) const
{
    if (settings.integrator_b && !settings.integrator_b->empty()) {
        ViewWords words = words_;
        words.set("--integrator", *settings.integrator_b);
        static_cast<void>(words.arguments());  // throws
    }
    if (settings.layer == ViewLayer::rates && !scene_.arguments().rates) {
        throw Error(ErrorCode::usage, "\"layer\": rates of samples need --adaptive or --rates");
    }
    const std::vector<Strategy> there = known_strategies();
    if (settings.strategy &&
        std::find(there.begin(), there.end(), *settings.strategy) == there.end()) {
        throw Error(ErrorCode::usage,
                    fmt::format("\"strategy\": there is no image of s = {}, t = {}",
                                settings.strategy->s, settings.strategy->t));
    }
}

void Session::change_settings(const ViewSettings& settings)
{
    check(settings);
    if (settings.integrator_a) {
        words_.set("--integrator", *settings.integrator_a);
    }
    if (settings.environment) {
        set_environment(*settings.environment);
    }
    if (settings.rotation) {
        words_.set("--env-rotation", fmt::format("{}", *settings.rotation));
    }
    if (settings.intensity) {
        words_.set("--env-intensity", fmt::format("{}", *settings.intensity));
    }
    if (settings.exposure) {
        words_.set("--exposure", *settings.exposure);
        if (*settings.exposure == "auto") {
            const std::optional<Exposure> first = first_words_.arguments().display.exposure;
            if (!first_words_.has("--exposure")) {
                words_.remove("--exposure");
            } else if (first && first->base != ExposureBase::radiance) {
                words_.set("--exposure", first_words_.text("--exposure"));
            }
        }
    }
    if (settings.curve) {
        words_.set("--tone-map", *settings.curve);
    }
    static_cast<void>(words_.arguments());  // throws, before anything else is changed
    if (settings.integrator_b && *settings.integrator_b != integrator_b_) {
        renders_[1].reset();
        integrator_b_ = *settings.integrator_b;
    }
    if (settings.paused) {
        is_paused_ = *settings.paused;
    }
    const bool changes_layer = (settings.layer && *settings.layer != layer_) ||
                               (settings.strategy && *settings.strategy != strategy_);
    layer_ = settings.layer.value_or(layer_);
    strategy_ = settings.strategy.value_or(strategy_);
    if (changes_layer) {
        tell(true);
        show_all();
    }
}

void Session::set_environment(const std::string& name)
{
    if (name == "scene") {
        words_.remove("--env");
    } else if (name == "none" || name == "default" || name == "studio" ||
               name == first_words_.text("--env")) {
        words_.set("--env", name);  // no other file: pages must not choose files to read
    } else {
        throw Error(ErrorCode::usage, fmt::format("\"environment\": there is none \"{}\"", name));
    }
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
    if (const auto wrong = catch_failure([&] { scene_.load(words_); })) {
        file_message_ = *wrong;
        console_.warning(*wrong, Repeat::always);
    } else {
        file_message_.clear();
        message_.clear();
        watch_.watch(scene_.files());
        console_.note(fmt::format("{}: loaded again", words_.text("file")));
        shown_words_ = words_;
        is_stale_ = false;
        pose_.reset();
        is_metered_ = false;
        coarse_.restart(scene_.stage().size);
        ++generation_;
    }
    tell(true);
}

void Session::restart()
{
    is_stale_ = false;
    const ViewWords before = std::exchange(shown_words_, words_);
    const bool look_only = [&] {  // options that change no pixel
        ViewWords a = before;
        ViewWords b = words_;
        for (const char* option : {"--exposure", "--tone-map"}) {
            a.remove(option);
            b.remove(option);
        }
        const PreparedScene& stage = scene_.stage();
        return a == b &&
               meters_light(before.arguments(), stage) == meters_light(words_.arguments(), stage);
    }();
    if (look_only) {
        for (std::optional<LiveRender>& render : renders_) {
            if (render) {
                render->set_display(words_.arguments().display);
            }
        }
        if (renders_[0] && renders_[0]->renderer().samples() > 0) {
            meter(shown_image(renders_[0]->arguments(), renders_[0]->renderer().result()),
                  &*renders_[0]);
        }
        scene_.show(words_);
        tell(false);
        return;
    }
    drop_renders();
    if (const auto wrong = catch_failure([&] { scene_.show(words_); })) {
        message_ = *wrong;
        words_ = before;
        shown_words_ = before;
        pose_.reset();
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
    for (std::optional<LiveRender>& render : renders_) {
        render.reset();
    }
    strategies_.reset();
    shown_samples_ = {};
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
        RenderArguments arguments =
            with_choice(words_of_slot(slot).arguments(), scene_.stage(), quiet_, stops.now);
        if (stops.now.stop_requested()) {
            return true;
        }
        render.emplace(std::move(arguments), scene_.stage());
    }
    // If stopped at once, the picture is obsolete.
    if (render->advance(stops) && !stops.now.stop_requested()) {
        show(slot);
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
