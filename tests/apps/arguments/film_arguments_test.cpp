#include "options/groups/image_arguments.h"

#include <bdpt/options/option_fields.h>

#include "catch.hpp"

namespace bdpt::job::film_arguments_test {
namespace {

TEST_CASE("filters have a name and perhaps a radius")
{
    CHECK(parse_filter("box") == FilterOptions{.kind = FilterKind::box, .radius = {}});
    CHECK(parse_filter("Box") == parse_filter("box"));
    CHECK(parse_filter("tent") == FilterOptions{.kind = FilterKind::tent, .radius = {}});
    CHECK(parse_filter("gaussian:2.5") ==
          FilterOptions{.kind = FilterKind::gaussian, .radius = 2.5f});
    CHECK(parse_filter("blackman-harris:16") ==
          FilterOptions{.kind = FilterKind::blackman_harris, .radius = 16.0f});
    for (const char* wrong : {"", ":", ":1", "Boxes", "box:", "box:0", "box:-1", "box:17",
                              "box:nan", "box:1:2", "box 1", "gauss", "tent:1px"}) {
        CAPTURE(wrong);
        CHECK_FALSE(parse_filter(wrong));
    }
    CHECK(std::string_view(to_name(FilterKind::blackman_harris)) == "blackman-harris");
}

TEST_CASE("AOVs are names with commas between")
{
    CHECK(parse_aovs("depth") == AovSet{Aov::depth});
    CHECK(parse_aovs("alpha,albedo,samples") == AovSet{Aov::albedo, Aov::sample_count, Aov::alpha});
    CHECK(parse_aovs("Depth,ALBEDO") == parse_aovs("depth,albedo"));
    CHECK(parse_aovs("depth,depth") == AovSet{Aov::depth});
    CHECK(parse_aovs("normal,position,variance") ==
          AovSet{Aov::normal, Aov::position, Aov::variance});
    CHECK(parse_aovs("object,material") == AovSet{Aov::object, Aov::material});
    CHECK(parse_aovs("uv,distance,camera-normal,instance") ==
          AovSet{Aov::uv, Aov::distance, Aov::camera_normal, Aov::instance});
    for (const char* wrong : {"", ",", "depth,", ",depth", "depth, alpha", "mask"}) {
        CAPTURE(wrong);
        CHECK_FALSE(parse_aovs(wrong));
    }
}

TEST_CASE("crops are four whole numbers in order")
{
    CHECK(parse_crop("1,2,30,4000") == PixelRect{.x0 = 1, .y0 = 2, .x1 = 30, .y1 = 4000});
    for (const char* wrong : {"", "1,2,3", "1,2,3,4,5", "1,2,1,4", "1,4,3,4", "5,2,3,4", "-1,0,3,4",
                              "0,0,1.5,4", "0,0,,4", "0, 0, 4, 4", "0,0,65536,1"}) {
        CAPTURE(wrong);
        CHECK_FALSE(parse_crop(wrong));
    }
}

}  // namespace
}  // namespace bdpt::job::film_arguments_test
