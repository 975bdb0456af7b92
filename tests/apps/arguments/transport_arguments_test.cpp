#include "options/groups/transport_arguments.h"

#include <bdpt/error.h>

#include <nlohmann/json.hpp>

#include "catch.hpp"

namespace bdpt::app::transport_arguments_test {
namespace {

TEST_CASE("strategies are two numbers of vertices")
{
    CHECK(parse_strategies("s2t1") == std::vector{Strategy{2, 1}});
    CHECK(parse_strategies("s2t1,s0t3,s12t345") ==
          std::vector{Strategy{2, 1}, Strategy{0, 3}, Strategy{12, 345}});
    for (const char* wrong :
         {"", ",", "s2t1,", "s2t1,,s1t1", "s2", "t1", "2t1", "s2t", "st1", "s2t1 ", "s-1t3", "t1s2",
          "S2T1", "s0t0", "s1t0", "s0t1", "s2t1t1", "s2t1002", "s99999999999999999999t1"}) {
        CAPTURE(wrong);
        CHECK_FALSE(parse_strategies(wrong));
    }
}

TEST_CASE("words about transport become options")
{
    TransportWords words;
    CHECK(with_transport(words, {}).integrator == IntegratorKind::automatic);
    words.integrator = "lt";
    words.heuristic = "cutoff";
    words.max_depth = 5;
    words.max_camera_depth = 3;
    words.max_light_depth = 0;
    words.light_paths = 2;
    words.rr_start = 4;
    words.light_sampling.environments = "plain";
    words.light_sampling.lights = "tree";
    words.disabled = "s3t0";
    const RenderOptions options = with_transport(words, {});
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
    TransportWords words;
    words.light_paths = 0.0625;
    words.connections = 2.0;
    const RenderOptions options = with_transport(words, {});
    CHECK(options.bidirectional.light_paths == 0.0625);
    CHECK(options.bidirectional.connections == 2.0);
    const auto json = transport_json(options);
    CHECK(json["light_paths"] == 0.0625);
    CHECK(json["light_paths"].dump() == "0.0625");
    CHECK(json["connections"].dump() == "2");
    CHECK_FALSE(transport_json(with_transport({}, {})).contains("connections"));
    TransportWords path_tracing;
    path_tracing.integrator = "mis";
    path_tracing.connections = 2.0;
    CHECK_THROWS_AS(with_transport(path_tracing, {}), Error);
}

TEST_CASE("what is said of subpaths is said to bdpt unless another integrator is named")
{
    const auto chosen = [](auto say) {
        TransportWords words;
        say(words);
        return with_transport(words, {}).integrator;
    };
    CHECK(chosen([](TransportWords&) {}) == IntegratorKind::automatic);
    CHECK(chosen([](TransportWords& w) { w.light_paths = 2.0; }) == IntegratorKind::bdpt);
    CHECK(chosen([](TransportWords& w) { w.connections = 1.0; }) == IntegratorKind::bdpt);
    CHECK(chosen([](TransportWords& w) { w.disabled = "s0t2"; }) == IntegratorKind::bdpt);
    CHECK(chosen([](TransportWords& w) { w.max_camera_depth = 2; }) == IntegratorKind::bdpt);
    CHECK(chosen([](TransportWords& w) { w.max_light_depth = 2; }) == IntegratorKind::bdpt);
    CHECK(chosen([](TransportWords& w) {
              w.integrator = "lt";
              w.light_paths = 2.0;
          }) == IntegratorKind::lt);
    CHECK_THROWS_AS(chosen([](TransportWords& w) {
                        w.integrator = "auto";
                        w.light_paths = 2.0;
                    }),
                    Error);
}

TEST_CASE("what was chosen is told in the words that choose it by hand")
{
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    options.bidirectional.light_paths = 0.25;
    options.bidirectional.connections = 2.0;
    CHECK(integrator_text(options, true) == "auto: bdpt --light-paths 0.25 --connections 2");
    options.bidirectional.disabled = {{.s = 1, .t = 1}, {.s = 0, .t = 12}};
    CHECK(disabled_text(options) == "s1t1,s0t12");
    CHECK(parse_strategies(disabled_text(options)) == options.bidirectional.disabled);
    CHECK(integrator_words(options) ==
          "bdpt --light-paths 0.25 --connections 2 --disable s1t1,s0t12");
    options.integrator = IntegratorKind::mis;
    CHECK(integrator_text(options, true) == "auto: mis");
}

TEST_CASE("how vcm merges is kept with the image")
{
    TransportWords words;
    CHECK_FALSE(transport_json(with_transport(words, {})).contains("merge_radius"));
    words.integrator = "vcm";
    CHECK(transport_json(with_transport(words, {}))["merge_radius"] == 0.003);
    words.merge_radius = 0.01;
    words.merge_alpha = 0.5;
    words.connections = 2.0;
    const RenderOptions options = with_transport(words, {});
    CHECK(options.bidirectional.merge_radius == 0.01);
    CHECK(options.bidirectional.merge_alpha == 0.5);
    CHECK(options.bidirectional.connections == 2.0);
    const auto json = transport_json(options);
    CHECK(json["integrator"] == "vcm");
    CHECK(json["merge_radius"] == 0.01);
    CHECK(json["merge_alpha"] == 0.5);
    words.integrator = "bdpt";
    CHECK_THROWS_AS(with_transport(words, {}), Error);
}

TEST_CASE("direct and indirect light share the lengths of paths")
{
    const TransportWords direct{.only = "direct"};
    CHECK(with_transport(direct, {}).transport.max_depth == 2);
    CHECK(with_transport(direct, {}).transport.min_depth == 1);
    CHECK(with_transport({.max_depth = 1, .only = "direct"}, {}).transport.max_depth == 1);
    CHECK_THROWS_AS(with_transport({.max_depth = 1, .only = "indirect"}, {}), Error);
    const TransportWords indirect{.max_depth = 3, .only = "indirect"};
    CHECK(with_transport(indirect, {}).transport.max_depth == 3);
    CHECK(with_transport(indirect, {}).transport.min_depth == 3);
}

}  // namespace
}  // namespace bdpt::app::transport_arguments_test
