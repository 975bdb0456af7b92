#include <bdpt/error.h>
#include <bdpt/job.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::run_job_test {
namespace {

namespace fs = std::filesystem;

/// A folder with a scene.
class Studio {
public:
    Studio() { scene = write_cube(folder, "cube", {.cameras = two_cameras}); }

    /// A small render to out.exr, with the `size` in pixels.
    RenderJob small(std::int64_t spp = 2, int size = 16) const
    {
        RenderJob job(scene);
        job.set("size", {size, size / 2}).set("spp", spp).set("integrator", "bdpt");
        return job.set("output", {folder / "out.exr"});
    }
    /// Returns the names of files beside the scene.
    std::set<std::string> written() const
    {
        std::set<std::string> names = folder.names();
        names.erase("cube.gltf");
        names.erase("cube.bin");
        return names;
    }

    ScratchFolder folder;
    fs::path scene;
};

constexpr std::int64_t endless = 2'000'000'000;  // samples that nobody waits for

/// Redirects the standard streams to a file during its lifetime.
class CaughtStreams {
public:
    explicit CaughtStreams(const fs::path& file)
    {
        std::fflush(nullptr);
        const int caught = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        for (std::size_t i = 0; i < streams.size(); ++i) {
            saved_[i] = ::dup(streams[i]);
            ::dup2(caught, streams[i]);
        }
        ::close(caught);
    }
    ~CaughtStreams()
    {
        std::fflush(nullptr);
        for (std::size_t i = 0; i < streams.size(); ++i) {
            ::dup2(saved_[i], streams[i]);
            ::close(saved_[i]);
        }
    }
    CaughtStreams(const CaughtStreams&) = delete;
    CaughtStreams& operator=(const CaughtStreams&) = delete;

private:
    static constexpr std::array streams{STDOUT_FILENO, STDERR_FILENO};
    std::array<int, 2> saved_{};
};

ErrorCode code_of(const RenderJob& job)
{
    try {
        static_cast<void>(bdpt::run(job));
    } catch (const Error& error) {
        return error.code();
    }
    return ErrorCode::internal;
}

TEST_CASE("a program gets the files of the command, to the bit", "[job]")
{
    const Studio studio;
    RenderJob job = studio.small(3);
    job.set("output", {studio.folder / "out.exr", studio.folder / "out.png"}).set("aov", "depth");
    job.set("stats", studio.folder / "stats.json");
    const JobResult result = bdpt::run(job);
    CHECK_FALSE(result.stopped);
    REQUIRE(result.images.size() == 1);
    const JobImage& image = result.images.front();
    CHECK(image.files == std::vector<fs::path>{studio.folder / "out.exr", studio.folder / "out.png",
                                               studio.folder / "stats.json"});
    CHECK(std::all_of(image.files.begin(), image.files.end(),
                      [](const fs::path& file) { return fs::file_size(file) > 0; }));
    CHECK(image.samples_per_pixel == 3);
    CHECK(image.seconds > 0.0);
    CHECK(image.exposure);
    CHECK_FALSE(image.stopped);
    CHECK_FALSE(image.frame);
    CHECK_FALSE(image.camera);

    const std::string same = (studio.folder / "same.exr").string();
    REQUIRE(test::run({"render", studio.scene.string(), "--size", "16x8", "--spp", "3",
                       "--integrator", "bdpt", "--aov", "depth", "-o", same, "--quiet"})
                .exit_code == 0);
    const ExrFile ours = read_exr(studio.folder / "out.exr");
    const ExrFile its = read_exr(same);
    CHECK(ours.image.pixels == its.image.pixels);
    CHECK(ours.image.at(8, 4).g > 0.0f);
    CHECK(read_exr_channel(studio.folder / "out.exr", "depth.Z") ==
          read_exr_channel(same, "depth.Z"));
    CHECK(ours.text("bdpt.settings") == its.text("bdpt.settings"));
}

TEST_CASE("without outputs a job writes the image of the command", "[job]")
{
    const Studio studio;
    const fs::path before = fs::current_path();
    fs::create_directory(studio.folder / "here");
    fs::current_path(studio.folder / "here");
    RenderJob job(studio.scene);
    const JobResult result = bdpt::run(job.set("spp", 1).set("size", 8));
    fs::current_path(before);
    CHECK(result.images.at(0).files == std::vector<fs::path>{"cube.png"});
    CHECK(fs::exists(studio.folder / "here/cube.png"));
}

TEST_CASE("messages and progress go to the program, and nothing to the standard streams", "[job]")
{
    const Studio studio;
    RenderJob job = studio.small(64);
    job.set("env", "none");  // so that there is a warning: the image is black
    std::vector<std::string> notes;
    std::vector<std::string> warnings;
    std::vector<JobProgress> progress;
    JobControl control;
    control.on_message = [&](MessageKind kind, std::string_view text) {
        (kind == MessageKind::note ? notes : warnings).emplace_back(text);
    };
    control.on_progress = [&](const JobProgress& now) { progress.push_back(now); };
    {
        const CaughtStreams caught(studio.folder / "streams.txt");
        static_cast<void>(bdpt::run(job, control));
        static_cast<void>(bdpt::run(job));
    }
    CHECK(read_text(studio.folder / "streams.txt").empty());
    CHECK(warnings.size() == 1);
    REQUIRE(notes.size() >= 2);
    CHECK(notes.back().find("out.exr") != std::string::npos);
    REQUIRE_FALSE(progress.empty());
    CHECK(progress.back().render.samples_done == 64);
    CHECK(progress.back().fraction == 1.0);
    CHECK(progress.back().seconds_left == 0.0);
    CHECK(progress.back().images == 1);
    CHECK(std::is_sorted(progress.begin(), progress.end(),
                         [](const auto& a, const auto& b) { return a.fraction < b.fraction; }));
}

TEST_CASE("a stop ends the render, and what is there is written", "[job]")
{
    const Studio studio;
    std::stop_source source;
    JobControl control{.stop = source.get_token(), .on_progress = {}, .on_message = {}};
    std::int64_t seen = 0;
    control.on_progress = [&](const JobProgress& now) {
        seen = now.render.samples_done;
        source.request_stop();
    };
    const JobResult result = bdpt::run(studio.small(endless), control);
    CHECK(result.stopped);
    REQUIRE(result.images.size() == 1);
    CHECK(result.images[0].stopped);
    CHECK(result.images[0].samples_per_pixel == seen);
    CHECK(seen > 0);
    CHECK(seen < endless);
    CHECK(read_exr(studio.folder / "out.exr").integer("bdpt.spp") == seen);

    SECTION("before the first pass nothing is written")
    {
        fs::remove(studio.folder / "out.exr");
        const JobResult none = bdpt::run(studio.small(endless), control);
        CHECK(none.stopped);
        CHECK(none.images.empty());
        CHECK(studio.written().empty());
    }
}

TEST_CASE("a sequence has several images, and a stop leaves out the last ones", "[job]")
{
    const Studio studio;
    RenderJob job = studio.small(1);
    job.set("output", {studio.folder / "out.#.exr"}).set("orbit", 3);
    std::stop_source source;
    JobControl control;
    control.stop = source.get_token();
    std::set<std::size_t> images;
    control.on_progress = [&](const JobProgress& now) {
        CHECK(now.images == 3);
        images.insert(now.image);
        if (now.image == 1) {
            source.request_stop();
        }
    };
    const JobResult result = bdpt::run(job, control);
    CHECK(result.stopped);
    REQUIRE(result.images.size() == 2);
    CHECK(images == std::set<std::size_t>{0, 1});
    CHECK(result.images[0].frame == 1);
    CHECK_FALSE(result.images[0].stopped);
    CHECK(result.images[1].frame == 2);
    CHECK(result.images[1].files == std::vector<fs::path>{studio.folder / "out.2.exr"});
    CHECK(studio.written() == std::set<std::string>{"out.1.exr", "out.2.exr"});

    RenderJob cameras = studio.small(1);
    cameras.set("output", {studio.folder / "{camera}.exr"}).set("cameras", "all");
    const JobResult both = bdpt::run(cameras);
    REQUIRE(both.images.size() == 2);
    CHECK(both.images[1].camera == "side");
}

TEST_CASE("what a callback throws ends the job, and no file is written", "[job]")
{
    const Studio studio;
    JobControl control;
    control.on_progress = [](const JobProgress&) { throw std::runtime_error("enough"); };
    CHECK_THROWS_WITH(bdpt::run(studio.small(), control), "enough");
    CHECK(studio.written().empty());
}

TEST_CASE("jobs that cannot be done are errors of the command", "[job]")
{
    const Studio studio;
    CHECK(code_of(RenderJob(studio.folder / "no.glb")) == ErrorCode::not_found);
    CHECK(code_of(studio.small().set("samples", "0:1").set("noise", "2%")) == ErrorCode::usage);
    CHECK(code_of(studio.small().set("output", {studio.folder / "no/out.exr"})) ==
          ErrorCode::output);
    CHECK(code_of(studio.small().set("output", {studio.scene})) != ErrorCode::internal);
    CHECK(code_of(studio.small().set("camera", "behind")) == ErrorCode::not_found);
    for (const char* name : {"-", "png:-"}) {
        CHECK(code_of(studio.small().set("output", {name})) == ErrorCode::usage);
    }
    CHECK(code_of(RenderJob("-")) == ErrorCode::usage);
    CHECK(code_of(studio.small().set("stats", "-")) == ErrorCode::usage);
    CHECK(studio.written().empty());
}

TEST_CASE("a job file writes into its folder, and the program anywhere", "[job]")
{
    const Studio studio;
    const std::string text =
        R"({"bdpt_job": 1, "file": "../cube.gltf", "size": 8, "spp": 1, "output": ["../out.exr"]})";
    fs::create_directory(studio.folder / "jobs");
    write_text(studio.folder / "jobs/a.json", text);
    RenderJob job = RenderJob::from_file(studio.folder / "jobs/a.json");
    CHECK(code_of(job) == ErrorCode::invalid_input);
    CHECK(code_of(RenderJob::from_json(text, studio.folder / "jobs")) == ErrorCode::invalid_input);
    CHECK(code_of(job.set("output", {studio.folder / "jobs/a.json"})) == ErrorCode::usage);
    CHECK_FALSE(fs::exists(studio.folder / "out.exr"));
    const fs::path out = studio.folder / "out.exr";
    write_text(out, "mine");
    CHECK(bdpt::run(job.set("output", {out})).images.at(0).files == std::vector<fs::path>{out});
}

TEST_CASE("a job goes on with its part, or replaces it", "[job]")
{
    const Studio studio;
    const fs::path part = studio.folder / "out.part.exr";
    static_cast<void>(bdpt::run(studio.small(6).set("samples", "0:2").set("part", part)));
    const JobResult more = bdpt::run(studio.small(6).set("part", part));
    CHECK(more.images.at(0).samples_per_pixel == 6);
    CHECK(more.images.at(0).files == std::vector<fs::path>{studio.folder / "out.exr", part});
    const ExrFile continued = read_exr(studio.folder / "out.exr");
    static_cast<void>(bdpt::run(studio.small(6)));
    CHECK(read_exr(studio.folder / "out.exr").image.pixels == continued.image.pixels);

    RenderJob other = studio.small(2).set("part", part).set("seed", 7);
    CHECK(code_of(other) == ErrorCode::invalid_input);
    CHECK(bdpt::run(other.set("restart", true)).images.at(0).samples_per_pixel == 2);
}

TEST_CASE("a job denoises", "[job]")
{
    const Studio studio;
    RenderJob job = studio.small().set("denoise", true).set("denoiser_library", BDPT_FAKE_OIDN);
    static_cast<void>(bdpt::run(job));
    const fs::path file = studio.folder / "out.exr";
    CHECK(read_exr_channel(file, "noisy.G") != read_exr_channel(file, "G"));
}

TEST_CASE("signals stay those of the program", "[job]")
{
    const Studio studio;
    JobControl control;
    int blocked = -1;
    control.on_progress = [&](const JobProgress&) {
        sigset_t signals;
        ::pthread_sigmask(SIG_BLOCK, nullptr, &signals);
        blocked = sigismember(&signals, SIGINT) + sigismember(&signals, SIGTERM);
    };
    static_cast<void>(bdpt::run(studio.small(), control));
    CHECK(blocked == 0);
}

TEST_CASE("jobs of several threads do not disturb each other", "[job]")
{
    const Studio studio;
    const auto job = [&](int seed, const std::string& name) {
        RenderJob result = studio.small(16, 32);
        return result.set("seed", seed).set("output", {studio.folder / name});
    };
    std::vector<std::jthread> threads;
    std::array<std::vector<std::string>, 3> told;
    for (int seed = 0; seed < 3; ++seed) {
        threads.emplace_back([&, seed] {
            std::vector<std::string>& mine = told[static_cast<std::size_t>(seed)];
            JobControl control;
            control.on_message = [&](MessageKind, std::string_view text) {
                mine.emplace_back(text);
            };
            static_cast<void>(
                bdpt::run(job(seed, "together" + std::to_string(seed) + ".exr"), control));
        });
    }
    threads.clear();
    for (int seed = 0; seed < 3; ++seed) {
        const std::string number = std::to_string(seed);
        static_cast<void>(bdpt::run(job(seed, "alone.exr")));
        CHECK(read_exr(studio.folder / "alone.exr").image.pixels ==
              read_exr(studio.folder / ("together" + number + ".exr")).image.pixels);
        const std::vector<std::string>& mine = told[static_cast<std::size_t>(seed)];
        CHECK(std::count_if(mine.begin(), mine.end(), [](const std::string& text) {
                  return text.find("wrote ") != std::string::npos;
              }) == 1);
    }
}

}  // namespace
}  // namespace bdpt::test::run_job_test
