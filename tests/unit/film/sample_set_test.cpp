#include <bdpt/part/sample_set.h>

#include "catch.hpp"

#include <bitset>
#include <random>
#include <string>

namespace bdpt::sample_set_test {
namespace {

constexpr std::int64_t most = 40;

SampleSet set_of(const std::string& text)
{
    const auto set = SampleSet::parse(text);
    REQUIRE(set.has_value());
    return *set;
}

std::bitset<most> bits_of(const SampleSet& set)
{
    std::bitset<most> bits;
    for (const SampleRange& range : set.ranges()) {
        for (std::int64_t i = range.begin; i < range.end; ++i) {
            bits.set(static_cast<std::size_t>(i));
        }
    }
    return bits;
}

}  // namespace

TEST_CASE("SampleSet reads the text that it writes, and no other", "[part]")
{
    for (const char* text : {"", "0:64", "0:64,128:192", "7:8,9:10,4294967294:4294967295"}) {
        CHECK(set_of(text).text() == text);
    }
    CHECK(set_of("0:64,128:192").count() == 128);
    CHECK(set_of("0:64,128:192").end() == 192);
    for (const char* text :
         {"0", ":", "0:", ":5", "5:5", "6:5", "-1:5", "0:64,", ",0:64", "0:64,64:128",
          "0:64,32:128", "128:192,0:64", "0:64 ", "0:64;70:80", "0x0:5", "0:4294967296", "1.0:2"}) {
        CAPTURE(text);
        CHECK_FALSE(SampleSet::parse(text).has_value());
    }
}

TEST_CASE("SampleSet agrees with a set of bits", "[part]")
{
    std::mt19937 engine(7);
    std::uniform_int_distribution<std::int64_t> place(0, most);
    const auto random_set = [&] {
        SampleSet set;
        for (int i = 0; i < 3; ++i) {
            set.add({.begin = place(engine), .end = place(engine)});
        }
        return set;
    };
    for (int round = 0; round < 2000; ++round) {
        const SampleSet a = random_set();
        const SampleSet b = random_set();
        CAPTURE(a.text(), b.text());
        SampleSet both = a;
        both.add(b);
        REQUIRE(bits_of(both) == (bits_of(a) | bits_of(b)));
        REQUIRE(bits_of(a.overlap(b)) == (bits_of(a) & bits_of(b)));
        REQUIRE(bits_of(a.missing(b)) == (bits_of(b) & ~bits_of(a)));
        REQUIRE(a.contains(b) == (bits_of(b) & ~bits_of(a)).none());
        REQUIRE(a.count() == static_cast<std::int64_t>(bits_of(a).count()));
        // Written in one way only.
        REQUIRE(set_of(both.text()) == both);
        REQUIRE((a == b) == (bits_of(a) == bits_of(b)));
    }
}

// The time limit of tests is what this fails by: with the square of the number it takes hours.
TEST_CASE("sets of a million ranges are compared and added in time", "[part]")
{
    const auto comb = [](std::int64_t first) {
        std::string text;
        for (std::int64_t i = 0; i < 1'000'000; ++i) {
            text += (i > 0 ? "," : "") + std::to_string(4 * i + first) + ":" +
                    std::to_string(4 * i + first + 1);
        }
        return *SampleSet::parse(text);
    };
    const SampleSet a = comb(0);
    const SampleSet b = comb(2);
    CHECK(a.overlap(b).empty());
    CHECK(a.overlap(a) == a);
    CHECK(a.missing(b) == b);
    CHECK(a.contains(a));
    SampleSet both = a;
    both.add(b);
    CHECK(both.ranges().size() == 2'000'000);
    both.add(comb(1));
    both.add(comb(3));
    CHECK(both.text() == "0:4000000");
    CHECK(SampleSet({.begin = 0, .end = 5'000'000}).overlap(a) == a);
}

}  // namespace bdpt::sample_set_test
