#include "session/session.h"

#include <bdpt/error.h>
#include <bdpt/io/read_image.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "commands/commands.h"
#include "options/option_list.h"
#include "options/render_arguments.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::live_view_session_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Words = std::vector<std::string>;

constexpr view::ClientId me = 1;

/// Keeps what a session tells.
class Listener : public view::Audience {
public:
    void tell(std::string state) override
    {
        keep([&] { state_ = json::parse(state).at("state"); });
    }
    void show(std::shared_ptr<const view::Frame> frame) override
    {
        keep([&] { frames_.push_back(std::move(frame)); });
    }
    void answer(view::ClientId /*client*/, std::string text) override
    {
        keep([&] { answers_.push_back(json::parse(text)); });
    }

    /// Waits for a state that `is_wanted`.
    json state(const std::function<bool(const json&)>& is_wanted)
    {
        std::unique_lock lock(mutex_);
        if (!news_.wait_for(lock, patience,
                            [&] { return !state_.is_null() && is_wanted(state_); })) {
            throw std::runtime_error("no such state; the last is " + state_.dump());
        }
        return state_;
    }
    json answer_to(int sequence)
    {
        std::unique_lock lock(mutex_);
        const json* found = nullptr;
        news_.wait_for(lock, patience, [&] {
            for (const json& answer : answers_) {
                if (answer.value("ack", 0) == sequence) {
                    found = &answer;
                }
            }
            return found != nullptr;
        });
        if (found == nullptr) {
            throw std::runtime_error("no answer to " + std::to_string(sequence));
        }
        return *found;
    }
    /// Waits until the last picture is one that `is_wanted`.
    std::shared_ptr<const view::Frame> frame(
        const std::function<bool(const view::Frame&)>& is_wanted)
    {
        std::unique_lock lock(mutex_);
        if (!news_.wait_for(lock, patience,
                            [&] { return !frames_.empty() && is_wanted(*frames_.back()); })) {
            throw std::runtime_error("no such picture; there are " +
                                     std::to_string(frames_.size()));
        }
        return frames_.back();
    }
    std::vector<std::shared_ptr<const view::Frame>> frames()
    {
        const std::lock_guard lock(mutex_);
        return frames_;
    }

private:
    static constexpr std::chrono::seconds patience{60};

