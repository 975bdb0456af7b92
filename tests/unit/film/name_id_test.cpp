#include <bdpt/film/name_id.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "catch.hpp"

namespace bdpt::name_id_test {
namespace {

float pixel_of(const std::string& name)
{
    return std::bit_cast<float>(name_id(name));
}

std::string key_of(const std::string& layer)
{
    return hex_text(name_id(layer)).substr(0, 7);
}

TEST_CASE("ids are the published ones", "[ids]")
{
    // Values of the tests of the specification's authors, for their own decoder.
    CHECK(pixel_of("hello") == 6.0705627102400005616e-17f);
    CHECK(pixel_of("cube") == -4.08461912519e+15f);
    CHECK(pixel_of("sphere") == 2.79018604383e+15f);
    CHECK(pixel_of("plane") == 3.66557617593e-11f);
    CHECK(pixel_of("\xd1\x80\xd0\xb0\xd0\xb2\xd0\xbd\xd0\xb8\xd0\xbd\xd0\xb0") ==
          -1.3192631212399999468e-25f);
    CHECK(pixel_of("m\xc3\xa4"
                   "dchen") == 6.2361298211599995797e+25f);
}

TEST_CASE("ids are hashes of all bytes, however many the last block has", "[ids]")
{
    // By the Python package mmh3 5.
    CHECK(hex_text(name_id("a")) == "3c2569b2");
    CHECK(hex_text(name_id("ab")) == "9bbfd75f");
    CHECK(hex_text(name_id("abc")) == "b3dd93fa");
    CHECK(hex_text(name_id("abcd")) == "43ed676a");
    CHECK(hex_text(name_id("The quick brown fox")) == "60a2c22d");
    CHECK(key_of("CryptoObject") == "3ae39a5");
    CHECK(key_of("CryptoMaterial") == "be359d6");
}

TEST_CASE("an id is a number that floats keep: bit 23 is flipped where it would not be", "[ids]")
{
    // Names whose hash has an exponent of zeros or ones, by mmh3.
    CHECK(hex_text(name_id("object85")) == hex_text(NameId{0x802d54beU ^ 0x800000U}));
    CHECK(hex_text(name_id("object365")) == hex_text(NameId{0x0064028fU ^ 0x800000U}));
    CHECK(hex_text(name_id("object878")) == hex_text(NameId{0x7fbea3d3U ^ 0x800000U}));
    CHECK(hex_text(name_id("object1221")) == hex_text(NameId{0xffd06e74U ^ 0x800000U}));
    CHECK(name_id("") == NameId{0x800000});
    for (int i = 0; i < 2000; ++i) {
        const std::string name = "object" + std::to_string(i);
        CAPTURE(name);
        REQUIRE(std::isnormal(pixel_of(name)));
        REQUIRE(is_name_id(name_id(name)));
    }
    for (const std::uint32_t bits : {0U, 0x80000000U, 0x7fffffU, 0x7f800000U, 0xffc00000U}) {
        CHECK_FALSE(is_name_id(NameId{bits}));
    }
}

}  // namespace
}  // namespace bdpt::name_id_test
