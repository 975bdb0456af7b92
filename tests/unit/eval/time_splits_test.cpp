#include "bench/time_splits.h"

#include <bdpt/error.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stop_token>
#include <string>

#include "bench_scene.h"
#include "catch.hpp"
#include "scratch_folder.h"

namespace bdpt::eval::time_splits_test {
namespace {

using nlohmann::json;

struct Fixture {
    SceneDesc desc = test::lit_floor();
    Scene scene{desc};
    test::ScratchFolder folder;
    BenchFiles files{folder.path(), "floor"};
    BenchOptions options;
    BenchControl control;
    std::vector<BenchGoals> goals{
        {.integrator = IntegratorKind::pt, .equal_time = 128, .equal_samples = 1},
        {.integrator = IntegratorKind::bdpt, .equal_time = 64, .equal_samples = 1}};

    Fixture()
    {
        options.seconds = 0.1;
        options.render.transport.max_depth = 3;
        files.create();
    }
    [[nodiscard]] std::vector<TimeSplit> measure() const
    {
        const BenchScene subject{.name = "floor",
                                 .file = "floor.gltf",
                                 .scene = scene,
                                 .camera = test::floor_camera(),
                                 .width = 12,
                                 .height = 9};
        BenchProgressMeter meter(0.1, control);
        return measure_time_splits(subject, options, files, goals, meter, control);
    }
};

}  // namespace

TEST_CASE("a benchmark measures once where the time of each integrator goes")
{
    const Fixture bench;
    const std::vector<TimeSplit> splits = bench.measure();
    REQUIRE(splits.size() == 2);
    CHECK(splits[0].integrator == IntegratorKind::pt);
    CHECK(splits[1].integrator == IntegratorKind::bdpt);
    CHECK(splits[0].samples == 64);
    CHECK(splits[1].samples == 32);
    for (const TimeSplit& split : splits) {
        CHECK(split.sample_seconds > 0.0);
        CHECK(std::accumulate(split.shares.begin(), split.shares.end(), 0.0) == Approx(1.0));
    }
    CHECK(splits[1].shares[static_cast<std::size_t>(Phase::weigh)] > 0.0);

    SECTION("and keeps it")
    {
        const auto file = bench.files.time_split(IntegratorKind::pt);
        json kept = json::parse(test::read_text(file));
        kept["sample_seconds"] = 1234.5;
        test::write_text(file, kept.dump());
        CHECK(bench.measure()[0].sample_seconds == 1234.5);
        CHECK(bench.measure()[1].sample_seconds == splits[1].sample_seconds);
        CHECK(packed_time_map(bench.files, IntegratorKind::pt) ==
              kept["pixels"].get<std::string>());
        CHECK_FALSE(packed_time_map(bench.files, IntegratorKind::nee));
    }
    SECTION("but not that of another integrator")
    {
        test::write_text(bench.files.time_split(IntegratorKind::bdpt),
                         test::read_text(bench.files.time_split(IntegratorKind::pt)));
        try {
            static_cast<void>(bench.measure());
            FAIL("it was taken");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::invalid_input);
            CHECK(std::string(error.what()).find("bdpt-time.json: is of a different integrator") !=
                  std::string::npos);
        }
    }
}

TEST_CASE("a time split that is stopped is not kept")
{
    Fixture bench;
    std::stop_source stop;
    stop.request_stop();
    bench.control.stop = stop.get_token();
    // More than a pass.
    bench.goals[0].equal_time = 1000;
    CHECK(bench.measure().empty());
    CHECK_FALSE(std::filesystem::exists(bench.files.time_split(IntegratorKind::pt)));
}

}  // namespace bdpt::eval::time_splits_test
