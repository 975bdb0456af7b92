#include "options/groups/transport_arguments.h"

#include <bdpt/error.h>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "options/render_arguments.h"

#include <string>
#include <vector>

namespace bdpt::job::transport_arguments_test {
namespace {

TEST_CASE("strategies are two numbers of vertices")
{
    CHECK(parse_strategies("s2t1") == std::vector{Strategy{2, 1}});
    CHECK(parse_strategies("s2t1,s0t3,s12t345") ==
          std::vector{Strategy{2, 1}, Strategy{0, 3}, Strategy{12, 345}});
    for (const char* wrong :
         {"", ",", "s2t1,", "s2t1,,s1t1", "s2", "t1", "2t1", "s2t", "st1", "s2t1 ", "s-1t3", "t1s2",
          "S2T1", "s0t0", "s1t0", "s0t1", "s2t1t1", "s2t4098", "s99999999999999999999t1"}) {
        CAPTURE(wrong);
        CHECK_FALSE(parse_strategies(wrong));
    }
}

/// What a command line with `words` renders by.
RenderOptions options_of(std::vector<std::string> words)
{
    words.insert(words.end(), {"--output=out.exr", "scene.gltf"});
    return render_arguments(words).options;
}

TEST_CASE("words about transport become options")
{
    CHECK(options_of({}).integrator == IntegratorKind::automatic);
    const RenderOptions options = options_of(
        {"--integrator=lt", "--heuristic=cutoff", "--max-depth=5", "--max-camera-depth=3",
         "--max-light-depth=0", "--light-paths=2", "--rr-start=4", "--env-sampling=plain",
         "--light-sampling=tree", "--disable=s3t0"});
    CHECK(options.integrator == IntegratorKind::lt);
    CHECK(options.transport.heuristic == Heuristic::cutoff);
    CHECK(options.transport.max_depth == 5);
    CHECK(options.transport.min_depth == 1);
    CHECK(options.bidirectional.max_camera_depth == 3);
    CHECK(options.bidirectional.max_light_depth == 0);
    CHECK(options.bidirectional.light_paths == 2);
    CHECK(options.transport.rr_start == 4);
    CHECK(options.sampling.environment == EnvironmentSampling::plain);
    CHECK(options.sampling.lights == LightSampling::tree);
    CHECK(options.bidirectional.disabled == std::vector{Strategy{3, 0}});
    const auto json = transport_json(options);
    CHECK(json == nlohmann::ordered_json::parse(R"({"integrator": "lt", "heuristic": "cutoff",
        "max_depth": 5, "min_depth": 1, "light_paths": 2, "rr_start": 4,
        "environment_sampling": "plain", "light_sampling": "tree", "light_samples": 1,
        "max_camera_depth": 3, "max_light_depth": 0, "disabled": ["s3t0"]})"));
}

TEST_CASE("numbers of light paths and connections need not be whole")
{
    const RenderOptions options = options_of({"--light-paths=0.0625", "--connections=2"});
    CHECK(options.bidirectional.light_paths == 0.0625);
    CHECK(options.bidirectional.connections == 2.0);
    const auto json = transport_json(options);
    CHECK(json["light_paths"] == 0.0625);
    CHECK(json["light_paths"].dump() == "0.0625");
    CHECK(json["connections"].dump() == "2");
    CHECK_FALSE(transport_json(options_of({})).contains("connections"));
    CHECK_THROWS_AS(options_of({"--integrator=mis", "--connections=2"}), Error);
    CHECK_FALSE(json.contains("connection_rays"));
}

TEST_CASE("connections are chosen among those of a whole number of light paths")
{
    const RenderOptions options =
        options_of({"--light-paths=0.0625", "--connections=8", "--connection-rays=2.5"});
    CHECK(options.bidirectional.connection_rays == 2.5);
    CHECK(transport_json(options)["connection_rays"].dump() == "2.5");
    CHECK(integrator_words(options) ==
          "bdpt --light-paths 0.0625 --connections 8 --connection-rays 2.5");
    CHECK_THROWS_AS(options_of({"--connections=1.5", "--connection-rays=2"}), Error);
    CHECK_THROWS_AS(options_of({"--connections=0.5", "--connection-rays=2"}), Error);
    CHECK_THROWS_AS(options_of({"--integrator=mis", "--connection-rays=2"}), Error);
    CHECK_THROWS_AS(options_of({"--light-paths=0", "--connection-rays=2"}), Error);
}

TEST_CASE("what is said of subpaths is said to bdpt unless another integrator is named")
{
    CHECK(options_of({"--light-paths=2"}).integrator == IntegratorKind::bdpt);
    CHECK(options_of({"--connections=1"}).integrator == IntegratorKind::bdpt);
    CHECK(options_of({"--connection-rays=2"}).integrator == IntegratorKind::bdpt);
    CHECK(options_of({"--disable=s0t2"}).integrator == IntegratorKind::bdpt);
    CHECK(options_of({"--max-camera-depth=2"}).integrator == IntegratorKind::bdpt);
    CHECK(options_of({"--max-light-depth=2"}).integrator == IntegratorKind::bdpt);
    CHECK(options_of({"--integrator=lt", "--light-paths=2"}).integrator == IntegratorKind::lt);
    CHECK_THROWS_AS(options_of({"--integrator=auto", "--light-paths=2"}), Error);
}

TEST_CASE("what was chosen is told in the words that choose it by hand")
{
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    options.bidirectional.light_paths = 0.25;
    options.bidirectional.connections = 2.0;
    CHECK(integrator_text(options, true) ==
          "auto chose bidirectional path tracing (1 light path for 4 camera paths, 2 connections)");
    CHECK(integrator_text(options, false) == "bdpt");
    options.bidirectional.disabled = {{.s = 1, .t = 1}, {.s = 0, .t = 12}};
    CHECK(disabled_text(options) == "s1t1,s0t12");
    CHECK(parse_strategies(disabled_text(options)) == options.bidirectional.disabled);
    CHECK(integrator_words(options) ==
          "bdpt --light-paths 0.25 --connections 2 --disable s1t1,s0t12");
    options.bidirectional.connection_rays = 8.0;
    CHECK(integrator_text(options, true) ==
          "auto chose bidirectional path tracing (1 light path for 4 camera paths, 2 connections "
          "by 8 rays)");
    options.bidirectional.connection_rays = 0.0;
    options.integrator = IntegratorKind::mis;
    CHECK(integrator_text(options, true) == "auto chose path tracing with light and BSDF sampling");
    options.integrator = IntegratorKind::bdpt;
    options.bidirectional.light_paths = 0.0625;
    options.bidirectional.connections = 1.0;
    CHECK(integrator_text(options, true) ==
          "auto chose bidirectional path tracing (1 light path for 16 camera paths)");
    options.bidirectional.light_paths = 1.0;
    CHECK(integrator_text(options, true) ==
          "auto chose bidirectional path tracing (1 light path for each camera path)");
}

TEST_CASE("how vcm merges is kept with the image")
{
    CHECK_FALSE(transport_json(options_of({})).contains("merge_radius"));
    CHECK(transport_json(options_of({"--integrator=vcm"}))["merge_radius"] == 0.003);
    const RenderOptions options = options_of(
        {"--integrator=vcm", "--merge-radius=0.01", "--merge-alpha=0.5", "--connections=2"});
    CHECK(options.bidirectional.merge_radius == 0.01);
    CHECK(options.bidirectional.merge_alpha == 0.5);
    CHECK(options.bidirectional.connections == 2.0);
    const auto json = transport_json(options);
    CHECK(json["integrator"] == "vcm");
    CHECK(json["merge_radius"] == 0.01);
    CHECK(json["merge_alpha"] == 0.5);
    CHECK_THROWS_AS(options_of({"--integrator=bdpt", "--merge-radius=0.01"}), Error);
}

TEST_CASE("direct and indirect light share the lengths of paths")
{
    CHECK(options_of({"--only=direct"}).transport.max_depth == 2);
    CHECK(options_of({"--only=direct"}).transport.min_depth == 1);
    CHECK(options_of({"--max-depth=1", "--only=direct"}).transport.max_depth == 1);
    CHECK_THROWS_AS(options_of({"--max-depth=1", "--only=indirect"}), Error);
    const RenderOptions indirect = options_of({"--max-depth=3", "--only=indirect"});
    CHECK(indirect.transport.max_depth == 3);
    CHECK(indirect.transport.min_depth == 3);
}

}  // namespace
}  // namespace bdpt::job::transport_arguments_test
