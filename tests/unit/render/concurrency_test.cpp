#include <bdpt/render.h>

#include "catch.hpp"
#include "room.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

// Several renders at once in one process. Assertions are made by the test's own thread only.

namespace bdpt::concurrency_test {
namespace {

#if defined(__x86_64__)
constexpr Isa other_isa = Isa::sse2;
#else
constexpr Isa other_isa = Isa::native;  // there is one only
#endif

using test::room;

RenderOptions options(IntegratorKind integrator, std::uint64_t seed)
{
    RenderOptions result;
    result.integrator = integrator;
    result.film.width = 19;
    result.film.height = 13;
    result.sampling.samples = {.begin = 0, .end = 4};
    result.transport.max_depth = 4;
    result.system.tile_size = 4;
    result.sampling.seed = seed;
    result.film.aovs = {Aov::albedo, Aov::depth};
    return result;
}

/// Renders that differ in all that a render could share with another by mistake.
std::vector<RenderOptions> different_options()
{
    std::vector<RenderOptions> result{
        options(IntegratorKind::bdpt, 1), options(IntegratorKind::bdpt, 2),
        options(IntegratorKind::mis, 1), options(IntegratorKind::lt, 3)};
    result[0].system.threads = 1;
    result[1].system.threads = 8;
    result[2].film.clamp = 0.5f;
    result[2].film.filter.kind = FilterKind::tent;
    result[3].sampling.sampler = SamplerKind::independent;
    return result;
}

RenderResult alone(const Scene& scene, const RenderOptions& options)
{
    return render(scene, test::room_camera(), options);
}

bool same(const RenderResult& a, const RenderResult& b)
{
    return a.film == b.film && a.aovs == b.aovs && a.stats == b.stats;
}

/// Runs all of them at the same time and waits for their ends.
void at_once(const std::vector<std::function<void()>>& tasks)
{
    std::atomic<std::size_t> ready{0};
    std::vector<std::jthread> threads;
    for (const auto& task : tasks) {
        threads.emplace_back([&ready, &tasks, &task] {
            ++ready;
            while (ready < tasks.size()) {
                std::this_thread::yield();
            }
            task();
        });
    }
}

}  // namespace

TEST_CASE("renders of one scene at once give the bits of each alone", "[concurrency]")
{
    const Scene scene = room();
    const std::vector<RenderOptions> kinds = different_options();
    std::vector<std::optional<RenderResult>> results(kinds.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        tasks.emplace_back([&, i] { results[i] = alone(scene, kinds[i]); });
    }
    at_once(tasks);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        CAPTURE(i);
        REQUIRE(results[i].has_value());
        CHECK(same(*results[i], alone(scene, kinds[i])));
    }
}

TEST_CASE("scenes that are built, rendered and destroyed at once do not disturb each other",
          "[concurrency]")
{
    const std::vector<RenderOptions> kinds = different_options();
    std::vector<std::optional<RenderResult>> results(kinds.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        tasks.emplace_back([&, i] {
            // The first ones end, scene and all, while the others go on.
            for (std::size_t round = 0; round <= i; ++round) {
                const Scene scene = room(i % 2 == 0 ? Isa::native : other_isa);
                results[i] = alone(scene, kinds[i]);
            }
        });
    }
    at_once(tasks);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        CAPTURE(i);
        const Scene scene = room(i % 2 == 0 ? Isa::native : other_isa);
        REQUIRE(results[i].has_value());
        CHECK(same(*results[i], alone(scene, kinds[i])));
    }
}

TEST_CASE("a callback that throws ends its own render only", "[concurrency]")
{
    const Scene scene = room();
    const std::vector<RenderOptions> kinds = different_options();
    std::vector<std::optional<RenderResult>> results(kinds.size());
    std::vector<std::string> thrown(kinds.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        tasks.emplace_back([&, i] {
            RenderControl control;
            if (i % 2 == 0) {
                control.on_progress = [i](const Progress& progress) {
                    if (progress.samples_done > 1) {
                        throw std::runtime_error("thrown by " + std::to_string(i));
                    }
                };
            }
            try {
                results[i] = render(scene, test::room_camera(), kinds[i], control);
            } catch (const std::runtime_error& error) {
                thrown[i] = error.what();
            }
        });
    }
    at_once(tasks);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        CAPTURE(i);
        REQUIRE(results[i].has_value() == (i % 2 != 0));
        if (i % 2 == 0) {
            CHECK(thrown[i] == "thrown by " + std::to_string(i));
        } else {
            CHECK(same(*results[i], alone(scene, kinds[i])));
        }
    }
}

TEST_CASE("a stop from another thread ends one render, and what it has is right", "[concurrency]")
{
    const Scene scene = room();
    RenderOptions endless = options(IntegratorKind::bdpt, 5);
    endless.sampling.samples = {.begin = 0, .end = 1'000'000'000};
    const RenderOptions short_one = options(IntegratorKind::mis, 6);
    std::stop_source stop;
    std::atomic<bool> begun{false};
    std::optional<RenderResult> stopped;
    std::optional<RenderResult> whole;
    at_once({[&] {
                 RenderControl control;
                 control.stop = stop.get_token();
                 control.on_progress = [&](const Progress&) {
                     begun = true;
                     begun.notify_all();
                 };
                 stopped = render(scene, test::room_camera(), endless, control);
             },
             [&] {
                 begun.wait(false);
                 stop.request_stop();
             },
             [&] { whole = alone(scene, short_one); }});
    REQUIRE(stopped.has_value());
    REQUIRE(whole.has_value());
    CHECK(same(*whole, alone(scene, short_one)));
    REQUIRE(stopped->samples.end() > 0);
    REQUIRE(stopped->samples.end() < endless.sampling.samples.end);
    endless.sampling.samples.end = stopped->samples.end();
    CHECK(same(*stopped, alone(scene, endless)));
}

TEST_CASE("a stop that was requested before still gives one pass", "[concurrency]")
{
    const Scene scene = room();
    std::stop_source stop;
    stop.request_stop();
    RenderControl control;
    control.stop = stop.get_token();
    RenderOptions o = options(IntegratorKind::pt, 7);
    o.sampling.samples = {.begin = 10, .end = 1'000'000'000};
    const RenderResult result = render(scene, test::room_camera(), o, control);
    CHECK(result.samples.ranges().front().begin == 10);
    CHECK(result.samples.end() == 11);
    CHECK(result.film.sample_count() == 1);
}

TEST_CASE("results outlive the scene that they are of", "[concurrency]")
{
    std::optional<Scene> scene(room());
    const RenderOptions o = options(IntegratorKind::bdpt, 8);
    const RenderResult result = alone(*scene, o);
    const RenderResult again = alone(*scene, o);
    Scene moved = std::move(*scene);
    scene.reset();
    CHECK(same(alone(moved, o), result));
    moved = room();  // the old one is gone
    CHECK(same(again, result));
    CHECK(result.aovs.develop(result.film).size() == 2);
}

}  // namespace bdpt::concurrency_test
