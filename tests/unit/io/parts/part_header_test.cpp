#include "part/part_contents.h"

#include <bdpt/error.h>
#include <bdpt/render.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "scene_builder.h"

namespace bdpt::io::part_header_test {
namespace {

PartHeader header()
{
    test::SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.7f)), test::plastic(Rgb(0.6f), 0.3f));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    options.film.width = 5;
    options.film.height = 4;
    options.film.clamp = 8.0f;
    options.film.aovs = {Aov::albedo, Aov::object, Aov::material};
    options.bidirectional.strategy_depth = 2;
    options.sampling.samples = {.begin = 0, .end = 2};
    const RenderResult part = render(Scene(std::move(builder.desc)), test::room_camera(), options);
    PartNotes notes{.goal = SampleSet({.begin = 0, .end = 64}), .metadata = {}, .command = {"x"}};
    notes.metadata.frame = FrameNumber{.number = 3, .per_second = 24.0};
    notes.metadata.camera = test::room_camera();
    notes.metadata.camera.motion.emplace_back(1.0f);
    PartHeader result = make_part_header(part, notes);
    result.totals.defects.first_invalid = FilmDefects::Place{.x = 1, .y = 2, .sample_index = 1};
    return result;
}

/// Where numbers stand in a JSON text, outside of its strings: the places and the lengths.
std::vector<std::pair<std::size_t, std::size_t>> numbers_of(std::string_view text)
{
    constexpr std::string_view of_number = "+-.0123456789eE";
    std::vector<std::pair<std::size_t, std::size_t>> result;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"' && (i == 0 || text[i - 1] != '\\')) {
            in_string = !in_string;
        } else if (!in_string &&
                   (std::isdigit(static_cast<unsigned char>(text[i])) != 0 || text[i] == '-')) {
            const std::size_t end = std::min(text.find_first_not_of(of_number, i), text.size());
            result.emplace_back(i, end - i);
            i = end - 1;
        }
    }
    return result;
}

TEST_CASE("each number in the header of a part is checked before it is converted", "[part]")
{
    // Sanitizers find conversions that are not defined; others show as text that is not stable.
    const std::string text = to_text(header());
    REQUIRE(to_text(parse_part_header(text)) == text);
    const auto numbers = numbers_of(text);
    REQUIRE(numbers.size() > 80);
    std::size_t refused = 0;
    for (const auto& [place, length] : numbers) {
        for (const char* lie : {"1e300", "-1e300", "1e39", "1e10", "-1", "0.5", "4294967296",
                                "18446744073709551615", "-9223372036854775808", "null", "\"1\""}) {
            CAPTURE(text.substr(place, length),
                    text.substr(0, place).substr(place > 60 ? place - 60 : 0), lie);
            try {
                const std::string written =
                    to_text(parse_part_header(std::string(text).replace(place, length, lie)));
                CHECK(to_text(parse_part_header(written)) == written);
            } catch (const Error& error) {
                CHECK(error.code() == ErrorCode::invalid_input);
                const std::string what = error.what();
                CHECK((what.find(": /") != std::string::npos ||
                       what.find("format") != std::string::npos));
                ++refused;
            }
        }
    }
    CHECK(refused > 4 * numbers.size());
    const std::size_t size = text.find(R"("size":[5,4])");
    REQUIRE(size != std::string::npos);
    try {
        static_cast<void>(parse_part_header(std::string(text).replace(size + 8, 1, "1e300")));
        FAIL("read");
    } catch (const Error& error) {
        CHECK(std::string(error.what()) ==
              "its header is not that of a part: /film/size/0: must be an integer from 1 "
              "to 65536, but is 1e+300");
    }
}

// The time limit of tests is what this fails by: with the square of the numbers it takes hours.
TEST_CASE("headers of a million components and ranges are read in time", "[part][long]")
{
    PartHeader large = header();
    std::string ranges;
    for (int i = 0; i < 1'000'000; ++i) {
        large.identity.components.push_back({.name = std::to_string(i), .value = "v"});
        ranges += (i > 0 ? "," : "") + std::to_string(3 * i) + ":" + std::to_string(3 * i + 1);
    }
    large.samples = *SampleSet::parse(ranges);
    const PartHeader read = parse_part_header(to_text(large));
    CHECK(read.identity == large.identity);
    CHECK(read.samples == large.samples);
    PartHeader other = read;
    std::reverse(other.identity.components.begin(), other.identity.components.end());
    CHECK(difference(read.identity, other.identity) == "the order of components");
    other.identity.components.front().value = "w";
    CHECK(difference(read.identity, other.identity) == "999999 (w, not v)");
}

}  // namespace
}  // namespace bdpt::io::part_header_test