    template <typename Work>
    void keep(const Work& work)
    {
        const std::lock_guard lock(mutex_);
        work();
        news_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable news_;
    json state_;
    std::vector<json> answers_;
    std::vector<std::shared_ptr<const view::Frame>> frames_;
};

/// `bdpt view` of a cube without its server.
class Viewing {
public:
    explicit Viewing(const Words& more, const std::string& cameras = two_cameras,
                     const std::function<void(const fs::path&)>& spoil = {})
    {
        write_cube(folder_, "cube", {.cameras = cameras});
        if (spoil) {
            spoil(path("cube.gltf"));
        }
        Words words{path("cube.gltf"), "--size=48x24", "--threads=2"};
        words.insert(words.end(), more.begin(), more.end());
        job::RenderOptionList options;
        job::give_words(words, options.list);
        session_.emplace(view::ViewWords(options.list), listener_, console_);
        session_->join(me);
        thread_ = std::thread([this] { session_->run(); });
    }
    ~Viewing()
    {
        session_->stop();
        thread_.join();
    }
    Viewing(const Viewing&) = delete;
    Viewing& operator=(const Viewing&) = delete;

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    Listener& listener() { return listener_; }
    /// The answer to `request`.
    json ask(json request)
    {
        request["seq"] = ++sequence_;
        session_->ask(me, request.dump());
        return listener_.answer_to(sequence_);
    }
    int sequence() const { return sequence_; }
    /// Waits until all samples of what is seen now are there.
    json finished(const Words& words_of_command = {})
    {
        return listener_.state([&](const json& state) {
            bool done = state.contains("slots");
            for (const std::string& word : words_of_command) {
                done =
                    done && state.at("command").get<std::string>().find(word) != std::string::npos;
            }
            for (const json& slot : state.value("slots", json::array())) {
                done = done && slot.at("done").get<bool>();
            }
            return done;
        });
    }
    view::Download save(const std::string& name, int slot = 0)
    {
        std::promise<view::Download> file;
        session_->save(name, slot, [&](view::Download done) { file.set_value(std::move(done)); });
        return file.get_future().get();
    }
    fs::path saved(const std::string& name, int slot = 0)
    {
        const view::Download file = save(name, slot);
        INFO(file.content.substr(0, 200));
        REQUIRE(file.status == 200);
        std::ofstream(path("of_page_" + name), std::ios::binary) << file.content;
        return path("of_page_" + name);
    }
    /// What the command that a page can copy renders.
    fs::path rendered(const json& state, const std::string& name)
    {
        std::istringstream line(state.at("command").get<std::string>());
        Words words;
        for (std::string word; line >> word;) {
            words.push_back(word);
        }
        words.erase(words.begin());
        words.insert(words.end(), {"--quiet", "-o", path(name)});
        const Outcome outcome = run(words);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return path(name);
    }

private:
    ScratchFolder folder_;
    app::TerminalConsole console_{app::Format::text, app::Verbosity::quiet};
    Listener listener_;
    std::optional<view::Session> session_;
    std::thread thread_;
    int sequence_ = 0;
};

bool same_pixels(const fs::path& a, const fs::path& b)
{
    return io::read_image(a).image.pixels == io::read_image(b).image.pixels;
}

std::string text_of(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

TEST_CASE("what is seen has the bits of the command that can be copied", "[live_view]")
{
    Viewing viewing({"--spp=6", "--env-intensity=2"});
    static_cast<void>(viewing.listener().state(
        [](const json& state) { return !state.at("loading").get<bool>(); }));
    // Another view, and another light, by words that the command understands.
    CHECK_FALSE(viewing.ask({{"move", {{"orbit", {0.4, 0.3}}, {"dolly", 1.2}}}}).contains("error"));
    CHECK_FALSE(viewing.ask({{"set", {{"rotation", 35}, {"intensity", 0.5}}}}).contains("error"));
    for (const char* integrator : {"auto", "bdpt", "vcm"}) {
        CAPTURE(integrator);
        CHECK_FALSE(viewing.ask({{"set", {{"integrator_a", integrator}, {"exposure", 0.25}}}})
                        .contains("error"));
        const json state = viewing.finished(
            {"--env-rotation=35", "--exposure=0.25", std::string("--integrator=") + integrator});
        CHECK(state.at("slots").at(0).at("samples") == 6);
        CHECK(state.at("rotation") == 35.0);
        CHECK(state.at("exposure") == 0.25);
        // The command may have other numbers of samples than the page shows, but no rates.
        CHECK(state.at("command").get<std::string>().find(" --adaptive=false") !=
              std::string::npos);
        CHECK(same_pixels(viewing.saved("save.exr"), viewing.rendered(state, "command.exr")));
        CHECK(same_pixels(viewing.saved("save.png"), viewing.rendered(state, "command.png")));
    }
    // The job renders the same, but for the shadow that only pictures have.
    CHECK(viewing.finished().at("ground") == true);
    CHECK_FALSE(viewing.ask({{"set", {{"ground", false}}}}).contains("error"));
    static_cast<void>(viewing.finished({"--ground=none"}));
    const fs::path job = viewing.saved("save.json");
    REQUIRE(run({"render", job.string(), "--quiet", "-o", viewing.path("job.exr")}).exit_code == 0);
    CHECK(same_pixels(viewing.path("job.exr"), viewing.saved("save.exr")));
    // And so does the picture in the page, as far as halves go.
    const auto frame = viewing.listener().frames().back();
    CHECK(frame->width == 48);
    CHECK(frame->samples == 6);
    CHECK(frame->pixels == view::half_pixels(io::read_image(viewing.path("job.exr")).image));
    CHECK(frame->sequences.at(me) == static_cast<std::uint32_t>(viewing.sequence()));
}

TEST_CASE("a picture is finished after the samples that the help names", "[live_view]")
{
    const app::CommandLine line;
    const job::OptionList& options = line.program.find("view")->options;
    Viewing viewing({"--size=4x4", "--integrator=pt"});
    const json samples = viewing.finished().at("slots").at(0).at("samples");
    CHECK(options.at("--spp").help.ends_with("Default: " + samples.dump()));
    CHECK(samples > 64);
}

TEST_CASE("the command and the job of the final render end as asked, not where the picture is",
          "[live_view]")
{
    const auto has = [](const json& state, const std::string& word) {
        return state.at("final_command").get<std::string>().find(word) != std::string::npos;
    };
    const auto job = [](Viewing& viewing) {
        return json::parse(text_of(viewing.saved("save.json")));
    };
    {
        Viewing viewing({"--noise=60%", "--spp=16"});
        const json state = viewing.finished();
        CHECK(has(state, "--noise=60%"));
        CHECK(has(state, "--spp=16"));
        CHECK_FALSE(has(state, "--adaptive"));
        CHECK(job(viewing).at("noise") == "60%");
    }
    Viewing viewing({"--size=4x4", "--integrator=pt"});
    const json state = viewing.finished();
    CHECK_FALSE(has(state, "--spp"));
    CHECK_FALSE(job(viewing).contains("spp"));
    CHECK(state.at("command").get<std::string>().find("--samples=0:") != std::string::npos);
    CHECK(same_pixels(viewing.saved("save.exr"), viewing.rendered(state, "command.exr")));
}

TEST_CASE("pages see denoised pictures, and files are as the command writes them", "[live_view]")
{
    for (const Words& more : {Words{}, Words{"--background=white", "--ground=shadow"}}) {
        Words words{"--spp=4", "--integrator=mis", "--denoiser-library=" BDPT_FAKE_OIDN};
        words.insert(words.end(), more.begin(), more.end());
        Viewing viewing(words);
        const json state = viewing.finished();
        CHECK(state.at("denoise") == true);
        // The denoiser may end after the render.
        const auto denoised = viewing.listener().frame(
            [](const view::Frame& frame) { return frame.denoised == 1 && frame.samples == 4; });
        CHECK(denoised->channels == (more.empty() ? 3 : 5));
        CHECK(same_pixels(viewing.saved("save.exr"), viewing.rendered(state, "command.exr")));
        CHECK(same_pixels(viewing.saved("save.png"), viewing.rendered(state, "command.png")));
        CHECK_FALSE(viewing.ask({{"set", {{"denoise", false}}}}).contains("error"));
        const auto noisy = viewing.listener().frames().back();
        CHECK(noisy->denoised == 0);
        CHECK(noisy->pixels != denoised->pixels);
        // Without samples for a new one, the last denoised picture comes back.
        CHECK_FALSE(viewing.ask({{"set", {{"denoise", true}}}}).contains("error"));
        CHECK(viewing.listener().frames().back()->pixels == denoised->pixels);
        // A denoised picture of another view is never shown.
        static_cast<void>(viewing.ask({{"move", {{"orbit", {0.3, 0.0}}, {"dolly", 1.0}}}}));
        static_cast<void>(viewing.finished({"--from="}));
        const auto moved =
            viewing.listener().frame([](const view::Frame& frame) { return frame.denoised == 1; });
        CHECK(moved->generation > denoised->generation);
    }
    Viewing without({"--spp=2", "--denoise=false", "--denoiser-library=" BDPT_FAKE_OIDN});
    CHECK(without.finished().at("denoise").is_null());
    CHECK(without.ask({{"set", {{"denoise", true}}}}).contains("error"));
}

TEST_CASE("pages choose lens, field of view, background and ground", "[live_view]")
{
    Viewing viewing({"--spp=2"});
    const json before = viewing.finished();
    CHECK(viewing.ask({{"focus", {24, 12}}, {"turn", false}}).contains("error"));  // a pinhole
    CHECK_FALSE(
        viewing
            .ask({{"set",
                   {{"fov", 30}, {"f_stop", 0.25}, {"background", "white"}, {"ground", true}}}})
            .contains("error"));
    CHECK_FALSE(viewing.ask({{"focus", {30, 12}}, {"turn", false}}).contains("error"));
    json state = viewing.finished({"--fov=30", "--f-stop=0.25", "--background=white",
                                   "--ground=shadow", "--focus-distance=4"});
    CHECK(state.at("camera").at("fov").get<double>() == Approx(30.0));
    CHECK(state.at("camera").at("f_stop").get<double>() == Approx(0.25));
    CHECK(state.at("camera").at("from") == before.at("camera").at("from"));
    CHECK(state.at("command").get<std::string>().find("--look-at") == std::string::npos);
    CHECK(state.at("background") == "#ffffff");
    CHECK(state.at("ground") == true);
    CHECK(same_pixels(viewing.saved("save.exr"), viewing.rendered(state, "command.exr")));
    CHECK_FALSE(
        viewing.ask({{"set", {{"f_stop", nullptr}, {"ground", false}, {"background", nullptr}}}})
            .contains("error"));
    CHECK_FALSE(viewing.ask({{"set", {{"camera", "side"}}}}).contains("error"));
    state = viewing.finished({"--camera=side", "--ground=none"});
    CHECK(state.at("camera").at("choice") == "side");
    CHECK(state.at("cameras") == json::parse(R"([["front", "front"], ["side", "side"]])"));
    CHECK(state.at("ground") == false);
    for (const char* word : {"--f-stop", "--focus", "--background", "--fov"}) {
        CAPTURE(word);
        CHECK(state.at("command").get<std::string>().find(word) == std::string::npos);
    }
    CHECK(same_pixels(viewing.saved("save.exr"), viewing.rendered(state, "command.exr")));
    for (const json& wrong : {json{{"camera", "top"}}, json{{"background", "/etc/passwd.png"}},
                              json{{"variant", "night"}}, json{{"animation", "run"}}}) {
        CAPTURE(wrong.dump());
        CHECK(viewing.ask({{"set", wrong}}).contains("error"));
    }
}

TEST_CASE("a field of view from a framed camera keeps its place", "[live_view]")
{
    Viewing viewing({"--spp=2"}, "");
    const json before = viewing.finished();
    CHECK(before.at("camera").at("choice") == "auto");
    CHECK_FALSE(viewing.ask({{"set", {{"fov", 20}}}}).contains("error"));
    const json state = viewing.finished({"--fov=20"});
    for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(state.at("camera").at("from").at(axis).get<double>() ==
              Approx(before.at("camera").at("from").at(axis).get<double>()).margin(1e-4));
    }
    CHECK(same_pixels(viewing.saved("save.exr"), viewing.rendered(state, "command.exr")));
}

/// Gives the cube of `file` two variants, and an animation that takes two seconds.
void animate(const fs::path& file)
{
    json scene = json::parse(text_of(file));
    const std::size_t cube = scene["nodes"].size() - 1;
    const std::size_t accessor = scene["accessors"].size();
    scene["extensionsUsed"] = {"KHR_materials_variants"};
    scene["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "day"}},
                                                                 {{"name", "night"}}};
    scene["materials"].push_back({{"emissiveFactor", {1, 1, 1}}});
    scene["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 1}, {"variants", {1}}}};
    // Little-endian floats: 0, 2; 0, 0, 0, 1, 0, 0.
    scene["buffers"].push_back(
        {{"byteLength", 32},
         {"uri",
          "data:application/octet-stream;base64,AAAAAAAAAEAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAA="}});
    scene["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 32}});
    scene["accessors"].push_back({{"bufferView", 2},
                                  {"componentType", 5126},
                                  {"count", 2},
                                  {"type", "SCALAR"},
                                  {"min", {0}},
                                  {"max", {2}}});
    scene["accessors"].push_back({{"bufferView", 2},
                                  {"byteOffset", 8},
                                  {"componentType", 5126},
                                  {"count", 2},
                                  {"type", "VEC3"}});
    scene["animations"] = {
        {{"name", "slide"},
         {"channels", {{{"sampler", 0}, {"target", {{"node", cube}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", accessor}, {"output", accessor + 1}}}}}};
    write_text(file, scene.dump());
}

TEST_CASE("pages choose a variant and the time of an animation", "[live_view]")
{
    Viewing viewing({"--spp=2"}, two_cameras, animate);
    json state = viewing.finished();
    CHECK(state.at("variants") == json::parse(R"([["day", "day"], ["night", "night"]])"));
    CHECK(state.at("animations") == json::array({{"slide", "slide"}}));
    CHECK(state.at("animation_ends") == json::array({2.0}));
    CHECK(state.at("time").is_null());
    const fs::path at_rest = viewing.path("at_rest.exr");
    fs::rename(viewing.saved("save.exr"), at_rest);
    for (const json& wish : {json{{"variant", "night"}}, json{{"time", 1.5}}}) {
        CAPTURE(wish.dump());
        CHECK_FALSE(viewing.ask({{"set", wish}}).contains("error"));
        state = viewing.finished({wish.contains("time") ? "--frame-time=1.5" : "--variant=night"});
        CHECK_FALSE(same_pixels(viewing.saved("save.exr"), at_rest));
        CHECK(same_pixels(viewing.saved("save.exr"), viewing.rendered(state, "command.exr")));
    }
    CHECK(state.at("variant") == "night");
    CHECK(state.at("time") == 1.5);
    CHECK_FALSE(
        viewing.ask({{"set", {{"variant", nullptr}, {"time", nullptr}}}}).contains("error"));
    static_cast<void>(viewing.listener().state([](const json& now) {
        return now.at("command").dump().find("time") == std::string::npos;
    }));
    static_cast<void>(viewing.finished());
    CHECK(same_pixels(viewing.saved("save.exr"), at_rest));
}

TEST_CASE("two integrators have the same view and samples of their own", "[live_view]")
{
    Viewing viewing({"--spp=4", "--integrator=mis"});
    static_cast<void>(viewing.finished());
    CHECK_FALSE(viewing.ask({{"set", {{"integrator_b", "bdpt"}}}}).contains("error"));
    static_cast<void>(
        viewing.listener().state([](const json& state) { return state.at("slots").size() == 2; }));
    const json state = viewing.finished();
    CHECK(state.at("slots").at(0).at("integrator") == "mis");
    CHECK(state.at("slots").at(1).at("integrator") == "bdpt");
    const fs::path of_a = viewing.path("a.exr");
    fs::rename(viewing.saved("save.exr", 0), of_a);
    CHECK_FALSE(same_pixels(of_a, viewing.saved("save.exr", 1)));
    CHECK(same_pixels(of_a, viewing.rendered(state, "command.exr")));
}

TEST_CASE("settings that cannot be are refused, and change nothing", "[live_view]")
{
    Viewing viewing({"--spp=2"});
    const json before = viewing.finished();
    const std::vector<json> wrong{{{"set", {{"integrator_a", "magic"}}}},
                                  {{"set", {{"integrator_b", "magic"}, {"paused", true}}}},
                                  {{"set", {{"environment", "/etc/passwd"}, {"layer", "noise"}}}},
                                  {{"set", {{"curve", "none at all"}, {"layer", "noise"}}}},
                                  {{"set", {{"layer", "rates"}}}},
                                  {{"set", {{"strategy", {9, 9}}}}},
                                  {{"inspect", {48, 3}}},
                                  {{"focus", {3, 24}}}};
    for (const json& request : wrong) {
        CAPTURE(request.dump());
        CHECK(viewing.ask(request).contains("error"));
    }
    // One that can be, by which we know that the others are done.
    CHECK_FALSE(viewing.ask({{"set", {{"curve", "agx"}}}}).contains("error"));
    const json after =
        viewing.listener().state([](const json& state) { return state.at("curve") == "agx"; });
    for (const auto& [key, value] : before.items()) {
        if (key != "curve" && key != "command" && key != "final_command") {
            CAPTURE(key);
            CHECK(after.at(key) == value);
        }
    }
}

TEST_CASE("a pixel tells where its light comes from", "[live_view]")
{
    Viewing viewing({"--spp=2", "--integrator=bdpt"});
    static_cast<void>(viewing.finished());
    const json answer = viewing.ask({{"inspect", {24, 12}}, {"sample", 1}});
    const json& sample = answer.at("inspect");
    CHECK(sample.at("pixel") == json({24, 12}));
    // The first surface is seen at the pixel itself.
    const json& raster = sample.at("camera_path").at(1).at("raster");
    CHECK(std::abs(raster.at(0).get<double>() - 24.5) < 1.0);
    CHECK(std::abs(raster.at(1).get<double>() - 12.5) < 1.0);
    CHECK(sample.contains("contributions"));
}

TEST_CASE("a page has the coordinates of a file on a map", "[live_view]")
{
    Viewing viewing({"--spp=2"}, two_cameras, [](const fs::path& file) {
        json scene = json::parse(text_of(file));
        json& roots = scene["scenes"][0]["nodes"];
        scene["nodes"].push_back({{"children", roots}, {"translation", {128000, 0, -64000}}});
        roots = {scene["nodes"].size() - 1};
        write_text(file, scene.dump());
    });
    const auto is_at = [](const json& point, double x, double y, double z) {
        CAPTURE(point.dump());
        CHECK(point.at(0).get<double>() == Approx(x).margin(1e-3).epsilon(0));
        CHECK(point.at(1).get<double>() == Approx(y).margin(1e-3).epsilon(0));
        CHECK(point.at(2).get<double>() == Approx(z).margin(1e-3).epsilon(0));
    };
    is_at(viewing.finished().at("camera").at("from"), 128000, 0, -63995);
    // The camera turns about the front of the cube by a right angle, and comes twice as near.
    const auto quarter = static_cast<float>(std::acos(0.0));
    static_cast<void>(viewing.ask({{"move", {{"orbit", {-quarter, 0.0}}, {"dolly", 0.5}}}}));
    const json state = viewing.finished({"--from=12800"});
    is_at(state.at("camera").at("from"), 128002, 0, -63999);
    is_at(state.at("camera").at("look_at"), 128000, 0, -63999);
    CHECK(same_pixels(viewing.saved("save.exr"), viewing.rendered(state, "command.exr")));
    const json answer = viewing.ask({{"inspect", {24, 12}}, {"sample", 0}});
    const json& path = answer.at("inspect").at("camera_path");
    is_at(path.at(0).at("position"), 128002, 0, -63999);
    CHECK(std::abs(path.at(1).at("raster").at(0).get<double>() - 24.5) < 1.0);
    CHECK(path.at(1).at("position").at(0).get<double>() == Approx(128001.0).epsilon(1e-7));
}

TEST_CASE("noise and strategies are layers", "[live_view]")
{
    Viewing viewing({"--spp=4", "--integrator=bdpt"});
    static_cast<void>(viewing.finished());
    CHECK_FALSE(viewing.ask({{"set", {{"layer", "noise"}}}}).contains("error"));
    CHECK(viewing.listener()
              .state([](const json& state) { return state.at("layer") == "noise"; })
              .at("scale")
              .at("ticks")
              .size() == 4);
    CHECK_FALSE(
        viewing.ask({{"set", {{"layer", "strategy"}, {"strategy", {1, 2}}}}}).contains("error"));
    static_cast<void>(viewing.listener().state(
        [](const json& state) { return state.at("layer") == "strategy"; }));
    const std::size_t shown = viewing.listener().frames().size();
    for (int i = 0; i < 600 && viewing.listener().frames().size() < shown + 1; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    CHECK(viewing.listener().frames().size() > shown);
    CHECK(viewing.ask({{"set", {{"strategy", {5, 5}}}}}).contains("error"));
}

TEST_CASE("a file that changes is loaded again, and a broken one keeps the picture", "[live_view]")
{
    Viewing viewing({"--spp=2"});
    static_cast<void>(viewing.finished());
    const std::string whole = text_of(viewing.path("cube.gltf"));
    std::ofstream(viewing.path("cube.gltf")) << whole.substr(0, whole.size() / 2);
    const json broken =
        viewing.listener().state([](const json& state) { return state.at("message").is_string(); });
    CHECK(broken.at("message").get<std::string>().find("cube.gltf") != std::string::npos);
    CHECK(viewing.save("save.exr").status == 200);
    std::ofstream(viewing.path("cube.gltf")) << whole << "\n";
    static_cast<void>(
        viewing.listener().state([](const json& state) { return state.at("message").is_null(); }));
    static_cast<void>(viewing.finished());
}

}  // namespace
TEST_CASE("a page shows why its scene cannot be loaded, and the scene once it can", "[live_view]")
{
    const auto shows_message = [](const json& state) { return !state.at("message").is_null(); };
    SECTION("it does not fit into memory")
    {
        Viewing viewing({"--max-memory=20000"});
        const json state = viewing.listener().state(shows_message);
        CHECK(state.at("message").get<std::string>().find("--max-memory") != std::string::npos);
        CHECK_FALSE(state.at("loading").get<bool>());
        CHECK(viewing.ask({{"move", {{"orbit", {0.1, 0.0}}, {"dolly", 1.0}}}}).contains("error"));
    }
    SECTION("it is broken, and then mended")
    {
        std::string text;
        Viewing viewing({"--spp=2"}, two_cameras, [&](const fs::path& file) {
            text = text_of(file);
            std::ofstream(file) << text.substr(0, text.size() / 2);
        });
        const json state = viewing.listener().state(shows_message);
        CHECK(state.at("message").get<std::string>().find("cube.gltf") != std::string::npos);
        std::ofstream(viewing.path("cube.gltf")) << text;
        CHECK(viewing.finished().at("slots").at(0).at("samples") == 2);
    }
}

}  // namespace bdpt::test::live_view_session_test
