// Output to pages.

#include <bdpt/io/display.h>
#include <bdpt/options/integrators.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/thin_lens.h>
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "live/frame.h"
#include "messages/text.h"
#include "output/render_report.h"
#include "output/values.h"
#include "session/session.h"
#include "stage/prepared_scene.h"

namespace bdpt::view {
namespace {

using nlohmann::ordered_json;

/// Maximum path length [edges] of strategies that are shown separately.
constexpr int strategy_edges = 4;

ordered_json scale_json(const Scale& scale)
{
    ordered_json ticks = ordered_json::array();
    for (const Tick& tick : scale.ticks) {
        ticks.push_back(ordered_json::array({tick.place, tick.text}));
    }
    return {{"label", scale.label}, {"ticks", std::move(ticks)}};
}

ordered_json text_or_null(const std::string& text)
{
    return text.empty() ? ordered_json() : ordered_json(text);
}

/// Returns the f-number of a camera that has a lens (bdpt/thin_lens.h); else null.
ordered_json f_stop_json(const CameraDesc& camera)
{
    const auto radius = static_cast<double>(camera.lens_radius);
    return radius > 0.0
               ? ordered_json(compute_lens_radius(1.0, static_cast<double>(camera.vertical_fov)) /
                              radius)
               : ordered_json();
}

/// Returns values of an option that chooses among `names`, with texts for people.
ordered_json choices_json(const std::vector<std::string>& names, std::string_view what)
{
    ordered_json choices = ordered_json::array();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool is_unique =
            !names[i].empty() && std::count(names.begin(), names.end(), names[i]) == 1;
        choices.push_back({is_unique ? names[i] : std::to_string(i),
                           is_unique ? names[i] : fmt::format("{} {}", what, i)});
    }
    return choices;
}

/// Adds what the file has to choose from, and what is chosen.
void add_choices(ordered_json& state, const ViewWords& words, const PreparedScene& stage)
{
    const std::string camera = words.text("--camera");
    std::vector<std::string> cameras;
    for (const CameraDesc& one : stage.cameras) {
        cameras.push_back(one.name);
    }
    state["cameras"] = choices_json(cameras, "camera");
    state["camera"]["choice"] = stage.is_framed  ? ordered_json("auto")
                                : camera.empty() ? state["cameras"][0][0]
                                                 : ordered_json(camera);
    state["variants"] = choices_json(stage.facts.variant_names, "variant");
    state["variant"] = text_or_null(words.text("--variant"));
    state["animations"] = choices_json(stage.facts.animation_names, "animation");
    state["animation"] = text_or_null(words.text("--animation"));
    state["animation_ends"] = stage.facts.animation_ends;
    const std::optional<double> time = words.arguments().scene.time;
    state["time"] = time ? ordered_json(*time) : ordered_json();
}

std::string to_line(const ordered_json& message)
{
    return message.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// Returns the strategies with a vertex on the lens, for paths of up to `edges`.
std::vector<Strategy> strategies_up_to(int edges)
{
    std::vector<Strategy> result;
    for (int length = 1; length <= edges; ++length) {
        for (int s = 0; s <= length; ++s) {
            result.push_back({.s = s, .t = length + 1 - s});
        }
    }
    return result;
}

}  // namespace

void Clients::tell(bool now, const std::function<ordered_json()>& state)
{
    constexpr std::chrono::milliseconds interval{100};
    const auto time = std::chrono::steady_clock::now();
    is_untold_ = !now && time - told_ < interval;
    if (!is_untold_) {
        told_ = time;
        audience_.tell(to_line({{"state", state()}}));
    }
}

void Clients::show(std::shared_ptr<Frame> frame)
{
    frame->sequences = handled_;
    audience_.show(std::move(frame));
}

void Clients::handle(ClientId client, std::uint32_t sequence)
{
    if (const auto found = handled_.find(client); found != handled_.end()) {
        found->second = std::max(found->second, sequence);
    }
}

void Clients::answer(ClientId client, const ordered_json& reply)
{
    audience_.answer(client, to_line(reply));
}

std::vector<Strategy> Session::known_strategies() const
{
    return strategies_ ? strategies_->renderer().result().strategies.strategies()
                       : strategies_up_to(std::min(strategy_edges,
                                                   scene_.arguments().options.transport.max_depth));
}

void Session::begin_strategies()
{
    constexpr std::uint64_t max_bytes = std::uint64_t{256} << 20U;
    constexpr std::int64_t samples = 64;
    RenderArguments arguments = words_of_slot(0).arguments();
    RenderOptions& options = arguments.options;
    options.integrator = IntegratorKind::bdpt;
    options.bidirectional.strategy_depth = std::min(strategy_edges, options.transport.max_depth);
    options.sampling.rates.reset();
    options.sampling.samples = {.begin = 0, .end = samples};
    options.film.aovs = {};
    options.film.crop.reset();
    arguments.samples = options.sampling.samples;
    arguments.goal.noise.reset();
    for (int divisor = 1;; divisor *= 2) {
        const Size size = coarse_size(scene_.stage().size, divisor);
        options.film.width = size.width;
        options.film.height = size.height;
        if (size.width * size.height == 1 ||
            strategy_image_bytes(options, scene_.stage().camera) <= max_bytes) {
            break;
        }
    }
    strategies_.emplace(std::move(arguments), scene_.stage());
    const std::vector<Strategy>& there = strategies_->renderer().result().strategies.strategies();
    if (!is_among(there, strategy_) && !there.empty()) {
        strategy_ = there.front();
    }
}

void Session::show(std::size_t slot)
{
    if (layer_ == ViewLayer::strategy) {
        if (slot != 0 || !strategies_ || strategies_->renderer().samples() == 0) {
            return;
        }
        const RenderResult& part = strategies_->renderer().result();
        if (is_among(part.strategies.strategies(), strategy_)) {
            const PixelRect& region = part.film.region();
            send(0, part.strategies.weighted(strategy_), {},
                 {.width = region.width(), .height = region.height()}, region,
                 part.samples.count());
        }
        return;
    }
    const std::optional<LiveRender>& render = renders_[slot];
    if (!render || render->renderer().samples() == 0) {
        return;
    }
    const Film& film = render->renderer().result().film;
    const Size grid = scene_.stage().size;
    const std::int64_t samples = render->renderer().samples();
    if (layer_ == ViewLayer::noise) {
        send(slot, noise_image(film), {}, grid, film.region(), samples);
    } else if (layer_ == ViewLayer::rates) {
        if (const auto& rates = render->renderer().options().sampling.rates) {
            send(slot, rates_image(*rates, film.region()), {}, grid, film.region(), samples);
        }
    } else {
        const Image image = shown_image(render->arguments(), render->renderer().result());
        if (slot == 0) {
            meter(image, &*render);
            tell(true);
        }
        if (shows_denoised(slot)) {
            const Cleaned& clean = denoised_[slot]->clean;
            const bool is_cut_out = render->arguments().display.backdrop.has_value();
            send(slot, *clean.image,
                 is_cut_out ? Cover{.alpha = clean.matte.alpha, .shadow = clean.matte.shadow}
                            : Cover{},
                 grid, film.region(), denoised_[slot]->samples, PictureKind::denoised);
            return;
        }
        const Matte matte = shown_matte(render->arguments(), render->renderer().result());
        send(slot, image, {.alpha = matte.alpha, .shadow = matte.shadow}, grid, film.region(),
             samples);
    }
}

void Session::show_all()
{
    show(0);
    show(1);
}

bool Session::shows_denoised(std::size_t slot) const
{
    return denoises_ && denoised_[slot] && layer_ == ViewLayer::picture;
}

void Session::denoise_if_due()
{
    if (!denoiser_ || !denoises_ || layer_ != ViewLayer::picture || denoiser_->is_busy()) {
        return;
    }
    for (std::size_t slot = 0; slot < renders_.size(); ++slot) {
        const std::optional<LiveRender>& render = renders_[slot];
        if (!render || !render->arguments().options.film.aovs.contains(Aov::normal)) {
            continue;  // memory does not suffice
        }
        const std::int64_t there = render->renderer().samples();
        const std::int64_t before = denoised_[slot] ? denoised_[slot]->samples : 0;
        const bool rests = render->is_done() || is_paused_;
        if (there > before && (rests || there >= 2 * before)) {
            denoiser_->start(*render, slot);
            return;
        }
    }
}

void Session::take_denoised(std::shared_ptr<const DenoisedPicture> picture)
{
    if (picture->stop.stop_requested()) {
        return;
    }
    denoiser_->finish();
    const std::size_t slot = picture->slot;
    if (picture->clean.image) {
        denoised_.at(slot) = std::move(picture);
        show(slot);
        denoise_if_due();
    } else {
        message_ = "not denoised: " + one_line(picture->clean.failure);
        denoises_ = false;
        show_all();
    }
    tell(true);
}

void Session::send(std::size_t slot, const Image& image, const Cover& cover, const Size& grid,
                   const PixelRect& region, std::int64_t samples, PictureKind kind)
{
    auto frame = std::make_shared<Frame>();
    frame->slot = static_cast<std::uint32_t>(slot);
    frame->generation = generation_;
    frame->grid_width = static_cast<std::uint32_t>(grid.width);
    frame->grid_height = static_cast<std::uint32_t>(grid.height);
    frame->x = static_cast<std::uint32_t>(region.x0);
    frame->y = static_cast<std::uint32_t>(region.y0);
    frame->width = static_cast<std::uint32_t>(image.width);
    frame->height = static_cast<std::uint32_t>(image.height);
    frame->samples = static_cast<std::uint32_t>(
        std::min<std::int64_t>(samples, std::numeric_limits<std::uint32_t>::max()));
    frame->channels = cover.alpha.empty() ? 3 : 5;
    frame->denoised = kind == PictureKind::denoised ? 1 : 0;
    frame->pixels = half_pixels(image, cover);
    shown_samples_.at(slot) = samples;
    clients_.show(std::move(frame));
}

void Session::meter(const Image& image, const LiveRender* render)
{
    const std::optional<Exposure>& asked = scene_.arguments().display.exposure;
    if (render != nullptr && !(asked && asked->base == ExposureBase::radiance)) {
        automatic_exposure_ = compute_exposure(*render, scene_.stage(), image);
    } else {
        automatic_exposure_ = io::automatic_exposure(image);
    }
    is_metered_ = true;
}

void Session::tell(bool now)
{
    clients_.tell(now, [this] { return state(); });
}

nlohmann::ordered_json Session::state()
{
    const std::string file = edits_.words().text("file");
    ordered_json state{{"loading", !scene_.is_there() && file_message_.empty()},
                       {"file", file},
                       {"title", std::filesystem::path(file).filename().string()},
                       {"message", text_or_null(file_message_.empty() ? message_ : file_message_)}};
    if (!scene_.is_there()) {
        return state;
    }
    const PreparedScene& stage = scene_.stage();
    const RenderArguments& arguments = scene_.arguments();
    const Pose pose = edits_.pose() ? *edits_.pose() : scene_.pose();
    if (!is_stale_) {
        edits_.set_pose(pose);  // otherwise it belongs to a moving camera
    }
    const DVec3& origin = stage.scene.description().origin;
    const bool has_fov = stage.camera.projection != Projection::orthographic;
    state["size"] = {stage.size.width, stage.size.height};
    state["camera"] = {
        {"name", stage.camera.name},
        {"from", to_json(pose.from, origin)},
        {"look_at", to_json(pose.look_at, origin)},
        {"fov", has_fov ? ordered_json(degrees(stage.camera.vertical_fov)) : ordered_json()},
        {"f_stop", f_stop_json(stage.camera)}};
    add_choices(state, edits_.words(), stage);
    for (const IntegratorInfo& integrator : integrators()) {
        state["integrators"].push_back(integrator.name);
    }
    state["integrator_a"] = to_name(arguments.options.integrator);
    state["integrator_b"] = text_or_null(integrator_b_);
    std::vector<std::string> environments{"scene"};
    environments.insert(environments.end(), named_environments.begin(), named_environments.end());
    if (const std::string own = edits_.first_words().text("--env");
        !own.empty() && is_file_of_environment(own)) {
        environments.insert(environments.begin(), own);
    }
    for (const auto& [name, folder] : edits_.given()) {
        environments.push_back(name);
    }
    state["environments"] = environments;
    const std::string environment = shown_words_.with_own_names(shown_words_.text("--env"));
    state["environment"] = environment.empty() ? "scene" : environment;
    state["rotation"] = arguments.environment_change.rotation;
    state["intensity"] = static_cast<double>(arguments.environment_change.intensity);
    const std::optional<Exposure>& exposure = arguments.display.exposure;
    const bool is_automatic = !(exposure && exposure->base == ExposureBase::radiance);
    state["exposure"] = static_cast<double>(is_automatic ? automatic_exposure_ : exposure->value);
    state["exposure_auto"] = static_cast<double>(automatic_exposure_);
    state["exposure_is_auto"] = is_automatic;
    state["curve"] = io::tone_curve_name(arguments.display.curve);
    state["ground"] =
        arguments.options.film.aovs.contains(Aov::shadow) || adds_ground(arguments, stage);
    state["background"] = arguments.display.backdrop
                              ? ordered_json(backdrop_text(*arguments.display.backdrop))
                              : ordered_json();
    for (const ViewLayer layer :
         {ViewLayer::picture, ViewLayer::noise, ViewLayer::rates, ViewLayer::strategy}) {
        if (layer != ViewLayer::rates || arguments.rates) {
            state["layers"].push_back(layer_name(layer));
        }
    }
    state["layer"] = layer_name(layer_);
    state["scale"] = layer_ == ViewLayer::noise   ? scale_json(noise_scale())
                     : layer_ == ViewLayer::rates ? scale_json(rates_scale())
                                                  : ordered_json();
    state["strategies"] = ordered_json::array();
    for (const Strategy& strategy : known_strategies()) {
        state["strategies"].push_back({strategy.s, strategy.t});
    }
    state["strategy"] = {strategy_.s, strategy_.t};
    state["paused"] = is_paused_;
    state["denoise"] = denoiser_ ? ordered_json(denoises_) : ordered_json();
    state["slots"] = ordered_json::array({slot_state(0)});
    if (!integrator_b_.empty()) {
        state["slots"].push_back(slot_state(1));
    }
    for (const std::string& warning : stage.warnings) {
        state["warnings"].push_back(shown_words_.with_own_names(warning));
    }
    for (const Note& note : stage.notes) {
        state["warnings"].push_back(note.text);
    }
    const auto samples = state["slots"][0]["samples"].get<std::int64_t>();
    const ViewWords words = words_of_slot(0);
    state["command"] = words.command(samples > 0 ? samples : arguments.samples.end);
    state["final_command"] = words.final_command();
    return state;
}

nlohmann::ordered_json Session::slot_state(std::size_t slot) const
{
    const std::optional<LiveRender>& render = renders_[slot];
    ordered_json state{
        {"integrator", render      ? std::string(to_name(render->renderer().options().integrator))
                       : slot == 1 ? integrator_b_
                                   : std::string(to_name(scene_.arguments().options.integrator))},
        {"samples", render ? render->renderer().samples() : 0},
        {"target", scene_.arguments().samples.end}};
    state["noise"] = render ? noise_json(render->noise()) : ordered_json();
    state["seconds"] = render ? render->renderer().seconds() : 0.0;
    // Pages relate the state to the picture that they have.
    const bool is_shown = layer_ == ViewLayer::strategy ||
                          shown_samples_[slot] == state["samples"].get<std::int64_t>();
    state["done"] = render && render->is_done() && is_shown && !is_stale_;
    return state;
}

}  // namespace bdpt::view
