// bdpt::eval::verify() on small scenes.

#include <bdpt/error.h>
#include <bdpt/eval/verify.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <stop_token>
#include <string>

namespace bdpt::eval::verify_test {
namespace {

using test::SceneBuilder;

/// A lamp above a floor, a glass sphere, and a point light: strategies are blind for much.
Scene stage()
{
    SceneBuilder builder;
    builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1},
                 test::lambertian({0.8f, 0.6f, 0.4f}));
    builder.lamp(1.0f, 1.1f, Rgb(4.0f, 3.5f, 3.0f));
    builder.sphere({0.0f, -0.4f, 0.0f}, 0.4f, test::glass(0.0f));
    builder.light(PointLightDesc{.position = {0.5f, 0.5f, 0.5f}, .intensity = Rgb(0.3f)});
    return Scene(std::move(builder.desc));
}

CameraDesc camera()
{
    return test::camera_at({0.0f, 0.3f, 3.6f}, {0.0f, 0.0f, 0.0f}, 0.75f);
}

VerifyOptions options(std::int64_t batches = 8)
{
    VerifyOptions result;
    result.width = 8;
    result.height = 6;
    result.grid = 2;
    result.max_depth = 4;
    result.max_batches = batches;
    result.seconds = 1e6;
    result.seed = 1;
    return result;
}

std::string text_of(VerifyReport report)
{
    report.seconds = 0.0;
    return verify_json(report, "scene");
}

}  // namespace

TEST_CASE("verify passes on a stage through all cameras", "[long]")
{
    const Scene scene = stage();
    for (const CameraDesc& view :
         {camera(), test::with_lens(camera(), 0.6f, 3.4f), test::in_parallel(camera(), 2.6f)}) {
        VerifyOptions how = options(4096);
        how.detectable_bias = 0.1;
        const VerifyReport report = verify(scene, view, how);
        INFO(text_of(report));
        CHECK(report.verdict == Verdict::pass);
        CHECK(report.batches >= 32);
        CHECK(report.batches < 4096);
        CHECK(report.weights.paths > 1000);
        CHECK(report.weights.worst < 1e-4);
        CHECK(report.radiance > 0.0);
        // What the point light casts through the glass only light paths can make.
        CHECK(report.lengths[3].seen_from_camera < 1.0);
    }
}

TEST_CASE("verify passes with shared light paths and any number of connections", "[long]")
{
    const Scene scene = stage();
    struct Choice {
        double light_paths;
        std::optional<double> connections;
    };
    for (const Choice& choice : {Choice{0.0625, 1.0}, Choice{0.5, 0.25}, Choice{0.3, 1.7},
                                 Choice{4.0, 0.25}, Choice{2.0, std::nullopt}}) {
        VerifyOptions how = options(2048);
        how.detectable_bias = 0.2;
        how.light_paths = choice.light_paths;
        how.connections = choice.connections;
        const VerifyReport report = verify(scene, camera(), how);
        INFO(choice.light_paths << " light paths: " << text_of(report));
        CHECK(report.verdict == Verdict::pass);
        CHECK(report.weights.paths > 1000);
    }
}

TEST_CASE("verify judges vcm: right with a small merge radius, blurred with a great one", "[long]")
{
    const Scene scene = stage();
    const auto verdict = [&](double radius, std::int64_t batches) {
        VerifyOptions how = options(batches);
        how.detectable_bias = 0.2;
        how.merge_radius = radius;
        VerifyReport report = verify(scene, camera(), how);
        CHECK(report.images.size() == 6);
        CHECK(report.images.back().integrator == IntegratorKind::vcm);
        return report;
    };
    const auto fails_for_vcm_alone = [](const VerifyReport& report) {
        bool vcm = false;
        bool others = false;
        for (const IntegratorFinding& finding : report.integrators) {
            (finding.integrator == IntegratorKind::vcm ? vcm : others) |=
                fails(finding.whole, report);
        }
        return vcm && !others;
    };
    const VerifyReport small = verdict(VerifyOptions::small_merge_radius, 4096);
    INFO(text_of(small));
    CHECK(small.verdict == Verdict::pass);
    CHECK(small.images.back().radiance > 0.0);
    const VerifyReport great = verdict(0.3, 32);
    INFO(text_of(great));
    CHECK(great.verdict == Verdict::fail);
    CHECK(fails_for_vcm_alone(great));
}

TEST_CASE("verify gives the same bits for any number of threads")
{
    const Scene scene = stage();
    VerifyOptions one = options(11);
    one.threads = 1;
    VerifyOptions three = one;
    three.threads = 3;
    const std::string first = text_of(verify(scene, camera(), one));
    CHECK(first == text_of(verify(scene, camera(), three)));
    VerifyOptions other = one;
    other.seed = 2;
    CHECK(first != text_of(verify(scene, camera(), other)));
}

TEST_CASE("verify stops when it is told to, with what is there")
{
    std::stop_source stop;
    VerifyControl control;
    control.stop = stop.get_token();
    std::int64_t seen = 0;
    control.on_progress = [&](const VerifyProgress& progress) {
        seen = progress.batches;
        stop.request_stop();
    };
    const VerifyReport report = verify(stage(), camera(), options(100000), control);
    CHECK(report.batches == seen);
    CHECK(report.batches >= 8);
    CHECK(report.batches < 1000);
}

TEST_CASE("verify refuses options out of range")
{
    const Scene scene = stage();
    const auto refused = [&](const auto& change) {
        VerifyOptions bad = options();
        change(bad);
        try {
            (void)verify(scene, camera(), bad);
        } catch (const Error& error) {
            return error.code() == ErrorCode::usage;
        }
        return false;
    };
    CHECK(refused([](VerifyOptions& o) { o.width = 0; }));
    CHECK(refused([](VerifyOptions& o) { o.height = 4097; }));
    CHECK(refused([](VerifyOptions& o) { o.grid = 7; }));
    CHECK(refused([](VerifyOptions& o) { o.grid = 0; }));
    CHECK(refused([](VerifyOptions& o) { o.max_depth = 0; }));
    CHECK(refused([](VerifyOptions& o) { o.max_depth = 65; }));
    CHECK(refused([](VerifyOptions& o) { o.false_alarm = 0.0; }));
    CHECK(refused([](VerifyOptions& o) { o.detectable_bias = -1.0; }));
    CHECK(refused([](VerifyOptions& o) { o.seconds = 0.0; }));
    CHECK(refused([](VerifyOptions& o) { o.max_batches = 1; }));
    CHECK(refused([](VerifyOptions& o) { o.threads = -1; }));
    CHECK(refused([](VerifyOptions& o) { o.merge_radius = 1.1; }));
    CHECK(refused([](VerifyOptions& o) { o.merge_radius = -0.1; }));
}

TEST_CASE("the report is JSON")
{
    const auto json =
        nlohmann::json::parse(verify_json(verify(stage(), camera(), options()), "a\xff"));
    CHECK(json["scene"] == "a\xEF\xBF\xBD");
    CHECK(json["verdict"].is_string());
    CHECK(json["batches"] == 8);
    CHECK(json["integrators"].size() == 5);
    CHECK(json["lengths"].size() == 4);
    CHECK(json["strategies"].size() == 3 + 4 + 5 + 6);
    CHECK(json["comparisons"].size() == 16);
    CHECK(json["strategies"][0]["tiles"].size() == 4);
    CHECK(json["strategies"][0]["tiles"][3]["tile"] == nlohmann::json({4, 3, 8, 6}));
    CHECK(json["strategies"][5]["whole"].contains("p_adjusted"));
}

}  // namespace bdpt::eval::verify_test
