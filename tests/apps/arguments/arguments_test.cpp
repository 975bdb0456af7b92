#include "options/option_list.h"
#include "options/value_types.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "messages/text.h"

namespace bdpt::job::arguments_test {
namespace {

TEST_CASE("sizes are two whole numbers and a cross")
{
    const auto size = parse_size("640x360");
    REQUIRE(size);
    CHECK(size->width == 640);
    CHECK(size->height == 360);
    CHECK(parse_size("65535x1"));
    const auto square = parse_size("512");
    REQUIRE(square);
    CHECK(square->width == 512);
    CHECK(square->height == 512);
    CHECK(parse_size("640X360")->height == 360);
    for (const char* wrong : {"", "x", "0", "640x", "x360", "640x360x2", "640 x 360", "0x1", "1x0",
                              "-1x1", "65536x1", "1e3x10", "640XX360", "65536", "99999999999x1"}) {
        CAPTURE(wrong);
        CHECK_FALSE(parse_size(wrong));
    }
}

TEST_CASE("durations have a unit, seconds if none")
{
    CHECK(parse_duration("90") == 90.0);
    CHECK(parse_duration("90s") == 90.0);
    CHECK(parse_duration("2m") == 120.0);
    CHECK(parse_duration("1.5h") == 5400.0);
    CHECK(parse_duration("0.25s") == 0.25);
    CHECK(parse_duration("1h30m") == 5400.0);
    CHECK(parse_duration("2M5S") == 125.0);
    CHECK(parse_duration("1h0.5s") == 3600.5);
    for (const char* wrong : {"1h30", "30m1h", "1h1h", "h30m", "1h-5m", "0h0m", "1m30s5"}) {
        CAPTURE(wrong);
        CHECK_FALSE(parse_duration(wrong));
    }
    for (const char* wrong : {"", "s", "h", "0", "0s", "-1s", "1d", "1 s", "infs", "nan", "1ms"}) {
        CAPTURE(wrong);
        CHECK_FALSE(parse_duration(wrong));
    }
}

TEST_CASE("sizes in memory have a unit, bytes if none")
{
    CHECK(parse_bytes("1") == 1u);
    CHECK(parse_bytes("1500000") == 1500000u);
    CHECK(parse_bytes("800K") == 819200u);
    CHECK(parse_bytes("500M") == 524288000u);
    CHECK(parse_bytes("2.5G") == 2684354560u);
    CHECK(parse_bytes("1T") == 1099511627776u);
    for (const char* wrong :
         {"", "G", "0", "0.5", "-1G", "1 G", "2g", "2GB", "1e30", "inf", "nan"}) {
        CAPTURE(wrong);
        CHECK_FALSE(parse_bytes(wrong));
    }
}

TEST_CASE("points are three finite numbers")
{
    CHECK(parse_vec3("1,-2.5,3e2") == Vec3(1.0f, -2.5f, 300.0f));
    for (const char* wrong :
         {"", "1", "1,2", "1,2,3,4", "1,,3", "1,2,", "a,b,c", "1,2,inf", "nan,0,0", "1, 2, 3"}) {
        CAPTURE(wrong);
        CHECK_FALSE(parse_vec3(wrong));
    }
}

TEST_CASE("an index is nothing but digits")
{
    CHECK(parse_index("0") == 0u);
    CHECK(parse_index("12") == 12u);
    CHECK_FALSE(parse_index(""));
    CHECK_FALSE(parse_index("-1"));
    CHECK_FALSE(parse_index("1a"));
    CHECK_FALSE(parse_index("99999999999999999999999"));
}

TEST_CASE("a word that is nearly right has a suggestion")
{
    const std::vector<std::string> words{"--spp", "--size", "--integrator", "--look-at"};
    CHECK(closest("--intergrator", words) == "--integrator");
    CHECK(closest("--lookat", words) == "--look-at");
    CHECK(closest("--szie", words) == "--size");
    CHECK_FALSE(closest("--xylophone", words));
}

TEST_CASE("messages are one line of UTF-8 whatever goes in")
{
    CHECK(one_line("caf\xc3\xa9") == "caf\xc3\xa9");
    CHECK(one_line("a\nb\tc\x1b[31m") == "a b c [31m");
    CHECK(one_line("a\xff z") == "a\xef\xbf\xbd z");
    // C1 controls, as U+009B, which begins an escape sequence; and what turns text around.
    CHECK(one_line("a\xc2\x9b"
                   "31m") == "a 31m");
    CHECK(one_line("a\xe2\x80\xaeg.exr") == "a g.exr");
    CHECK(one_line("a\xe2\x81\xa6z\xef\xbb\xbf") == "a z ");
    CHECK(one_line("\xf0\x9f\x98\x80 \xe2\x80\x8d") == "\xf0\x9f\x98\x80 \xe2\x80\x8d");
    CHECK(one_line("\xf3\xa0\x81\x81x") == " x");
}

TEST_CASE("reports have nothing that a terminal obeys, and JSON keeps what it says")
{
    CHECK(escaped("caf\xc3\xa9\n\tb") == "caf\xc3\xa9\n\tb");
    CHECK(escaped("a\xc2\x9b"
                  "31m\x1b") == "a\\u009b31m\\u001b");
    CHECK(escaped("\xe2\x80\xae") == "\\u202e");
    const std::string json = nlohmann::json("\xc2\x9b\xf3\xa0\x81\x81").dump();
    CHECK(escaped(json) == "\"\\u009b\\udb40\\udc41\"");
    CHECK(nlohmann::json::parse(escaped(json)) == nlohmann::json::parse(json));
}

TEST_CASE("times are shown as on a clock")
{
    CHECK(clock_time(0.2) == "0:00");
    CHECK(clock_time(67.0) == "1:07");
    CHECK(clock_time(59.7) == "1:00");
    CHECK(clock_time(2 * 3600 + 3 * 60 + 9) == "2:03:09");
    CHECK(clock_time(1e300) == "168:00:00");
}

}  // namespace
}  // namespace bdpt::job::arguments_test
